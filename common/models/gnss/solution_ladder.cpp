#include "inslab/models/gnss/solution_ladder.hpp"

#include <cmath>

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::gnss {

namespace {

random::Stream falls_to(FixType type, std::uint64_t seed, const std::string& receiver) {
  return {seed, receiver + "/fall." + std::string(enum_name(type))};
}

}  // namespace

SolutionLadder::SolutionLadder(const LadderRungs& profile, double period_s, std::uint64_t seed,
                               const std::string& receiver)
    : period_s_(period_s),
      falls_{falls_to(FixType::None, seed, receiver), falls_to(FixType::Single, seed, receiver),
             falls_to(FixType::Differential, seed, receiver), falls_to(FixType::Float, seed, receiver),
             falls_to(FixType::Fixed, seed, receiver)} {
  set_rungs(profile);
  rung_ = top();
}

void SolutionLadder::set_rungs(const LadderRungs& profile) {
  rungs_.clear();
  for (const SolutionRung& lesser : profile.lesser) {
    const double mean_s = lesser.mean_time_between_falls_s;
    rungs_.push_back({lesser.fix_type, time::from_seconds(lesser.lasts_s).count(),
                      mean_s > 0.0 ? -std::expm1(-period_s_ / mean_s) : 0.0});
  }
  best_ = profile.best;
}

void SolutionLadder::retune(const LadderRungs& profile, Continuity continuity) {
  const FixType held = fix_type_of(rung_);
  set_rungs(profile);
  rung_ = top();
  if (continuity != Continuity::Keep) return;
  for (std::size_t i = 0; i < top(); ++i) {
    if (rungs_[i].fix_type == held) rung_ = i;
  }
}

std::optional<std::size_t> SolutionLadder::advance(std::uint64_t k, std::int64_t time_ns, bool signals) {
  if (!signals) {
    lost_ = true;
    return std::nullopt;
  }
  if (lost_) {
    lost_ = false;
    rung_ = 0;
    since_ns_ = time_ns;
  }
  while (rung_ < top() && time_ns - since_ns_ >= rungs_[rung_].lasts_ns) since_ns_ += rungs_[rung_++].lasts_ns;
  for (std::size_t i = 0; i < rung_; ++i) {
    const double probability = rungs_[i].fall_probability;
    if (probability > 0.0 && falls_[static_cast<std::size_t>(rungs_[i].fix_type)].uniform(k) < probability) {
      rung_ = i;
      since_ns_ = time_ns;
    }
  }
  return rung_;
}

}  // namespace inslab::gnss
