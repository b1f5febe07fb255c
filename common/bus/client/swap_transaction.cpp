#include "inslab/bus/client/swap_transaction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "inslab/bus/client/run_client.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/foundation/text/shown.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::client {

namespace {

constexpr double kBeyond_s = 10.0;  // the last word of a run

std::string words_of_wait(const catalog::AnyProfile& swap, const RunLink& link) {
  const std::int64_t at_ns = catalog::request_of(swap).apply_at_ns;
  std::string words = "the first sample of " + catalog::sensor_name(catalog::target_of(swap)) + " under the swap";
  if (at_ns >= 0) words += fmt::format(" at {:g} s", time::to_seconds(at_ns));
  if (const auto status = link.status()) {
    words +=
        fmt::format("; the run is {} at {:.1f} s", enum_name(status->state), time::to_seconds(status->sim_time_ns));
  }
  return words;
}

/// Waits for what becomes of a swap; nothing when patience ends or the wait is interrupted.
std::optional<ProfileAck> awaited(const catalog::AnyProfile& swap, const RunLink& link, Patience& patience,
                                  const Pace& pace) {
  const std::uint64_t id = catalog::request_of(swap).request_id;
  LongWait wait;
  for (auto acks = link.acks(id);; acks = link.acks(id)) {
    if (!acks.empty()) return acks.front();
    if (pace.interrupted() || patience.is_over(pace.now())) return std::nullopt;
    patience.hear(link, pace.now());
    wait.tell(words_of_wait(swap, link));
    pace.rest();
  }
}

bool is_found(const RunLink& link, const std::string& server, const Patience& patience, const Pace& pace) {
  LongWait wait;
  while (!link.connected()) {
    if (patience.is_over(pace.now()) || pace.interrupted()) return false;
    wait.tell(server);
    pace.rest();
  }
  return true;
}

}  // namespace

Patience::Patience(std::optional<double> timeout_s, time::Nanoseconds now)
    : limited_(timeout_s.has_value()), end_(now + time::from_seconds(timeout_s.value_or(kBeyond_s))) {}

void Patience::hear(const RunLink& link, time::Nanoseconds now) {
  const std::uint64_t statuses = link.statuses();
  const auto status = link.status();
  if (status && run_id_ == RunId{}) run_id_ = status->run_id;
  const bool ended = status && (has_ended(status->state) || status->run_id != run_id_);
  const bool going_on = statuses != statuses_ && status && !ended;
  if (going_on && !limited_) end_ = now + time::from_seconds(kBeyond_s);
  // What was said before the end may still be on its way.
  if (ended && !ended_) end_ = std::min(end_, now + time::Nanoseconds(std::chrono::seconds(2)));
  ended_ = ended_ || ended;
  statuses_ = statuses;
}

Pace pace_of_this_process() {
  return {host::monotonic_now, [] { std::this_thread::sleep_for(std::chrono::milliseconds(5)); },
          host::shutdown_requested};
}

SwapsPlayed play_swaps(RunLink& link, const std::vector<catalog::AnyProfile>& swaps, std::optional<double> timeout_s,
                       const std::string& where, const std::function<void(const ProfileAck&)>& told, const Pace& pace) {
  Patience patience(timeout_s, pace.now());
  const std::string server = "a trajectory server on " + where;
  if (!is_found(link, server, patience, pace)) return {false, server + " was not found"};
  for (const catalog::AnyProfile& swap : swaps) {
    if (!link.send(swap)) return {false, "a request could not be sent"};
  }
  bool in_effect = true;
  for (const catalog::AnyProfile& swap : swaps) {
    const auto ack = awaited(swap, link, patience, pace);
    if (!ack) return {false, "not acknowledged: " + words_of_wait(swap, link) + " did not come"};
    told(*ack);
    in_effect = in_effect && is_in_effect(*ack);
  }
  return {in_effect, ""};
}

bool is_in_effect(const ProfileAck& ack) {
  return ack.outcome != AckOutcome::Rejected && ack.outcome != AckOutcome::Superseded;
}

std::string words_of(const ProfileAck& ack) {
  if (ack.outcome == AckOutcome::Rejected) {
    return fmt::format("rejected: {}: {}", text::shown(ack.field), text::shown(ack.reason));
  }
  return fmt::format("{} at {:.9f} s; first sample under it {:.9f} s, sequence {}{}", enum_name(ack.outcome),
                     time::to_seconds(ack.apply_time_ns), time::to_seconds(ack.first_sample_time_ns),
                     ack.first_sequence, ack.requested_in_the_past ? "; the time asked for had passed" : "");
}

}  // namespace inslab::client
