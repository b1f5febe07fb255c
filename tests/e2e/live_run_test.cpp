#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/e2e/logged_samples.hpp"
#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace live_run_test {

using std::chrono::seconds;
using testing::ContainsRegex;
using testing::HasSubstr;

class LiveRun : public testing::TestWithParam<const char*> {};

TEST_P(LiveRun, GivesTheBitsOfTheOfflineRun) {
  const TestFolder folder;
  const std::string scenario = source("tests/data/short.json");
  Process live("inslab",
               {"run", scenario, "--log", folder / "live.mcap", "--domain", own_domain(), "--transport", GetParam()});
  // Exit 0 also means: nothing lost, every swap acknowledged and borne out by the samples.
  ASSERT_EQ(live.wait(seconds(60)), 0) << live.output();
  Process offline("inslab", {"simulate", scenario, "-o", folder / "offline"});
  ASSERT_EQ(offline.wait(seconds(60)), 0) << offline.output();

  expect_same_run(folder / "live.mcap", folder / "offline/short.mcap");
}

INSTANTIATE_TEST_SUITE_P(Transports, LiveRun, testing::Values("udp", "shm"),
                         [](const auto& instance) { return std::string(instance.param); });

TEST(LiveRun, AlongTheRowsOfAFileGivesTheBitsOfTheOfflineRun) {
  const TestFolder folder;
  const std::string scenario = source("tests/data/from_file.json");
  Process live("inslab", {"run", scenario, "--log", folder / "live.mcap", "--domain", own_domain()});
  ASSERT_EQ(live.wait(seconds(60)), 0) << live.output();
  Process offline("inslab", {"simulate", scenario, "-o", folder / "offline"});
  ASSERT_EQ(offline.wait(seconds(60)), 0) << offline.output();

  const std::string live_log = folder / "live.mcap";
  const std::string offline_log = folder / "offline/from_file.mcap";
  expect_same_bits<TruthState>(live_log, offline_log, "inslab/truth", 1601);
  expect_same_bits<ImuSample>(live_log, offline_log, "inslab/imu/0", 1600);
  expect_same_bits<GnssFix>(live_log, offline_log, "inslab/gnss/0", 80);
}

TEST(LiveRun, OfTwoImusAndTwoAntennasGivesTheBitsOfTheOfflineRun) {
  // One injector process per IMU, one emulator per receiver; swaps go to imu1, gnss1 and imu0. A unit with a name.
  const TestFolder folder;
  const std::string scenario = source("config/scenarios/two_imus_two_antennas.json");
  Process live("inslab", {"run", scenario, "--log", folder / "live.mcap", "--domain", own_domain(), "--unit", "left"});
  Process offline("inslab", {"simulate", scenario, "--unit", "left", "-o", folder / "offline"});
  ASSERT_EQ(live.wait(seconds(80)), 0) << live.output();
  ASSERT_EQ(offline.wait(seconds(60)), 0) << offline.output();

  const std::string live_log = folder / "live.mcap";
  const std::string offline_log = folder / "offline/two_imus_two_antennas.mcap";
  expect_same_bits<ImuSample>(live_log, offline_log, "inslab/imu/0", 3200);
  expect_same_bits<ImuTruth>(live_log, offline_log, "inslab/imu_truth/0", 3200);
  expect_same_bits<ImuSample>(live_log, offline_log, "inslab/imu/1", 1600);
  expect_same_bits<ImuTruth>(live_log, offline_log, "inslab/imu_truth/1", 1600);
  expect_same_bits<GnssFix>(live_log, offline_log, "inslab/gnss/0", 125);
  // Twice 0.5 s without signals and 0.5 s until the first fix after it: five epochs each time.
  expect_same_bits<GnssFix>(live_log, offline_log, "inslab/gnss/1", 70);
}

TEST(LiveRun, WithAMagnetometerGivesTheBitsOfTheOfflineRun) {
  const TestFolder folder;
  const std::string scenario = source("config/scenarios/magnetometer.json");
  Process live("inslab",
               {"run", scenario, "--log", folder / "live.mcap", "--domain", own_domain(), "--clock", "lockstep"});
  Process offline("inslab", {"simulate", scenario, "-o", folder / "offline"});
  // Exit 0 also means: nothing lost, both swaps acknowledged and borne out by the samples.
  ASSERT_EQ(live.wait(seconds(80)), 0) << live.output();
  ASSERT_EQ(offline.wait(seconds(60)), 0) << offline.output();
  EXPECT_THAT(live.output(), HasSubstr("swap 1: magnetometer_error 'uncalibrated' for magnetometer0"));
  EXPECT_THAT(live.output(), HasSubstr("hard iron x"));
  expect_same_bits<MagneticField>(folder / "live.mcap", folder / "offline/magnetometer.mcap", "inslab/magnetometer/0",
                                  3000);
}

