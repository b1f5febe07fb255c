#include "app/status_board.hpp"

#include "app/host.hpp"

namespace inslab::app {

StatusBoard::StatusBoard(Context& context, std::uint32_t sensor_number, std::function<void(ServiceStatus&)> fill)
    : context_(context), fill_(std::move(fill)), writer_(context.participant(), dds::topics::service_status()) {
  status_.service = context.service();
  status_.sensor_number = sensor_number;
  status_.host = context.identity().host;
  status_.pid = context.identity().pid;
}

void StatusBoard::tick() {
  constexpr time::Nanoseconds kPeriod = std::chrono::seconds(1);
  if (monotonic_now() - last_report_ >= kPeriod || context_.writers().fault() != fault_) report();
}

void StatusBoard::enter(ServiceState state, const std::string& message) {
  if (state == state_ && message == message_) return;
  state_ = state;
  message_ = message;
  report();
}

void StatusBoard::report() {
  last_report_ = monotonic_now();
  status_.realtime_ns = realtime_now().count();
  status_.rss_bytes = resident_bytes();
  status_.refused_messages = context_.participant().refused_messages();
  status_.streams.clear();
  fill_(status_);
  fault_ = context_.writers().fault();
  const bool spoiled = !fault_.empty();
  status_.state = spoiled && state_ == ServiceState::Finished ? ServiceState::Fault : state_;
  const bool says_the_fault = spoiled && (message_.empty() || status_.state == ServiceState::Fault);
  status_.message = (says_the_fault ? fault_ : message_).substr(0, 256);
  if (!writer_.write(status_)) spdlog::warn("the status of {} could not be sent", status_.service);
}

}  // namespace inslab::app
