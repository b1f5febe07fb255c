#include "services/trajectory_server/other_runs.hpp"

namespace inslab::trajectory {

void OtherRuns::hear(const SimStatus& status) {
  if (status.run_id == own_ || has_ended(status.state)) return;
  const bool it_stays = status.state != RunState::Waiting || status.run_id.bytes < own_.bytes;
  if (it_stays) server_ = status;
}

void OtherRuns::hear(const ServiceStatus& status, time::Nanoseconds now) {
  const bool in_another_run =
      status.state == ServiceState::Running && status.run_id != own_ && status.run_id != RunId{};
  if (in_another_run) {
    if (!running_) running_since_ = now;
    running_ = status;
  } else if (running_ && running_->service == status.service && running_->sensor_number == status.sensor_number) {
    running_.reset();  // it has ended
  }
}

const ServiceStatus* OtherRuns::orphan(time::Nanoseconds now) const {
  // A server speaks ten times a second; discovery takes some tenths.
  constexpr time::Nanoseconds kTimeToHearTheServer = std::chrono::milliseconds(1500);
  const bool alone = running_ && !server_ && now - running_since_ > kTimeToHearTheServer;
  return alone ? &*running_ : nullptr;
}

}  // namespace inslab::trajectory
