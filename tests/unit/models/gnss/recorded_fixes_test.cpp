#include "inslab/models/gnss/recorded_fixes.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "inslab/models/gnss/gnss_model.hpp"

/// Errors of a recorded receiver on a simulated one.
namespace inslab::gnss {
namespace recorded_fixes_test {

/// Two epochs a second, 30 s; none from 10 s to 15 s; what they err by tells which they are.
std::shared_ptr<const RecordedFixErrors> recording() {
  auto errors = std::make_shared<RecordedFixErrors>();
  errors->interval = time::from_seconds(0.5);
  for (int k = 0; k <= 60; ++k) {
    if (k > 20 && k < 30) continue;
    RecordedFixErrors::Epoch epoch;
    epoch.time = time::from_seconds(0.5 * k);
    epoch.position_ned_m = {0.1 * k, 1.0, -2.0};
    epoch.velocity_ned_m_per_s = {0.0, 0.01 * k, 0.0};
    epoch.position_sigma_ned_m = {3.0, 4.0, 5.0};
    epoch.fix_type = k < 20 ? FixType::Fixed : FixType::Float;
    errors->epochs.push_back(epoch);
  }
  return errors;
}

RecordedFixError from(double seconds) {
  RecordedFixError profile;
  profile.file = "drive.csv";
  profile.sha256 = std::string(64, 'a');
  profile.from = RecordingStart::Given;
  profile.from_s = seconds;
  return profile;
}

RecordedFixes::Run run_of(double end_s) {
  return {42, "gnss0", time::from_seconds(end_s), [](const std::string&, const std::string&) { return recording(); }};
}

TEST(RecordedFixes, AreThoseOfTheirTime) {
  const RecordedFixes fixes(from(2.0), run_of(20.0));
  const auto epoch = fixes.at(time::from_seconds(1.5));
  ASSERT_TRUE(epoch.has_value());
  EXPECT_EQ(epoch->position_ned_m, Vector3(0.1 * 7, 1.0, -2.0));
  EXPECT_EQ(epoch->fix_type, FixType::Fixed);
}

TEST(RecordedFixes, BetweenTwoEpochsLieBetweenThemWithTheWorseType) {
  const RecordedFixes fixes(from(0.0), run_of(20.0));
  const auto epoch = fixes.at(time::from_seconds(9.75));
  ASSERT_TRUE(epoch.has_value());
  EXPECT_NEAR(epoch->position_ned_m.x(), 1.95, 1e-12);
  EXPECT_NEAR(epoch->velocity_ned_m_per_s.y(), 0.195, 1e-12);
  EXPECT_EQ(epoch->fix_type, FixType::Float);
}

TEST(RecordedFixes, AreNotWhereTheReceiverHadNone) {
  const RecordedFixes fixes(from(0.0), run_of(20.0));
  EXPECT_TRUE(fixes.at(time::from_seconds(10.0)).has_value());
  EXPECT_FALSE(fixes.at(time::from_seconds(10.5)).has_value());
  EXPECT_FALSE(fixes.at(time::from_seconds(14.5)).has_value());
  EXPECT_TRUE(fixes.at(time::from_seconds(15.0)).has_value());
  EXPECT_FALSE(RecordedFixes(from(-3.0), run_of(20.0)).at(time::from_seconds(2.0)).has_value());
}

TEST(RecordedFixes, AreRefusedForARunThatIsLonger) {
  try {
    RecordedFixes(from(12.0), run_of(20.0));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "drive.csv: lasts 30 s; the run, from 12 s on, needs 32 s");
  }
  RecordedFixError drawn = from(0.0);
  drawn.from = RecordingStart::Drawn;
  EXPECT_NO_THROW(RecordedFixes(drawn, run_of(30.0)));
  EXPECT_THROW(RecordedFixes(drawn, run_of(30.5)), std::invalid_argument);
  for (std::uint64_t seed = 0; seed < 40; ++seed) {  // it lasts, wherever the seed says that it begins
    RecordedFixes::Run run = run_of(25.0);
    run.seed = seed;
    EXPECT_TRUE(RecordedFixes(drawn, run).at(run.end).has_value()) << seed;
  }
}

TEST(RecordedFixes, AreInTheFixWithTheirClaimsTypeAndOutages) {
  GnssModel::Setup setup{42, 0, time::Rate(2.0), {}, {}, {}, {}};
  setup.errors.fix_type = FixType::Fixed;
  setup.installation.target.kind = SensorKind::Gnss;
  setup.end = time::from_seconds(20.0);
  setup.recordings = run_of(20.0).find;
  GnssModel plain(setup);
  setup.errors.recorded_error = from(0.0);
  GnssModel grafted(setup);
  TruthState truth;
  truth.latitude_rad = 0.7;
  int fixes = 0;
  for (int k = 1; k <= 40; ++k) {
    truth.header.sim_time_ns = 500'000'000LL * k;
    const auto without = plain.observe(truth), with = grafted.observe(truth);
    ASSERT_TRUE(without.has_value());
    EXPECT_EQ(with.has_value(), k <= 20 || k >= 30) << k;
    if (!with) continue;
    EXPECT_EQ(with->header.sequence_number, static_cast<std::uint64_t>(fixes++));
    EXPECT_NEAR(with->height_m - without->height_m, 2.0, 2e-6);  // the plane of 4 m is 1.3e-6 m off the ellipsoid
    EXPECT_NEAR((with->latitude_rad - without->latitude_rad) * 6.362e6, 0.1 * k, 2e-3 * k);
    EXPECT_EQ(with->v_n, without->v_n + Vector3(0.0, 0.01 * k, 0.0));
    EXPECT_EQ(with->position_sigma_ned_m, Vector3(3.0, 4.0, 5.0));
    EXPECT_EQ(with->fix_type, k < 20 ? FixType::Fixed : FixType::Float);
  }
}

}  // namespace recorded_fixes_test
}  // namespace inslab::gnss
