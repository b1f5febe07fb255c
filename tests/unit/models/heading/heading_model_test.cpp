#include <gtest/gtest.h>

#include "inslab/noise/random/gauss_markov.hpp"
#include "tests/unit/models/heading/heading_scene.hpp"

namespace inslab::heading {
namespace heading_model_test {

using scene::fault;
using scene::setup;
using scene::truth_at;

TEST(Heading, OfABaselineAlongTheNoseIsYawAndPitch) {
  HeadingModel model(setup());
  const BaselineHeading sample = *model.observe(truth_at(1, 25.0, -12.0, 200.0));
  EXPECT_NEAR(sample.heading_rad, 200.0 * units::kDeg, 1e-6);
  EXPECT_NEAR(sample.pitch_rad, -12.0 * units::kDeg, 1e-6);
  EXPECT_NEAR(sample.baseline_m, 2.0, 1e-12);
  EXPECT_EQ(sample.fix_type, FixType::Fixed);
  EXPECT_EQ(sample.heading_sigma_rad, 0.0);
}

TEST(Heading, OfABaselineToTheRightIsAQuarterTurnFurtherAndPitchesAsTheVehicleRolls) {
  HeadingModel::Setup s = setup();
  s.installation.second_lever_arm_v_m = s.installation.lever_arm_v_m + Vector3(0.0, 1.2, 0.0);
  HeadingModel model(s);
  const BaselineHeading sample = *model.observe(truth_at(1, 20.0, 0.0, 300.0));
  EXPECT_NEAR(sample.heading_rad, 30.0 * units::kDeg, 1e-6);
  EXPECT_NEAR(sample.pitch_rad, -20.0 * units::kDeg, 1e-6);
}

/// A line that begins eastwards bears ever more south: by the turn of the meridians, d longitude times sin(latitude).
TEST(Heading, IsFromTheNorthOfTheFirstAntenna) {
  HeadingModel::Setup s = setup();
  s.installation.lever_arm_v_m = {0.0, 990.0, 0.0};
  s.installation.second_lever_arm_v_m = {0.0, 992.0, 0.0};
  HeadingModel model(s);
  const double radius_m = 6378137.0 / std::sqrt(1.0 - 0.00669437999014 * std::sin(0.84) * std::sin(0.84)) + 500.0;
  const double turn_rad = 990.0 / (radius_m * std::cos(0.84)) * std::sin(0.84);
  EXPECT_GT(turn_rad, 1.7e-4);
  EXPECT_NEAR(model.observe(truth_at(1))->heading_rad, 0.5 * units::kPi + turn_rad, 1e-8);
}

struct Spread {
  double heading_rad = 0.0;
  double pitch_rad = 0.0;
};
constexpr int kSamples = 20000;
/// Of a standard deviation from so many, four of its own.
constexpr double kOfSpread = 4.0 / 200.0;

Spread spread_of(const HeadingModel::Setup& s, double pitch_deg) {
  HeadingModel model(s);
  Spread sum;
  for (int k = 1; k <= kSamples; ++k) {
    const BaselineHeading sample = *model.observe(truth_at(k, 0.0, pitch_deg, 90.0));
    sum.heading_rad += std::pow(sample.heading_rad - 90.0 * units::kDeg, 2.0);
    sum.pitch_rad += std::pow(sample.pitch_rad - pitch_deg * units::kDeg, 2.0);
  }
  return {std::sqrt(sum.heading_rad / kSamples), std::sqrt(sum.pitch_rad / kSamples)};
}

TEST(Heading, IsAsUnsureAsTheRelativePositionOverTheLevelLengthOfTheBaseline) {
  HeadingModel::Setup s = setup();
  s.errors.relative_sigma_ned_m = {0.004, 0.004, 0.008};
  const double cos_30 = std::sqrt(3.0) / 2.0;
  const Spread found = spread_of(s, 30.0);
  const double heading_rad = 0.004 / (2.0 * cos_30);
  const double pitch_rad = std::hypot(0.008 * cos_30, 0.004 * 0.5) / 2.0;
  EXPECT_NEAR(found.heading_rad, heading_rad, kOfSpread * heading_rad);
  EXPECT_NEAR(found.pitch_rad, pitch_rad, kOfSpread * pitch_rad);
}

TEST(Heading, OfABaselineTwiceAsLongIsTwiceAsSure) {
  HeadingModel::Setup s = setup();
  s.errors.relative_sigma_ned_m.setConstant(0.004);
  s.installation.second_lever_arm_v_m.x() += 2.0;
  EXPECT_NEAR(spread_of(s, 0.0).heading_rad, 0.001, kOfSpread * 0.001);
}

TEST(Heading, ClaimsWhiteNoiseAndMultipathTogetherThroughTheDirection) {
  HeadingModel::Setup s = setup();
  s.errors.relative_sigma_ned_m = {3e-6, 3e-6, 6e-6};
  s.errors.relative_gm_sigma_ned_m = {4e-6, 4e-6, 8e-6};
  s.errors.relative_gm_correlation_time_s.setConstant(100.0);
  HeadingModel model(s);
  const BaselineHeading sample = *model.observe(truth_at(1, 0.0, 30.0, 45.0));
  const double cos_30 = std::sqrt(3.0) / 2.0;
  EXPECT_NEAR(sample.heading_sigma_rad, 5e-6 / (2.0 * cos_30), 1e-10);
  EXPECT_NEAR(sample.pitch_sigma_rad, std::hypot(10e-6 * cos_30, 5e-6 * 0.5) / 2.0, 1e-10);
}

TEST(Heading, HasAMultipathOfItsOwnForEachComponent) {
  HeadingModel::Setup s = setup();
  s.sensor_number = 3;
  s.errors.target.number = s.installation.target.number = 3;
  s.installation = scene::from_the_reference_point(s.installation);
  s.errors.relative_gm_sigma_ned_m = {0.01, 0.02, 0.03};
  s.errors.relative_gm_correlation_time_s.setConstant(20.0);
  HeadingModel model(s);
  const auto process = [](const char* name, double sigma_m) {
    return random::GaussMarkov({sigma_m, 20.0}, 0.1, random::Stream(42, std::string("heading3/baseline.") + name));
  };
  random::GaussMarkov north = process("north/gm", 0.01), east = process("east/gm", 0.02),
                      down = process("down/gm", 0.03);
  for (std::uint64_t k = 1; k < 50; ++k) {
    const BaselineHeading sample = *model.observe(truth_at(k));
    const double n = 2.0 + north.advance(k - 1), e = east.advance(k - 1), d = down.advance(k - 1);
    EXPECT_NEAR(std::sin(sample.heading_rad), e / std::hypot(n, e), 1e-6);
    EXPECT_NEAR(std::sin(sample.pitch_rad), -d / std::sqrt(n * n + e * e + d * d), 1e-6);
    EXPECT_NEAR(sample.baseline_m, std::sqrt(n * n + e * e + d * d), 1e-9);
  }
}

TEST(Heading, GoesOnUnderASwappedInstallation) {
  HeadingModel model(setup());
  ASSERT_TRUE(model.observe(truth_at(1)));
  InstallationProfile across = setup().installation;
  across.request.journal_number = 4;
  across.second_lever_arm_v_m = across.lever_arm_v_m + Vector3(0.0, 1.0, 0.0);
  model.apply(across);
  const BaselineHeading sample = *model.observe(truth_at(2));
  EXPECT_NEAR(sample.heading_rad, 0.5 * units::kPi, 1e-6);
  EXPECT_EQ(sample.revisions.installation, 4u);
  EXPECT_EQ(sample.header.sequence_number, 1u);
}

TEST(Heading, RefusesAntennasAtOnePlaceAndStaysAsItWas) {
  HeadingModel model(setup());
  InstallationProfile together = setup().installation;
  together.second_lever_arm_v_m = together.lever_arm_v_m + Vector3(0.09, 0.0, 0.0);
  EXPECT_THROW(model.apply(together), std::invalid_argument);
  EXPECT_NEAR(model.observe(truth_at(1))->baseline_m, 2.0, 1e-12);
}

TEST(Heading, IsOffByWhatAFaultPutsTheSecondAntennaElsewhere) {
  HeadingModel::Setup s = setup();
  s.installation = scene::from_the_reference_point(s.installation);
  HeadingModel model(s);
  model.apply(fault([](FaultProfile& f) { f.wrong_fix_ned_m = {0.0, 0.2, 0.0}; }));
  const BaselineHeading sample = *model.observe(truth_at(1));
  EXPECT_NEAR(sample.heading_rad, std::atan(0.1), 1e-6);
  EXPECT_NEAR(sample.baseline_m, std::sqrt(4.04), 1e-12);
}

}  // namespace heading_model_test
}  // namespace inslab::heading
