#include "inslab/data/streams/run_follower.hpp"

namespace inslab::streams {

void RunFollower::go_on(const RunId& run, ClockMode clock, Phase phase, time::Nanoseconds now) {
  run_ = run;
  clock_ = clock;
  enter(phase, now);
}

bool RunFollower::may_change_to(const RunId& run) const {
  if (only_ != RunId{}) return run == only_;
  return run_ == RunId{} || phase_ == (changes_ == Changes::WhileItWaits ? Phase::Waiting : Phase::Ended);
}

RunFollower::Heard RunFollower::hear(const SimStatus& status, time::Nanoseconds now) {
  const bool is_new = status.run_id != run_;
  if (is_new && !may_change_to(status.run_id)) return Heard::OfAnother;
  if (is_new) {
    run_ = status.run_id;
    truth_samples_ = 0;
    fault_.clear();
    told_ = false;
    enter(Phase::Waiting, now);
  }
  clock_ = status.clock;
  if (status.state != RunState::Waiting) note_sample(now);
  const bool ends = inslab::has_ended(status.state) && !has_ended();
  if (ends) {
    truth_samples_ = status.truth_samples;
    if (status.state == RunState::Fault) fault_ = status.message;
    enter(Phase::Ended, now);
  }
  return is_new ? Heard::TheRun : ends ? Heard::ItsEnd : Heard::OfTheRun;
}

bool RunFollower::tells_the_wait(time::Nanoseconds now) {
  constexpr time::Nanoseconds kLong = std::chrono::seconds(2);
  if (told_ || !stays_for_the_log(now) || !ended_before(kLong, now)) return false;
  told_ = true;
  return true;
}

void RunFollower::enter(Phase phase, time::Nanoseconds now) {
  phase_ = phase;
  since_ = now;
}

}  // namespace inslab::streams
