#include "inslab/referee/evidence/run_summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>
#include <set>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::evidence {

namespace {

std::string milliseconds_of(double seconds) { return seconds < 0.0 ? "-" : fmt::format("{:.3f}", seconds * 1e3); }

/// What is said, line after line, and what does not hold, to be said at the end.
class Account {
 public:
  template <class... Arguments>
  void say(fmt::format_string<Arguments...> pattern, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), pattern, std::forward<Arguments>(arguments)...);
  }
  void require(bool holds, const std::string& otherwise) {
    ++checks_;
    if (!holds) broken_.push_back(otherwise);
  }
  void say_checks() {
    say("\n");
    for (const std::string& line : broken_) say("FAILED: {}\n", line);
    say("{}\n", held());
  }
  host::Outcome outcome() const {
    if (broken_.empty()) return {host::kOk, held()};
    return {host::kFailed,
            broken_.front() + (broken_.size() > 1 ? fmt::format(" (and {} more)", broken_.size() - 1) : "")};
  }
  const std::string& text() const { return text_; }

 private:
  std::string held() const { return fmt::format("{} of {} checks held", checks_ - broken_.size(), checks_); }

  std::string text_;
  std::size_t checks_ = 0;
  std::vector<std::string> broken_;
};

/// Written by `inslab simulate`: there were no services, and nobody said how the run goes.
bool is_offline(const LogSummary& summary) { return !summary.last_status && summary.services.empty(); }

/// What the scenario asked for has the numbers of its places in it, from 1 on; others draw theirs at random.
bool is_of_the_scenario(const ProfileAck& ack, const LogSummary& summary) {
  return ack.request_id >= 1 && ack.request_id <= summary.scenario.swaps.size();
}

void say_head(const LogSummary& summary, Account& account) {
  account.say("\n{}: {}\n", summary.scenario.name, summary.scenario.description);
  if (is_offline(summary)) account.say("simulated in one process: there are no services to check\n");
  if (!summary.last_status) return;
  const SimStatus& status = *summary.last_status;
  account.say("{} after {:.3f} s of sim time at {} Hz; {} overruns, largest lag {:.3f} ms{}\n", enum_name(status.state),
              time::to_seconds(status.sim_time_ns), summary.scenario.truth_rate_hz, status.overruns,
              status.lag_max_s * 1e3, status.message.empty() ? "" : "; " + status.message);
}

void say_streams(const LogSummary& summary, Account& account) {
  account.say("\n{:<26}{:>9}{:>10}{:>7}{:>14}{:>9}{:>9}{:>9}\n", "topic", "sent", "received", "lost", "out of order",
              "p50 ms", "p99 ms", "max ms");
  for (const auto& [topic, stream] : summary.streams) {
    const StreamStatus& logged = stream.logged;
    account.say("{:<26}{:>9}{:>10}{:>7}{:>14}{:>9}{:>9}{:>9}\n", topic,
                stream.sent           ? std::to_string(*stream.sent)
                : is_offline(summary) ? "-"
                                      : "unknown",
                logged.samples, logged.lost, logged.out_of_order, milliseconds_of(logged.latency_p50_s),
                milliseconds_of(logged.latency_p99_s), milliseconds_of(logged.latency_max_s));
    account.require(stream.sent.has_value() || is_offline(summary),
                    topic + ": its service did not finish, so what it sent is unknown");
    const std::uint64_t sent = stream.sent.value_or(0), arrived = logged.samples - logged.duplicates;
    // A navigation app that was started again knows only of its own solutions.
    const bool complete = topic == catalog::kNav.name ? arrived >= sent : arrived == sent;
    account.require(!stream.sent || complete, fmt::format("{}: {} sent, {} received", topic, sent, arrived));
    // A service that was started again may send its last sample once more.
    account.require(logged.lost == 0 && (logged.duplicates == 0 || !summary.recoveries.empty()),
                    fmt::format("{}: {} lost, {} twice", topic, logged.lost, logged.duplicates));
  }
  account.say("latency: from the writer's publish time to receipt by the logger\n");
  // A writer is known to its readers before it knows them: what an app says meanwhile, if only in lockstep's first
  // moments, is heard by nobody.
  account.require(!summary.scenario.require_nav_app || is_offline(summary) || summary.nav_solutions > 0,
                  fmt::format("{}: the scenario requires a navigation app, and no solution of one came to the log",
                              catalog::kNav.name));
}

