#include "app/status_board.hpp"

#include "app/host.hpp"

namespace inslab::app {

StatusBoard::StatusBoard(dds::Participant& participant, std::string service, std::uint32_t sensor_number,
                         std::function<void(ServiceStatus&)> fill)
    : participant_(participant), fill_(std::move(fill)), writer_(participant, dds::topics::service_status()) {
  status_.service = std::move(service);
  status_.sensor_number = sensor_number;
  status_.host = host_name();
  status_.pid = process_id();
}

void StatusBoard::tick() {
  constexpr time::Nanoseconds kPeriod = std::chrono::seconds(1);
  if (monotonic_now() - last_report_ >= kPeriod) report();
}

void StatusBoard::enter(ServiceState state, const std::string& message) {
  if (state == status_.state && message == status_.message) return;
  status_.state = state;
  status_.message = message.substr(0, 256);
  report();
}

void StatusBoard::report() {
  last_report_ = monotonic_now();
  status_.realtime_ns = realtime_now().count();
  status_.rss_bytes = resident_bytes();
  status_.refused_messages = participant_.refused_messages();
  status_.streams.clear();
  fill_(status_);
  if (!writer_.write(status_)) spdlog::warn("the status of {} could not be sent", status_.service);
}

}  // namespace inslab::app
