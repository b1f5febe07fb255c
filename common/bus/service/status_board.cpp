#include "inslab/bus/service/status_board.hpp"

#include <spdlog/spdlog.h>

#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/text/shown.hpp"

namespace inslab::service {

namespace {
constexpr std::size_t kLongestMessage = 256;  // of the wire type
}

StatusBoard::StatusBoard(Context& context, std::uint32_t sensor_number, std::function<void(ServiceStatus&)> fill)
    : context_(context), fill_(std::move(fill)), writer_(context.participant(), dds::topics::service_status()) {
  status_.service = context.service();
  status_.sensor_number = sensor_number;
  status_.host = context.identity().host;
  status_.pid = context.identity().pid;
}

void StatusBoard::tick() {
  constexpr time::Nanoseconds kPeriod = std::chrono::seconds(1);
  constexpr time::Nanoseconds kLongWait = std::chrono::seconds(2);
  if (state_ == ServiceState::Starting && !told_ && host::monotonic_now() - entered_ > kLongWait) {
    told_ = true;
    if (!message_.empty()) spdlog::info("{}", message_);
  }
  if (host::monotonic_now() - last_report_ >= kPeriod || context_.writers().fault() != fault_) report();
}

void StatusBoard::enter(ServiceState state, const std::string& message) {
  const std::string words = text::cut(text::shown(message), kLongestMessage);
  if (state == state_ && words == message_) return;
  state_ = state;
  message_ = words;
  entered_ = host::monotonic_now();
  told_ = false;
  report();
}

void StatusBoard::report() {
  last_report_ = host::monotonic_now();
  status_.realtime_ns = host::realtime_now().count();
  status_.rss_bytes = host::resident_bytes();
  status_.refused_messages = context_.participant().refused_messages();
  status_.message = message_;
  status_.streams.clear();
  status_.state = state_;
  fill_(status_);
  fault_ = context_.writers().fault();
  const bool spoiled = !fault_.empty();
  status_.state = spoiled && state_ == ServiceState::Finished ? ServiceState::Fault : state_;
  const bool says_the_fault = spoiled && (message_.empty() || status_.state == ServiceState::Fault);
  if (says_the_fault) status_.message = text::cut(text::shown(fault_), kLongestMessage);
  if (!writer_.write(status_)) spdlog::warn("the status of {} could not be sent", status_.service);
}

}  // namespace inslab::service