void say_services(const LogSummary& summary, Account& account) {
  if (summary.services.empty()) return;
  account.say("\n{:<30}{:>8}{:>10}{:>8}{:>12}\n", "service", "sensor", "state", "RSS MB", "queue depth");
  for (const ServiceStatus& status : summary.services) {
    account.say("{:<30}{:>8}{:>10}{:>8.1f}{:>12}\n", status.service, status.sensor_number, enum_name(status.state),
                static_cast<double>(status.rss_bytes) * 1e-6, status.queue_depth_max);
    account.require(status.state == ServiceState::Finished,
                    fmt::format("{} {}: {}", status.service, enum_name(status.state), status.message));
  }
}

void say_vehicle(const LogSummary& summary, Account& account) {
  if (!summary.vehicle_link) return;
  const VehicleLink& link = *summary.vehicle_link;
  account.say("\nvehicle: {} states received, {} used; {} missing, {} late, {} not newer, {} refused{}\n",
              link.received, link.used, link.missing, link.late, link.not_newer, link.refused,
              link.last_refusal.empty() ? "" : " (" + link.last_refusal + ")");
  account.say("         {} truth samples extrapolated, at most {:.3f} s; led back {} times\n",
              link.truth_samples_extrapolated, link.longest_extrapolation_s, link.returns);
}

void say_recoveries(const LogSummary& summary, Account& account) {
  if (!summary.recoveries.empty()) account.say("\n");
  for (const mcap::StringMap& recovery : summary.recoveries) {
    const auto value = [&recovery](const char* key) {
      const auto found = recovery.find(key);
      return found == recovery.end() ? std::string("?") : found->second;
    };
    if (value("what") == "log") {
      account.say("recovered: the logger was started again and went on with this log; {} messages were rescued\n",
                  value("rescued_messages"));
    } else if (recovery.count("missing_messages") > 0) {
      account.say("recovered: {}: {} messages that were sent while the logger was away are missing\n", value("what"),
                  value("missing_messages"));
    } else {
      account.say("recovered: {}: its service was started again; {} s without a sample between {} and {}\n",
                  value("what"), value("silence_s"), value("last_sequence_before"), value("first_sequence_after"));
    }
  }
}

std::string shown(const Measured& measured) {
  return fmt::format("{:>11.5g} / {:<11.5g}{}", measured.value, measured.promised, measured.holds ? "  " : " !");
}

void say_swap(std::size_t number, const SwapEvidence& swap, bool of_the_scenario, Account& account) {
  const ProfileAck& ack = swap.ack;
  const std::string what = fmt::format("swap {}: {} '{}' for {}", number, enum_name(ack.kind), swap.profile_name,
                                       catalog::sensor_name(ack.target));
  account.say("\n{}: {} at {:.3f} s, first sample under it {:.3f} s, sequence {}\n", what, enum_name(ack.outcome),
              time::to_seconds(ack.apply_time_ns), time::to_seconds(ack.first_sample_time_ns), ack.first_sequence);
  if (ack.requested_in_the_past && ack.requested_time_ns >= 0) {
    account.say("  late: it was asked for {:.3f} s\n", time::to_seconds(ack.requested_time_ns));
  }
  account.require(!ack.requested_in_the_past || !of_the_scenario,
                  fmt::format("{}: late: asked for {:.3f} s, in effect from {:.3f} s", what,
                              time::to_seconds(ack.requested_time_ns), time::to_seconds(ack.apply_time_ns)));
  if (!swap.left_out.empty()) account.say("  not weighed: {}\n", fmt::join(swap.left_out, ", "));
  account.require(swap.first_sample_holds, what + ": the acknowledged sample is not the first with that revision");
  if (swap.lines.empty()) {
    account.say("  nothing measured: {}\n", swap.why_nothing);
    return;
  }
  account.say("  {:<38}{:<13}{:^27}{:^27}\n", "measured / promised", "", "before", "after");
  for (const EvidenceLine& line : swap.lines) {
    account.say("  {:<38}{:<13}{}{}\n", line.quantity, line.unit, shown(line.before), shown(line.after));
    for (const Measured* measured : {&line.before, &line.after}) {
      account.require(measured->holds,
                      fmt::format("{}: {} is {:.5g} {}; promised {:.5g}, within {:.2g}", what, line.quantity,
                                  measured->value, line.unit, measured->promised, measured->tolerance));
    }
  }
}