TEST(LiveRun, WithABarometerAndOdometersGivesTheBitsOfTheOfflineRun) {
  const TestFolder folder;
  const std::string scenario = source("config/scenarios/aiding.json");
  Process live("inslab",
               {"run", scenario, "--log", folder / "live.mcap", "--domain", own_domain(), "--clock", "lockstep"});
  Process offline("inslab", {"simulate", scenario, "-o", folder / "offline"});
  // Exit 0 also means: nothing lost, all swaps acknowledged and borne out by the samples.
  ASSERT_EQ(live.wait(seconds(80)), 0) << live.output();
  ASSERT_EQ(offline.wait(seconds(60)), 0) << offline.output();
  EXPECT_THAT(live.output(), HasSubstr("barometer_error 'ms5611' for barometer0"));
  EXPECT_THAT(live.output(), HasSubstr("pressure offset"));
  EXPECT_THAT(live.output(), HasSubstr("odometer_error 'abs_sensor' for odometer1"));
  EXPECT_THAT(live.output(), HasSubstr("scale factor of the wheel"));
  const std::string offline_log = folder / "offline/aiding.mcap";
  expect_same_bits<AirPressure>(folder / "live.mcap", offline_log, "inslab/barometer/0", 1500);
  expect_same_bits<WheelTravel>(folder / "live.mcap", offline_log, "inslab/odometer/0", 3000);
  expect_same_bits<WheelTravel>(folder / "live.mcap", offline_log, "inslab/odometer/1", 1500);
}

TEST(LiveRun, WithReceiversOfTwoAntennasGivesTheBitsOfTheOfflineRun) {
  const TestFolder folder;
  const std::string scenario = source("config/scenarios/two_antennas.json");
  Process live("inslab",
               {"run", scenario, "--log", folder / "live.mcap", "--domain", own_domain(), "--clock", "lockstep"});
  Process offline("inslab", {"simulate", scenario, "-o", folder / "offline"});
  // Exit 0 also means: nothing lost, all swaps acknowledged and borne out by the samples.
  ASSERT_EQ(live.wait(seconds(80)), 0) << live.output();
  ASSERT_EQ(offline.wait(seconds(60)), 0) << offline.output();
  EXPECT_THAT(live.output(), HasSubstr("heading_error 'zed_f9p_moving_base' for heading0"));
  EXPECT_THAT(live.output(), HasSubstr("horizontal noise of the baseline"));
  EXPECT_THAT(live.output(), HasSubstr("baseline forward"));
  const std::string offline_log = folder / "offline/two_antennas.mcap";
  expect_same_bits<BaselineHeading>(folder / "live.mcap", offline_log, "inslab/heading/0", 380);
  expect_same_bits<BaselineHeading>(folder / "live.mcap", offline_log, "inslab/heading/1", 200);
}

TEST(LiveRun, WithAirDataProbesGivesTheBitsOfTheOfflineRun) {
  const TestFolder folder;
  const std::string scenario = source("config/scenarios/air_data.json");
  Process live("inslab",
               {"run", scenario, "--log", folder / "live.mcap", "--domain", own_domain(), "--clock", "lockstep"});
  Process offline("inslab", {"simulate", scenario, "-o", folder / "offline"});
  // Exit 0 also means: nothing lost, all swaps acknowledged and borne out by the samples.
  ASSERT_EQ(live.wait(seconds(80)), 0) << live.output();
  ASSERT_EQ(offline.wait(seconds(60)), 0) << offline.output();
  EXPECT_THAT(live.output(), HasSubstr("air_data_error 'sdp33_rough_air' for air_data0"));
  EXPECT_THAT(live.output(), HasSubstr("impact pressure noise"));
  const std::string offline_log = folder / "offline/air_data.mcap";
  expect_same_bits<Airflow>(folder / "live.mcap", offline_log, "inslab/air_data/0", 2500);
  expect_same_bits<AirflowTruth>(folder / "live.mcap", offline_log, "inslab/air_data_truth/1", 1000);
}

