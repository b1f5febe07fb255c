#include "inslab/bus/client/status_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace inslab::client {
namespace status_table_test {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

std::size_t widest_line(const std::string& text) {
  std::istringstream lines(text);
  std::size_t widest = 0;
  for (std::string line; std::getline(lines, line);) widest = std::max(widest, line.size());
  return widest;
}

/// A service after a day at 1 kHz, with all that it can say.
Heartbeats busy_service() {
  Heartbeats service;
  service.last.service = "inslab-trajectory-server";
  service.last.state = ServiceState::Finished;
  service.last.sensor_number = 7;
  service.last.sim_time_ns = 86'400'000'000'000;
  service.last.realtime_ns = 2'000'000'000;
  service.last.pid = 4'194'303;
  service.last.rss_bytes = 123'456'789'000;
  service.last.message = std::string(100, 'x') + " and words enough to go over the end of the line more than once";
  service.last.refused_messages = 4'000'000'000;
  StreamStatus stream;
  stream.topic = "inslab/vehicle_state_used";
  stream.samples = 86'400'000;
  stream.lost = 1'234'567;
  stream.latency_p50_s = 0.000123;
  stream.latency_p99_s = 99.999;
  service.last.streams = {stream};
  service.before = service.last;
  service.before.realtime_ns = 1'000'000'000;
  service.before.streams[0].samples -= 1000;
  return service;
}

TEST(StatusTable, FitsATerminalOf80Columns) {
  SimStatus run;
  run.scenario = std::string(64, 's');
  run.sim_time_ns = 86'400'000'000'000;
  run.truth_samples = 86'400'000;
  run.overruns = 100'000;
  run.message = std::string(256, 'm');
  VehicleLink vehicle;
  vehicle.received = vehicle.used = vehicle.missing = vehicle.late = 86'400'000;
  EXPECT_LE(widest_line(run_table(run, vehicle, "")), 80U);
  EXPECT_LE(widest_line(run_table({}, {}, std::string("domain 232, unit '") + std::string(64, 'u') + "'")), 80U);
  EXPECT_LE(widest_line(service_table({busy_service()}, {{"inslab-trajectory-server", 0}})), 80U);
  EXPECT_LE(widest_line(stream_table({busy_service()})), 80U);
}

TEST(StatusTable, SaysWhatAServiceSaysAndWhoIsMissing) {
  Heartbeats logger;
  logger.last.service = "inslab-truth-logger";
  logger.last.state = ServiceState::Running;
  logger.last.message = "app: 12 solutions";
  const std::string text = service_table({logger}, {{"inslab-imu-injector", 3}});
  EXPECT_THAT(text, ContainsRegex("inslab-truth-logger +0 +running"));
  EXPECT_THAT(text, HasSubstr("\n    app: 12 solutions\n"));
  EXPECT_THAT(text, ContainsRegex("inslab-imu-injector +3 +MISSING"));
  EXPECT_THAT(text, Not(HasSubstr("refused")));
}

TEST(StatusTable, GivesTheRateBetweenTwoHeartbeats) {
  EXPECT_THAT(stream_table({busy_service()}),
              ContainsRegex("inslab/vehicle_state_used +in +86400000 +1000.0 +1234567"));
}

TEST(StatusTable, NamesThePlaceInWhichNoServerWasHeard) {
  EXPECT_EQ(run_table({}, {}, "domain 7"), "run: no trajectory server was heard on domain 7\n");
}

}  // namespace status_table_test
}  // namespace inslab::client
