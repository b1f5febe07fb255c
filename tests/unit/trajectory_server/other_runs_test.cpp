#include "services/trajectory_server/other_runs.hpp"

#include <gtest/gtest.h>

namespace inslab::trajectory {
namespace {

using std::chrono::milliseconds;
using time::Nanoseconds;

RunId run(std::uint8_t number) {
  RunId id;
  id.bytes.fill(number);
  return id;
}

SimStatus server(std::uint8_t number, RunState state) {
  SimStatus status;
  status.run_id = run(number);
  status.state = state;
  return status;
}

ServiceStatus service(std::uint8_t number, ServiceState state, const char* name = "inslab-imu-injector") {
  ServiceStatus status;
  status.service = name;
  status.run_id = run(number);
  status.state = state;
  return status;
}

TEST(OtherRuns, HearsAServerAtWork) {
  OtherRuns others(run(5));
  others.hear(server(5, RunState::Running));  // itself
  EXPECT_FALSE(others.server());
  others.hear(server(9, RunState::Finished));
  EXPECT_FALSE(others.server());
  others.hear(server(9, RunState::Paused));
  ASSERT_TRUE(others.server());
  EXPECT_EQ(others.server()->run_id, run(9));
}

TEST(OtherRuns, OfTwoServersThatWaitExactlyOneStays) {
  OtherRuns small(run(5));
  OtherRuns large(run(9));
  small.hear(server(9, RunState::Waiting));
  large.hear(server(5, RunState::Waiting));
  EXPECT_FALSE(small.server());
  EXPECT_TRUE(large.server());
}

TEST(OtherRuns, AServiceInARunThatNoServerSpeaksOfIsAnOrphanAfterAWhile) {
  OtherRuns others(run(5));
  others.hear(service(7, ServiceState::Running), Nanoseconds(0));
  EXPECT_EQ(others.orphan(milliseconds(1000)), nullptr);
  others.hear(service(7, ServiceState::Running), milliseconds(1000));
  const ServiceStatus* orphan = others.orphan(milliseconds(1600));
  ASSERT_NE(orphan, nullptr);
  EXPECT_EQ(orphan->run_id, run(7));
}

TEST(OtherRuns, AServiceWhoseServerSpeaksIsNone) {
  OtherRuns others(run(5));
  others.hear(service(7, ServiceState::Running), Nanoseconds(0));
  others.hear(server(7, RunState::Running));
  EXPECT_EQ(others.orphan(milliseconds(5000)), nullptr);
}

TEST(OtherRuns, AServiceThatEndsInTheMeantimeIsNone) {
  OtherRuns others(run(5));
  others.hear(service(7, ServiceState::Running), Nanoseconds(0));
  others.hear(service(7, ServiceState::Finished), milliseconds(1000));
  EXPECT_EQ(others.orphan(milliseconds(5000)), nullptr);
}

TEST(OtherRuns, AServiceThatWaitsForARunIsNone) {
  OtherRuns others(run(5));
  others.hear(service(0, ServiceState::Running), Nanoseconds(0));
  others.hear(service(7, ServiceState::Ready), Nanoseconds(0));
  others.hear(service(5, ServiceState::Running), Nanoseconds(0));
  EXPECT_EQ(others.orphan(milliseconds(5000)), nullptr);
}

}  // namespace
}  // namespace inslab::trajectory
