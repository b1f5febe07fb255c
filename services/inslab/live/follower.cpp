#include "inslab/services/inslab/live/follower.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "inslab/foundation/host/host.hpp"

namespace inslab::live {

using std::chrono::seconds;

Follower::Follower(client::RunLink& link, Options options, Audience audience, time::Nanoseconds now)
    : link_(link), options_(std::move(options)), audience_(std::move(audience)), begun_at_(now), heard_at_(now) {}

std::optional<Follower::Ending> Follower::step(time::Nanoseconds now) {
  const auto status = link_.status();
  if (const auto why = silence(status, now)) return Ending{false, *why};
  if (const std::string why = link_.other_run(); !why.empty()) return Ending{false, why};
  if (!status) return std::nullopt;
  say_whose_it_is(*status);
  say_when_it_begins(*status);
  if (status->state != RunState::Waiting) audience_.progress(time::Nanoseconds(status->sim_time_ns));
  if (has_ended(status->state)) {
    audience_.event("ends");
    return end(*status);
  }
  send_swaps();
  release(*status, now);
  return std::nullopt;
}

Follower::Ending Follower::end(const SimStatus& status) const {
  if (next_swap_ < options_.swaps.size()) return {false, "the run ended before all swaps were sent"};
  if (status.state == RunState::Finished) return {true, ""};
  return {false, fmt::format("the run did not finish: {}{}", enum_name(status.state),
                             status.message.empty() ? "" : ": " + status.message)};
}

/// Why there is nothing more to wait for; a wait of more than two seconds says what it is for.
std::optional<std::string> Follower::silence(const std::optional<SimStatus>& status, time::Nanoseconds now) {
  if (link_.statuses() != statuses_) {
    statuses_ = link_.statuses();
    heard_at_ = now;
  }
  if (!status && !told_ && now - begun_at_ > seconds(2)) {
    told_ = true;
    audience_.word("waits for a trajectory server in " + options_.where);
  }
  if (now - heard_at_ < time::from_seconds(options_.timeout_s)) return std::nullopt;
  return fmt::format("{} within {:g} s", status ? "no word of the trajectory server" : "no trajectory server was found",
                     options_.timeout_s);
}

/// When the run is heard first.
void Follower::say_whose_it_is(const SimStatus& status) {
  if (!said_run_) audience_.event("run " + host::run_id_text(status.run_id));
  said_run_ = true;
}

void Follower::say_when_it_begins(const SimStatus& status) {
  const bool begun =
      status.state == RunState::Running || status.state == RunState::Paused || status.state == RunState::Finished;
  if (!begun || begun_) return;
  begun_ = true;
  audience_.event("begins");
}

void Follower::send_swaps() {
  const auto& swaps = options_.swaps;
  while (next_swap_ < swaps.size() && link_.connected() && link_.send(swaps[next_swap_])) ++next_swap_;
}

/// A run that was started paused goes on once each swap is in the journal, or refused: then none comes too late.
void Follower::release(const SimStatus& status, time::Nanoseconds now) {
  const auto& swaps = options_.swaps;
  if (!options_.release || next_swap_ < swaps.size() || !link_.connected()) return;
  const bool obeyed = status.state == RunState::Running || status.sim_time_ns > 0;
  if (obeyed) released_ = true;
  if (released_ || now < resume_again_at_) return;
  const auto refused = std::count_if(swaps.begin(), swaps.end(), [this](const catalog::AnyProfile& swap) {
    return !link_.acks(catalog::request_of(swap).request_id).empty();
  });
  if (status.journal_entries + static_cast<std::size_t>(refused) < swaps.size()) return;
  link_.send(SimCommand{host::random_id(), CommandKind::Resume, 0.0});
  resume_again_at_ = now + seconds(1);
}

}  // namespace inslab::live
