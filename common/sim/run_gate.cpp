#include "inslab/sim/run_gate.hpp"

#include <cmath>

namespace inslab::sim {

namespace {

RunControl::Verdict refused(std::string reason) {
  RunControl::Verdict verdict;
  verdict.refusal = std::move(reason);
  return verdict;
}

}  // namespace

RunControl::Verdict RunControl::judge(const SimCommand& command, std::uint64_t sent) {
  constexpr double kMaxSteps = 1e12;
  const bool was_paused = paused();
  Verdict verdict;
  switch (command.kind) {
    case CommandKind::Stop:
      stop_ = true;
      break;
    case CommandKind::Pause:
      paused_ = true;
      pause_at_.reset();
      break;
    case CommandKind::Resume:
      paused_ = false;
      pause_at_.reset();
      break;
    case CommandKind::Step:
      if (!paused_) return refused("a step needs a paused run");
      if (stepping()) return refused("steps are still going on");
      if (!(command.value >= 1.0 && command.value <= kMaxSteps && command.value == std::floor(command.value))) {
        return refused("value: expected a whole number of truth samples, 1 or more");
      }
      pause_at_ = sent + static_cast<std::uint64_t>(command.value);
      break;
    case CommandKind::Rate:
      if (clock_ == ClockMode::Lockstep) return refused("lockstep has no rate: its consumers set the pace");
      if (!(command.value >= kMinRate && command.value <= kMaxRate)) {
        return refused("value: expected a rate from 0.01 to 1000");
      }
      verdict.rate = command.value;
      break;
  }
  verdict.pace_changed = paused() != was_paused;
  return verdict;
}

bool RunControl::note_sent(std::uint64_t sent) {
  if (!pause_at_ || sent < *pause_at_) return false;
  pause_at_.reset();
  return true;
}

}  // namespace inslab::sim
