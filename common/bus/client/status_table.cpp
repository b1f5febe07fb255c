#include "inslab/bus/client/status_table.hpp"

#include <fmt/format.h>

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::client {

namespace {

constexpr std::size_t kColumns = 80;

/// The words in lines that fit, each begun with `indent`; a longer word is broken.
std::string wrapped(const std::string& words, const std::string& indent) {
  const std::size_t width = kColumns - indent.size();
  std::string text;
  for (std::size_t at = 0; at < words.size();) {
    std::size_t length = std::min(width, words.size() - at);
    if (at + length < words.size()) {
      const std::size_t space = words.rfind(' ', at + length);
      if (space != std::string::npos && space > at) length = space - at;
    }
    text += indent + words.substr(at, length) + "\n";
    at += length;
    while (at < words.size() && words[at] == ' ') ++at;
  }
  return text;
}

std::string rate_of(const Heartbeats& service, const StreamStatus& stream) {
  const double passed_s = time::to_seconds(service.last.realtime_ns - service.before.realtime_ns);
  for (const StreamStatus& before : service.before.streams) {
    if (before.topic != stream.topic || before.direction != stream.direction || passed_s <= 0.0) continue;
    if (stream.samples < before.samples) break;  // another run has begun
    return fmt::format("{:.1f}", static_cast<double>(stream.samples - before.samples) / passed_s);
  }
  return "-";
}

}  // namespace

std::string run_table(const std::optional<SimStatus>& run, const std::optional<VehicleLink>& vehicle,
                      const std::string& where) {
  std::string text;
  if (run) {
    text = wrapped(fmt::format("run: {} {} at {:.3f} s, {} truth samples, {} journal entries, {} overruns, largest "
                               "lag {:.3f} ms",
                               run->scenario, enum_name(run->state), time::to_seconds(run->sim_time_ns),
                               run->truth_samples, run->journal_entries, run->overruns, run->lag_max_s * 1e3),
                   "");
    text += wrapped(run->message, "     ");
  } else {
    text = wrapped("run: no trajectory server was heard on " + where, "");
  }
  if (vehicle) {
    text += wrapped(fmt::format("vehicle: {} states received, {} used; {} missing, {} late, {} refused; {} truth "
                                "samples extrapolated",
                                vehicle->received, vehicle->used, vehicle->missing, vehicle->late, vehicle->refused,
                                vehicle->truth_samples_extrapolated),
                    "");
  }
  return text;
}

std::string service_table(const std::vector<Heartbeats>& services,
                          const std::vector<std::pair<std::string, std::uint32_t>>& missing) {
  std::string text =
      fmt::format("{:<26}{:>7}  {:<9}{:>12}{:>9}{:>9}\n", "service", "sensor", "state", "sim s", "pid", "RSS MB");
  for (const Heartbeats& service : services) {
    const ServiceStatus& status = service.last;
    text += fmt::format("{:<26.26}{:>7}  {:<9}{:>12.3f}{:>9}{:>9.1f}\n", status.service, status.sensor_number,
                        enum_name(status.state), time::to_seconds(status.sim_time_ns), status.pid,
                        static_cast<double>(status.rss_bytes) * 1e-6);
    text += wrapped(status.message, "    ");
    if (status.refused_messages > 0) {
      text +=
          fmt::format("    refused {} messages whose bytes are not what their type says\n", status.refused_messages);
    }
  }
  for (const auto& [service, number] : missing) text += fmt::format("{:<26}{:>7}  MISSING\n", service, number);
  return text;
}

std::string stream_table(const std::vector<Heartbeats>& services) {
  std::string text = fmt::format("\n{:<28}{:<4}{:>12}{:>9}{:>9}{:>9}{:>9}\n", "stream", "", "samples", "rate Hz",
                                 "lost", "p50 ms", "p99 ms");
  for (const Heartbeats& service : services) {
    if (service.last.streams.empty()) continue;
    text += fmt::format("{} {}\n", service.last.service, service.last.sensor_number);
    for (const StreamStatus& stream : service.last.streams) {
      const bool out = stream.direction == StreamDirection::Out;
      const auto ms = [out](double latency_s) {
        return out || latency_s < 0.0 ? std::string("-") : fmt::format("{:.3f}", latency_s * 1e3);
      };
      text +=
          fmt::format("  {:<26.26}{:<4}{:>12}{:>9}{:>9}{:>9}{:>9}\n", stream.topic, out ? "out" : "in", stream.samples,
                      rate_of(service, stream), stream.lost, ms(stream.latency_p50_s), ms(stream.latency_p99_s));
    }
  }
  return text;
}

}  // namespace inslab::client