TEST(LiveRun, WithPulsesPerSecondGivesTheBitsOfTheOfflineRun) {
  const TestFolder folder;
  const std::string scenario = source("config/scenarios/pulses.json");
  Process live("inslab",
               {"run", scenario, "--log", folder / "live.mcap", "--domain", own_domain(), "--clock", "lockstep"});
  Process offline("inslab", {"simulate", scenario, "-o", folder / "offline"});
  ASSERT_EQ(live.wait(seconds(80)), 0) << live.output();
  ASSERT_EQ(offline.wait(seconds(60)), 0) << offline.output();
  const std::string offline_log = folder / "offline/pulses.mcap";
  expect_same_bits<PulsePerSecond>(folder / "live.mcap", offline_log, "inslab/gnss_pps/0", 23);
  expect_same_bits<PulseTruth>(folder / "live.mcap", offline_log, "inslab/gnss_pps_truth/0", 23);
}

TEST(LiveRun, SummaryNamesStreamsSwapsAndLog) {
  const TestFolder folder;
  Process live("inslab",
               {"run", source("tests/data/short.json"), "--log", folder / "live.mcap", "--domain", own_domain()});
  ASSERT_EQ(live.wait(seconds(60)), 0) << live.output();
  const std::string output = live.output();
  EXPECT_THAT(output, HasSubstr("inslab/imu/0"));
  EXPECT_THAT(output, HasSubstr("swap 1: imu_error 'mems_automotive' for imu0: applied at 2.000 s"));
  // 2.003 s lies between two samples of the truth and inside an interval of the 50 Hz IMU, which ends it first.
  EXPECT_THAT(output, HasSubstr("for imu3: applied at 2.005 s, first sample under it 2.040 s, sequence 101"));
  EXPECT_THAT(output, HasSubstr("checks held"));
  EXPECT_THAT(output, HasSubstr("log " + (folder / "live.mcap")));
}

TEST(LiveRun, BadScenarioEndsWithTwoBeforeAnythingStarts) {
  Process live("inslab", {"run", source("tests/data/broken.json")});
  EXPECT_EQ(live.wait(seconds(10)), 2);
  EXPECT_THAT(live.output(), HasSubstr("broken.json: trajectory.initial.latitude_deg: is 95; expected"));
}

TEST(LiveRun, StoppedByCtrlCClosesItsLog) {
  const TestFolder folder;
  Process live("inslab",
               {"run", source("tests/data/short.json"), "--log", folder / "live.mcap", "--domain", own_domain()});
  ASSERT_TRUE(live.prints("s\n", seconds(20)));
  ASSERT_TRUE(live.prints("short: 2", seconds(20))) << live.output();
  live.send(SIGINT);
  EXPECT_EQ(live.wait(seconds(20)), 1) << live.output();
  EXPECT_THAT(live.output(), HasSubstr("result: FAILED, exit code 1: stopped by a signal"));
  EXPECT_TRUE(mcap::McapReader(folder / "live.mcap").closed_properly());
}

TEST(LiveRun, OfWhichAServiceIsToldToStopSaysWhichAndWhenAndFails) {
  const TestFolder folder;
  Process live("inslab",
               {"run", source("tests/data/short.json"), "--log", folder / "live.mcap", "--domain", own_domain()});
  ASSERT_TRUE(live.prints("short: 2", seconds(30))) << live.output();
  const auto injectors = children_named(live.pid(), "inslab-imu-injector");
  ASSERT_EQ(injectors.size(), 2U);
  kill(injectors.front(), SIGTERM);
  EXPECT_EQ(live.wait(seconds(40)), 1) << live.output();
  EXPECT_THAT(live.output(),
              ContainsRegex("inslab-imu-injector [03] ended with exit code 1 in mid-run, at about [0-9.]+ s"));
  EXPECT_THAT(live.output(),
              ContainsRegex("FAILED: inslab-imu-injector fault: ended by a signal in mid-run, after truth"));
  EXPECT_THAT(live.output(), ContainsRegex("\nresult: FAILED, exit code 1: inslab-imu-injector [^\n]*\n$"));
}

