#include "inslab/sim/other_runs.hpp"

namespace inslab::sim {

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
  // A run that ends just now is left within moments.
  constexpr time::Nanoseconds kTimeToLeave = std::chrono::milliseconds(1500);
  const bool alone = running_ && now - running_since_ > kTimeToLeave;
  return alone ? &*running_ : nullptr;
}

}  // namespace inslab::sim
