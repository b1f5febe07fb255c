#include "inslab/sim/profile_desk.hpp"

#include <algorithm>

#include "inslab/data/wire/cdr.hpp"

namespace inslab::sim {

namespace {

/// What makes two profiles the same: everything but the request.
std::vector<std::uint8_t> parameters_of(const catalog::AnyProfile& profile) {
  return std::visit(
      [](auto copy) {
        copy.request = {};
        std::vector<std::uint8_t> bytes;
        wire::encode(copy, bytes);
        return bytes;
      },
      profile);
}

}  // namespace

ProfileDesk::ProfileDesk(SensorAddress sensor, std::string service, const std::vector<catalog::AnyProfile>& in_use)
    : sensor_(sensor), service_(std::move(service)) {
  for (const catalog::AnyProfile& profile : in_use) {
    parameters_in_use_.at(static_cast<std::size_t>(catalog::kind_of(profile))) = parameters_of(profile);
  }
}

void ProfileDesk::add(const catalog::AnyProfile& entry) {
  const ProfileRequest& head = catalog::request_of(entry);
  // Of the entries before that, each had come when they were taken.
  if (head.apply_at_ns < taken_until_ns_) return;
  const Place place(head.apply_at_ns, head.journal_number);
  if (ahead_.insert(place).second && catalog::target_of(entry) == sensor_) waiting_.emplace(place, entry);
}

bool ProfileDesk::complete_for(const TruthState& truth) const {
  std::uint64_t in_effect = taken_;
  for (const auto& [apply_at_ns, number] : ahead_) {
    if (in_effect >= truth.journal_in_effect || apply_at_ns >= truth.header.sim_time_ns) break;
    ++in_effect;
  }
  return in_effect >= truth.journal_in_effect;
}

void ProfileDesk::forget_taken() {
  ahead_.erase(ahead_.begin(), ahead_.lower_bound({taken_until_ns_, 0}));
  while (!waiting_.empty() && waiting_.begin()->first.first < taken_until_ns_) waiting_.erase(waiting_.begin());
}

ProfileAck ProfileDesk::ack_of(const catalog::AnyProfile& entry, AckOutcome outcome) const {
  const ProfileRequest& head = catalog::request_of(entry);
  ProfileAck ack;
  ack.request_id = head.request_id;
  ack.kind = catalog::kind_of(entry);
  ack.target = catalog::target_of(entry);
  ack.journal_number = head.journal_number;
  ack.outcome = outcome;
  ack.service = service_;
  ack.requested_time_ns = head.requested_at_ns;
  ack.apply_time_ns = head.apply_at_ns;
  ack.requested_in_the_past = head.requested_in_the_past;
  return ack;
}

std::vector<catalog::AnyProfile> ProfileDesk::take_due(std::int64_t sim_time_ns) {
  taken_until_ns_ = sim_time_ns;
  while (!ahead_.empty() && ahead_.begin()->first < sim_time_ns) {
    ahead_.erase(ahead_.begin());
    ++taken_;
  }
  std::map<ProfileKind, catalog::AnyProfile> latest;
  while (!waiting_.empty() && waiting_.begin()->first.first < sim_time_ns) {
    const catalog::AnyProfile entry = waiting_.begin()->second;
    waiting_.erase(waiting_.begin());
    const auto earlier = latest.find(catalog::kind_of(entry));
    if (earlier != latest.end()) {
      to_acknowledge_.push_back(ack_of(earlier->second, AckOutcome::Superseded));
      latest.erase(earlier);
    }
    latest.emplace(catalog::kind_of(entry), entry);
  }
  std::vector<catalog::AnyProfile> due;
  for (const auto& [kind, entry] : latest) {
    std::vector<std::uint8_t> parameters = parameters_of(entry);
    std::vector<std::uint8_t>& in_use = parameters_in_use_.at(static_cast<std::size_t>(kind));
    // Asked to reset or redraw, the same parameters still change the states.
    const bool unchanged = parameters == in_use && catalog::request_of(entry).continuity == Continuity::Keep;
    // No sample came out under what took effect before this and waits still, as from a receiver without a fix.
    for (ProfileAck& waiting : to_acknowledge_) {
      if (!unchanged && waiting.kind == kind) waiting.outcome = AckOutcome::Superseded;
    }
    to_acknowledge_.push_back(ack_of(entry, unchanged ? AckOutcome::Unchanged : AckOutcome::Applied));
    if (!unchanged) due.push_back(entry);
    in_use = std::move(parameters);
  }
  return due;
}

std::vector<ProfileAck> ProfileDesk::acknowledge(const StreamHeader& first_sample) {
  std::vector<ProfileAck> acks;
  acks.swap(to_acknowledge_);
  for (ProfileAck& ack : acks) {
    ack.run_id = first_sample.run_id;
    ack.first_sample_time_ns = first_sample.sim_time_ns;
    ack.first_sequence = first_sample.sequence_number;
  }
  return acks;
}

std::vector<ProfileAck> ProfileDesk::close(const RunId& run) {
  std::vector<ProfileAck> acks;
  acks.swap(to_acknowledge_);
  for (const auto& [when, entry] : waiting_) acks.push_back(ack_of(entry, AckOutcome::Rejected));
  waiting_.clear();
  for (ProfileAck& ack : acks) {
    ack.run_id = run;
    if (ack.outcome == AckOutcome::Superseded) continue;
    ack.outcome = AckOutcome::Rejected;
    ack.field = "request.apply_at_ns";
    ack.reason = "the run ended before " + catalog::sensor_name(sensor_) + " put out a sample under it";
  }
  return acks;
}

}  // namespace inslab::sim
