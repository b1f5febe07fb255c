#include "inslab/referee/evidence/run_summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/referee/evidence/swap_evidence.hpp"
#include "inslab/referee/evidence/tell.hpp"

namespace inslab::cli {

namespace {

double seconds_of(std::int64_t ns) { return time::to_seconds(time::Nanoseconds(ns)); }

std::string milliseconds_of(double seconds) { return seconds < 0.0 ? "-" : fmt::format("{:.3f}", seconds * 1e3); }

/// Collects what does not hold, to be said at the end.
class Verdict {
 public:
  void require(bool holds, const std::string& otherwise) {
    ++checks_;
    if (!holds) broken_.push_back(otherwise);
  }
  app::Outcome outcome() const {
    const std::string held = fmt::format("{} of {} checks held", checks_ - broken_.size(), checks_);
    if (broken_.empty()) return {app::kOk, held};
    return {app::kFailed,
            broken_.front() + (broken_.size() > 1 ? fmt::format(" (and {} more)", broken_.size() - 1) : "")};
  }
  void print() const {
    tell("\n");
    for (const std::string& line : broken_) tell("FAILED: {}\n", line);
    tell("{} of {} checks held\n", checks_ - broken_.size(), checks_);
  }

 private:
  std::size_t checks_ = 0;
  std::vector<std::string> broken_;
};

/// Written by `inslab simulate`: there were no services, and nobody said how the run goes.
bool is_offline(const LogSummary& summary) { return !summary.last_status && summary.services.empty(); }

/// What the scenario asked for has the numbers of its places in it, from 1 on; others draw theirs at random.
bool is_of_the_scenario(const ProfileAck& ack, const LogSummary& summary) {
  return ack.request_id >= 1 && ack.request_id <= summary.scenario.swaps.size();
}

void print_head(const LogSummary& summary) {
  tell("\n{}: {}\n", summary.scenario.name, summary.scenario.description);
  if (is_offline(summary)) tell("simulated in one process: there are no services to check\n");
  if (!summary.last_status) return;
  const SimStatus& status = *summary.last_status;
  tell("{} after {:.3f} s of sim time at {} Hz; {} overruns, largest lag {:.3f} ms{}\n", enum_name(status.state),
       seconds_of(status.sim_time_ns), summary.scenario.truth_rate_hz, status.overruns, status.lag_max_s * 1e3,
       status.message.empty() ? "" : "; " + status.message);
}

void print_streams(const LogSummary& summary, Verdict& verdict) {
  tell("\n{:<26}{:>9}{:>10}{:>7}{:>14}{:>9}{:>9}{:>9}\n", "topic", "sent", "received", "lost", "out of order", "p50 ms",
       "p99 ms", "max ms");
  for (const auto& [topic, stream] : summary.streams) {
    const StreamStatus& logged = stream.logged;
    tell("{:<26}{:>9}{:>10}{:>7}{:>14}{:>9}{:>9}{:>9}\n", topic,
         stream.sent           ? std::to_string(*stream.sent)
         : is_offline(summary) ? "-"
                               : "unknown",
         logged.samples, logged.lost, logged.out_of_order, milliseconds_of(logged.latency_p50_s),
         milliseconds_of(logged.latency_p99_s), milliseconds_of(logged.latency_max_s));
    verdict.require(stream.sent.has_value() || is_offline(summary),
                    topic + ": its service did not finish, so what it sent is unknown");
    const std::uint64_t sent = stream.sent.value_or(0), arrived = logged.samples - logged.duplicates;
    // A navigation app that was started again knows only of its own solutions.
    const bool complete = topic == catalog::kNav.name ? arrived >= sent : arrived == sent;
    verdict.require(!stream.sent || complete, fmt::format("{}: {} sent, {} received", topic, sent, arrived));
    // A service that was started again may send its last sample once more.
    verdict.require(logged.lost == 0 && (logged.duplicates == 0 || !summary.recoveries.empty()),
                    fmt::format("{}: {} lost, {} twice", topic, logged.lost, logged.duplicates));
  }
  tell("latency: from the writer's publish time to receipt by the logger\n");
  // A writer is known to its readers before it knows them: what an app says meanwhile, if only in lockstep's first
  // moments, is heard by nobody.
  verdict.require(!summary.scenario.require_nav_app || is_offline(summary) || summary.nav_solutions > 0,
                  fmt::format("{}: the scenario requires a navigation app, and no solution of one came to the log",
                              catalog::kNav.name));
}

void print_services(const LogSummary& summary, Verdict& verdict) {
  if (summary.services.empty()) return;
  tell("\n{:<30}{:>8}{:>10}{:>8}{:>12}\n", "service", "sensor", "state", "RSS MB", "queue depth");
  for (const ServiceStatus& status : summary.services) {
    tell("{:<30}{:>8}{:>10}{:>8.1f}{:>12}\n", status.service, status.sensor_number, enum_name(status.state),
         static_cast<double>(status.rss_bytes) * 1e-6, status.queue_depth_max);
    verdict.require(status.state == ServiceState::Finished,
                    fmt::format("{} {}: {}", status.service, enum_name(status.state), status.message));
  }
}

void print_vehicle(const LogSummary& summary) {
  if (!summary.vehicle_link) return;
  const VehicleLink& link = *summary.vehicle_link;
  tell("\nvehicle: {} states received, {} used; {} missing, {} late, {} not newer, {} refused{}\n", link.received,
       link.used, link.missing, link.late, link.not_newer, link.refused,
       link.last_refusal.empty() ? "" : " (" + link.last_refusal + ")");
  tell("         {} truth samples extrapolated, at most {:.3f} s; led back {} times\n", link.truth_samples_extrapolated,
       link.longest_extrapolation_s, link.returns);
}

void print_recoveries(const LogSummary& summary) {
  if (!summary.recoveries.empty()) tell("\n");
  for (const io::mcap::StringMap& recovery : summary.recoveries) {
    const auto value = [&recovery](const char* key) {
      const auto found = recovery.find(key);
      return found == recovery.end() ? std::string("?") : found->second;
    };
    if (value("what") == "log") {
      tell("recovered: the logger was started again and went on with this log; {} messages were rescued\n",
           value("rescued_messages"));
    } else {
      tell("recovered: {}: its service was started again; {} s without a sample between {} and {}\n", value("what"),
           value("silence_s"), value("last_sequence_before"), value("first_sequence_after"));
    }
  }
}

std::string shown(const Measured& measured) {
  return fmt::format("{:>11.5g} / {:<11.5g}{}", measured.value, measured.promised, measured.holds ? "  " : " !");
}

void print_swap(std::size_t number, const SwapEvidence& swap, bool of_the_scenario, Verdict& verdict) {
  const ProfileAck& ack = swap.ack;
  const std::string what =
      fmt::format("swap {}: {} '{}' for {}", number, enum_name(ack.kind), swap.profile_name, sensor_name(ack.target));
  tell("\n{}: {} at {:.3f} s, first sample under it {:.3f} s, sequence {}\n", what, enum_name(ack.outcome),
       seconds_of(ack.apply_time_ns), seconds_of(ack.first_sample_time_ns), ack.first_sequence);
  if (ack.requested_in_the_past && ack.requested_time_ns >= 0) {
    tell("  late: it was asked for {:.3f} s\n", seconds_of(ack.requested_time_ns));
  }
  verdict.require(!ack.requested_in_the_past || !of_the_scenario,
                  fmt::format("{}: late: asked for {:.3f} s, in effect from {:.3f} s", what,
                              seconds_of(ack.requested_time_ns), seconds_of(ack.apply_time_ns)));
  if (!swap.left_out.empty()) tell("  not weighed: {}\n", fmt::join(swap.left_out, ", "));
  verdict.require(swap.first_sample_holds, what + ": the acknowledged sample is not the first with that revision");
  if (swap.lines.empty()) {
    tell("  nothing measured: {}\n", swap.why_nothing);
    return;
  }
  tell("  {:<38}{:<13}{:^27}{:^27}\n", "measured / promised", "", "before", "after");
  for (const EvidenceLine& line : swap.lines) {
    tell("  {:<38}{:<13}{}{}\n", line.quantity, line.unit, shown(line.before), shown(line.after));
    for (const Measured* measured : {&line.before, &line.after}) {
      verdict.require(measured->holds,
                      fmt::format("{}: {} is {:.5g} {}; promised {:.5g}, within {:.2g}", what, line.quantity,
                                  measured->value, line.unit, measured->promised, measured->tolerance));
    }
  }
}

/// What did not take effect. A request that a colleague made on the way may be refused without harm to the run.
void print_other_acks(const LogSummary& summary, Verdict& verdict) {
  for (const ProfileAck& ack : summary.acks) {
    if (ack.outcome == AckOutcome::Applied) continue;
    const bool of_the_scenario = is_of_the_scenario(ack, summary);
    tell("\n{} for {}: {} {} {}{}\n", enum_name(ack.kind), sensor_name(ack.target), enum_name(ack.outcome), ack.field,
         ack.reason, of_the_scenario ? "" : " (not one of the scenario's swaps)");
    verdict.require(ack.outcome != AckOutcome::Rejected || !of_the_scenario,
                    fmt::format("a swap was rejected: {}: {}", ack.field, ack.reason));
  }
}

/// Entries of the journal of which no service said what became.
void check_that_all_were_answered(const LogSummary& summary, Verdict& verdict) {
  std::set<std::uint64_t> answered;
  std::set<std::uint32_t> answered_entries;
  for (const ProfileAck& ack : summary.acks) {
    if (is_of_the_scenario(ack, summary)) answered.insert(ack.request_id);
    answered_entries.insert(ack.journal_number);
  }
  verdict.require(
      answered.size() == summary.scenario.swaps.size(),
      fmt::format("{} swaps were scheduled, {} acknowledged", summary.scenario.swaps.size(), answered.size()));
  for (const ProfileInUse& entry : summary.profiles) {
    const std::uint32_t number = request_of(entry.profile).journal_number;
    if (number == 0 || answered_entries.count(number) > 0) continue;
    const std::string what =
        fmt::format("journal entry {}: {} '{}' for {} at {:.3f} s", number, enum_name(kind_of(entry.profile)),
                    name_of(entry.profile), sensor_name(target_of(entry.profile)), seconds_of(entry.apply_at_ns));
    tell("\n{}: never acknowledged\n", what);
    verdict.require(false, what + " was never acknowledged");
  }
}

void print_swaps(const io::McapReader& log, const LogSummary& summary, Verdict& verdict) {
  std::size_t number = 0;
  for (const SwapEvidence& swap : weigh_swaps(log, summary)) {
    print_swap(++number, swap, is_of_the_scenario(swap.ack, summary), verdict);
  }
  print_other_acks(summary, verdict);
  check_that_all_were_answered(summary, verdict);
}

}  // namespace

app::Outcome print_run_summary(const std::string& log_path, const std::optional<std::string>& failure) {
  const io::McapReader log(log_path);
  const LogSummary summary = summarize(log);
  Verdict verdict;
  verdict.require(!failure, failure.value_or(""));
  verdict.require(log.closed_properly(), "the log was not closed: " + log.ending());
  if (!is_offline(summary)) {
    const bool finished = summary.last_status && summary.last_status->state == RunState::Finished;
    const std::string state = summary.last_status ? std::string(enum_name(summary.last_status->state)) : "unknown";
    const std::string why = summary.last_status ? summary.last_status->message : "";
    verdict.require(finished, "the run did not finish: " + state + (why.empty() ? "" : ": " + why));
  }
  print_head(summary);
  print_streams(summary, verdict);
  print_services(summary, verdict);
  print_vehicle(summary);
  print_recoveries(summary);
  print_swaps(log, summary, verdict);
  verdict.print();
  tell("log {}\n", log_path);
  return verdict.outcome();
}

}  // namespace inslab::cli