/// What did not take effect. A request that a colleague made on the way may be refused without harm to the run.
void say_other_acks(const LogSummary& summary, Account& account) {
  for (const ProfileAck& ack : summary.acks) {
    if (ack.outcome == AckOutcome::Applied) continue;
    const bool of_the_scenario = is_of_the_scenario(ack, summary);
    account.say("\n{} for {}: {} {} {}{}\n", enum_name(ack.kind), catalog::sensor_name(ack.target),
                enum_name(ack.outcome), ack.field, ack.reason,
                of_the_scenario ? "" : " (not one of the scenario's swaps)");
    account.require(ack.outcome != AckOutcome::Rejected || !of_the_scenario,
                    fmt::format("a swap was rejected: {}: {}", ack.field, ack.reason));
  }
}

/// Entries of the journal of which no service said what became.
void check_that_all_were_answered(const LogSummary& summary, Account& account) {
  std::set<std::uint64_t> answered;
  std::set<std::uint32_t> answered_entries;
  for (const ProfileAck& ack : summary.acks) {
    if (is_of_the_scenario(ack, summary)) answered.insert(ack.request_id);
    answered_entries.insert(ack.journal_number);
  }
  account.require(
      answered.size() == summary.scenario.swaps.size(),
      fmt::format("{} swaps were scheduled, {} acknowledged", summary.scenario.swaps.size(), answered.size()));
  for (const ProfileInUse& entry : summary.profiles) {
    const std::uint32_t number = catalog::request_of(entry.profile).journal_number;
    if (number == 0 || answered_entries.count(number) > 0) continue;
    const std::string what =
        fmt::format("journal entry {}: {} '{}' for {} at {:.3f} s", number, enum_name(catalog::kind_of(entry.profile)),
                    catalog::name_of(entry.profile), catalog::sensor_name(catalog::target_of(entry.profile)),
                    time::to_seconds(entry.apply_at_ns));
    account.say("\n{}: never acknowledged\n", what);
    account.require(false, what + " was never acknowledged");
  }
}

void say_swaps(const LogSummary& summary, const std::vector<SwapEvidence>& swaps, Account& account) {
  std::size_t number = 0;
  for (const SwapEvidence& swap : swaps) {
    say_swap(++number, swap, is_of_the_scenario(swap.ack, summary), account);
  }
  say_other_acks(summary, account);
  check_that_all_were_answered(summary, account);
}

}  // namespace

RunSummary run_summary(const LogSummary& summary, const std::vector<SwapEvidence>& swaps,
                       const std::optional<std::string>& failure) {
  Account account;
  account.require(!failure, failure.value_or(""));
  account.require(summary.closed_properly, "the log was not closed: " + summary.ending);
  if (!is_offline(summary)) {
    const bool finished = summary.last_status && summary.last_status->state == RunState::Finished;
    const std::string state = summary.last_status ? std::string(enum_name(summary.last_status->state)) : "unknown";
    const std::string why = summary.last_status ? summary.last_status->message : "";
    account.require(finished, "the run did not finish: " + state + (why.empty() ? "" : ": " + why));
  }
  say_head(summary, account);
  say_streams(summary, account);
  say_services(summary, account);
  say_vehicle(summary, account);
  say_recoveries(summary, account);
  say_swaps(summary, swaps, account);
  account.say_checks();
  account.say("log {}\n", summary.path);
  return {account.text(), account.outcome()};
}

}  // namespace inslab::evidence
