#include "inslab/data/streams/demand.hpp"

#include <algorithm>

namespace inslab::streams {

using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

/// In lockstep the next block follows upon a credit: after a pause longer than two repetitions of it something is
/// amiss.
constexpr time::Nanoseconds kRepeat = milliseconds(200);
constexpr time::Nanoseconds kSilence = milliseconds(400);
/// A service that was held up, or a producer that has come back, goes on within two seconds.
constexpr time::Nanoseconds kLongestRepeat = milliseconds(1600);

DemandPolicy in(ClockMode clock) {
  DemandPolicy policy;
  policy.repeat = kRepeat;
  policy.longest_repeat = kLongestRepeat;
  policy.keeps_saying = clock == ClockMode::Lockstep;
  if (clock == ClockMode::Lockstep) policy.silence = kSilence;
  return policy;
}

}  // namespace

DemandPolicy demand_of_truth(ClockMode clock) {
  DemandPolicy policy = in(clock);
  policy.patience = seconds(8);
  return policy;
}

DemandPolicy demand_of_input(ClockMode clock) {
  DemandPolicy policy = in(clock);
  if (clock == ClockMode::RealTime) policy.repeat = milliseconds(20);
  policy.patience = clock == ClockMode::RealTime ? time::Nanoseconds(milliseconds(100)) : seconds(2);
  policy.skips = true;
  return policy;
}

DemandPolicy demand_of_log(ClockMode clock, bool run_has_ended) {
  DemandPolicy policy = in(clock);
  if (!run_has_ended) return policy;
  policy.repeat = milliseconds(50);
  policy.keeps_saying = true;
  if (clock == ClockMode::RealTime) policy.silence = seconds(1);
  return policy;
}

void Demand::begin(const DemandPolicy& policy, time::Nanoseconds now) {
  *this = Demand();
  begins_ = true;
  came_at_ = looked_at_ = now;
  change(policy, now);
}

void Demand::change(const DemandPolicy& policy, time::Nanoseconds now) {
  policy_ = policy;
  interval_ = policy.repeat;
  next_at_ = now;
}

void Demand::came(time::Nanoseconds now) {
  came_at_ = now;
  interval_ = policy_.repeat;
  next_at_ = std::min(next_at_, now + interval_);
}

/// A process that was stopped, or had no processor, has not waited meanwhile: what it lacks may be on its way.
void Demand::forgive_a_standstill(time::Nanoseconds now) {
  constexpr time::Nanoseconds kStandstill = seconds(1);
  const bool stood_still = now - looked_at_ > kStandstill;
  looked_at_ = now;
  if (!stood_still) return;
  came_at_ = now;
  interval_ = policy_.repeat;
  next_at_ = now;
  if (gap_) gap_->since = now;
}

void Demand::watch_the_gap(const Known& known, time::Nanoseconds now) {
  if (!known.newer_came) {
    gap_.reset();
    asked_from_.reset();
  } else if (!gap_ || gap_->at != known.next) {
    gap_ = Gap{known.next, now};
  }
}

std::optional<Ask> Demand::look(const Known& known, time::Nanoseconds now) {
  forgive_a_standstill(now);
  watch_the_gap(known, now);
  const bool silent = known.more_may_have_been_sent && now - came_at_ > policy_.silence;
  const bool lacks = begins_ || known.newer_came || known.more_was_sent || silent;
  // What was asked for has come and is not all: the rest is asked for at once.
  const bool answered = asked_from_ && known.next > *asked_from_;
  const bool falls_silent = silent && !was_silent_;
  was_silent_ = silent;
  if (falls_silent) interval_ = policy_.repeat;
  const bool is_due = now >= next_at_ && (lacks || policy_.keeps_saying);
  const bool speaks_again = is_due || answered || falls_silent;
  if (!speaks_again && !known.moved) return std::nullopt;

  next_at_ = now + interval_;
  if (!speaks_again) return Ask{};
  begins_ = false;
  interval_ = std::min(2 * interval_, policy_.longest_repeat);
  if (known.newer_came) asked_from_ = known.next;
  return Ask{lacks};
}

bool Demand::gave_up(std::uint64_t next, time::Nanoseconds now) const {
  return gap_ && gap_->at == next && now - gap_->since > policy_.patience;
}

}  // namespace inslab::streams
