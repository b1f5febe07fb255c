#include "inslab/sim/other_runs.hpp"

#include <gtest/gtest.h>

namespace inslab::sim {
namespace other_runs_test {

using std::chrono::milliseconds;
using time::Nanoseconds;

RunId run(std::uint8_t number) {
  RunId id;
  id.bytes.fill(number);
  return id;
}

ServiceStatus service(std::uint8_t number, ServiceState state, const char* name = "inslab-imu-injector") {
  ServiceStatus status;
  status.service = name;
  status.run_id = run(number);
  status.state = state;
  return status;
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

}  // namespace other_runs_test
}  // namespace inslab::sim
