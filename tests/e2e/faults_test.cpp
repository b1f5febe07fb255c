// Faults that begin and end in mid-run, of a set of processes in lockstep: config/scenarios/faults.json.

#include <gtest/gtest.h>

#include <set>

#include "tests/e2e/logged_samples.hpp"
#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace faults_test {

using std::chrono::seconds;

template <class Sample>
void expect_the_bits(const std::string& log, const std::string& reference, const std::string& topic,
                     std::size_t at_least) {
  const std::size_t samples = samples_of<Sample>(reference, topic).size();
  EXPECT_GE(samples, at_least) << topic;
  expect_same_bits<Sample>(log, reference, topic, samples);
}

template <class Sample, class Use>
void in_between(const std::vector<Sample>& samples, double from_s, double until_s, const Use& use) {
  for (const Sample& sample : samples) {
    const double at_s = 1e-9 * static_cast<double>(sample.header.sim_time_ns);
    if (at_s > from_s + 1e-6 && at_s < until_s + 1e-6) use(sample);
  }
}

/// Of the reference navigation app, which takes the receiver, the magnetometer and the barometer.
std::vector<std::vector<std::uint8_t>> solutions_of(const std::string& log) {
  std::vector<std::vector<std::uint8_t>> all;
  for (const NavSolution& solution : samples_of_kind<NavSolution>(log, "inslab/nav")) {
    wire::encode(solution, all.emplace_back());
  }
  return all;
}

TEST(Faults, ThatBeginAndEndInMidRunAreThoseOfTheOfflineRunInLockstepAndTheAppLivesThroughThem) {
  const TestFolder folder;
  const std::string scenario = source("config/scenarios/faults.json");
  const std::string log = folder / "live.mcap", reference = folder / "offline/faults.mcap";
  Process offline("inslab", {"simulate", scenario, "-o", folder / "offline"});
  ASSERT_EQ(offline.wait(seconds(60)), 0) << offline.output();
  Process run("inslab", {"run", scenario, "--log", log, "--domain", own_domain(), "--clock", "lockstep"});
  ASSERT_EQ(run.wait(seconds(90)), 0) << run.output();

  expect_the_bits<TruthState>(log, reference, "inslab/truth", 6001);
  expect_the_bits<ImuSample>(log, reference, "inslab/imu/0", 6000);
  expect_the_bits<ImuTruth>(log, reference, "inslab/imu_truth/0", 6000);
  expect_the_bits<GnssFix>(log, reference, "inslab/gnss/0", 140);
  expect_the_bits<MagneticField>(log, reference, "inslab/magnetometer/0", 3000);
  expect_the_bits<AirPressure>(log, reference, "inslab/barometer/0", 1500);
  expect_the_bits<WheelTravel>(log, reference, "inslab/odometer/0", 2700);
  EXPECT_EQ(solutions_of(log), solutions_of(reference));
  EXPECT_GT(solutions_of(log).size(), 5000u);

  std::set<double> latitudes;
  in_between(samples_of<GnssFix>(log, "inslab/gnss/0"), 14.0, 17.0,
             [&latitudes](const GnssFix& fix) { latitudes.insert(fix.latitude_rad); });
  EXPECT_EQ(latitudes.size(), 1u) << "the fix sticks";
  std::size_t travels = 0;
  in_between(samples_of<WheelTravel>(log, "inslab/odometer/0"), 16.0, 22.0, [&travels](const auto&) { ++travels; });
  EXPECT_EQ(travels, 300u) << "half of 6 s at 100 Hz";
  in_between(samples_of<AirPressure>(log, "inslab/barometer/0"), 18.0, 21.7, [](const AirPressure& sample) {
    EXPECT_EQ(sample.available_sim_time_ns, sample.header.sim_time_ns + 300'000'000);
  });
  double largest_nt = 0.0;
  in_between(samples_of<MagneticField>(log, "inslab/magnetometer/0"), 20.0, 22.0,
             [&](const auto& sample) { largest_nt = std::max(largest_nt, sample.B_b_nt.cwiseAbs().maxCoeff()); });
  EXPECT_GT(largest_nt, 150e3) << "of 200 draws of three axes up to 200e3";
}

}  // namespace faults_test
}  // namespace inslab::e2e