TEST(LiveRun, StoppedWhileItWaitsSaysForWhom) {
  const TestFolder folder;
  Process server("inslab-trajectory-server",
                 {"--scenario", source("tests/data/short.json"), "--domain", own_domain(), "--log-level", "info"});
  ASSERT_TRUE(server.running());
  pause_between_looks();
  ASSERT_TRUE(eventually([&] { return server.running(); }, seconds(5)));
  Process stop("inslab", {"stop", "--domain", own_domain()});
  EXPECT_EQ(stop.wait(seconds(20)), 0) << stop.output();
  EXPECT_EQ(server.wait(seconds(20)), 0) << server.output();
  EXPECT_THAT(server.output(), HasSubstr("stopped: 0 truth samples"));
  EXPECT_THAT(server.output(), HasSubstr("stopped while it waited for inslab-imu-injector (sensor 0)"));
}

TEST(LiveRun, ASwapThatIsRefusedOnTheWayDoesNotFailTheRunAndOneAfterItsEndIsRefused) {
  const TestFolder folder;
  Process live("inslab",
               {"run", source("tests/data/short.json"), "--log", folder / "live.mcap", "--domain", own_domain()});
  ASSERT_TRUE(live.prints("short: 2", seconds(30))) << live.output();
  Process swap("inslab",
               {"swap", "imu", source("config/profiles/imu/pos830.json"), "--at", "8", "--domain", own_domain()});
  EXPECT_EQ(swap.wait(seconds(20)), 3) << swap.output();
  EXPECT_THAT(swap.output(),
              HasSubstr("rejected: request.apply_at_ns: lies at or after the end of the run at 8.000 s"));
  EXPECT_EQ(live.wait(seconds(40)), 0) << live.output();
  EXPECT_THAT(live.output(), HasSubstr("(not one of the scenario's swaps)"));
}

TEST(LiveRun, SummaryOfASimulatedLogPasses) {
  const TestFolder folder;
  Process simulate("inslab", {"simulate", source("tests/data/short.json"), "-o", folder / ""});
  ASSERT_EQ(simulate.wait(seconds(60)), 0) << simulate.output();
  Process summary("inslab", {"summary", folder / "short.mcap"});
  EXPECT_EQ(summary.wait(seconds(60)), 0) << summary.output();
  EXPECT_THAT(summary.output(), HasSubstr("simulated in one process"));
  EXPECT_THAT(summary.output(), ContainsRegex("\nresult: passed: [0-9]+ of [0-9]+ checks held\n$"));
}

TEST(OutputFiles, NoFormatReplacesTheLogThatItReadsAndNoResultIsReplacedUnasked) {
  const TestFolder folder;
  Process simulate("inslab", {"simulate", source("tests/data/short.json"), "-o", folder / ""});
  ASSERT_EQ(simulate.wait(seconds(60)), 0) << simulate.output();
  const std::string log = folder / "short.mcap";
  const auto run = [](const std::vector<std::string>& arguments) {
    Process process("inslab", arguments);
    const int code = process.wait(seconds(60)).value_or(-1);
    return std::to_string(code) + ": " + process.output();
  };
  for (const std::string format : {"csv", "hdf5", "nav", "imu", "gnss", "kml", "novatel"}) {
    std::vector<std::string> arguments{"export", log, "--format", format, "-o", log, "--overwrite"};
    if (format == "imu" || format == "novatel") arguments.insert(arguments.end(), {"--topic", "inslab/imu/0"});
    EXPECT_THAT(run(arguments), testing::StartsWith("2: ")) << format;
    ASSERT_TRUE(mcap::McapReader(log).closed_properly()) << format;
  }
  EXPECT_THAT(run({"report", log, "--junit", log, "--overwrite"}), HasSubstr("is an input of this command"));
  EXPECT_THAT(run({"simulate", source("tests/data/short.json"), "-o", folder / ""}),
              HasSubstr("short.mcap: is there already and is kept; --overwrite replaces it"));
  EXPECT_THAT(run({"simulate", source("tests/data/short.json"), "-o", folder / "", "--overwrite"}),
              testing::StartsWith("0: "));
  EXPECT_THAT(run({"run", source("tests/data/short.json"), "--log", log, "--domain", own_domain()}),
              testing::StartsWith("2: "))
      << "before anything is started";
  EXPECT_TRUE(mcap::McapReader(log).closed_properly());
}

}  // namespace live_run_test
}  // namespace inslab::e2e
