#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "inslab/data/profiles/solution_rung.hpp"
#include "inslab/data/requests/profile_request.hpp"
#include "inslab/noise/random/stream.hpp"

namespace inslab::gnss {

/// What a profile of a receiver says of its ladder: the rungs from the worst up, and above them its own fix type.
struct LadderRungs {
  std::vector<SolutionRung> lesser;
  FixType best = FixType::None;

  /// Of any profile with lesser solutions.
  template <class Profile>
  LadderRungs(const Profile& profile)  // NOLINT(google-explicit-constructor): a profile is its ladder too
      : lesser(profile.lesser_solutions.begin(), profile.lesser_solutions.end()), best(profile.fix_type) {}
};

/// Which kind of solution a receiver has.
///
/// The profile's lesser solutions, from the worst up, and above them its own, are the rungs of a ladder. A receiver
/// begins at the top. Without signals it has nothing; at the first epoch with signals again it begins on the lowest
/// rung and climbs, each rung for its `lasts_s` (time to first fix, to corrections, to an ambiguity fix). From any rung
/// it falls to a lower one at random, as a Poisson process with the lower rung's mean time between falls: in an epoch
/// of length dt with the probability 1 - exp(-dt/mean). That draw depends on (seed, receiver, fix type, epoch) alone.
class SolutionLadder {
 public:
  /// `receiver` is the root of the stream names, such as "gnss0".
  SolutionLadder(const LadderRungs& profile, double period_s, std::uint64_t seed, const std::string& receiver);

  /// Takes another profile between two epochs. Keep: the receiver stays with its fix type, and its time there goes on,
  /// when the new profile has that type; else, and without signals, nothing is known of it: top, or still nothing.
  void retune(const LadderRungs& profile, Continuity continuity);

  /// The rung of epoch `k` at sim time `time_ns`: an index of lesser_solutions, their number for the profile's own, or
  /// nothing when there are no signals. Epochs come in order, each once.
  std::optional<std::size_t> advance(std::uint64_t k, std::int64_t time_ns, bool signals);

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.rung_, self.since_ns_, self.lost_);
  }

 private:
  struct Rung {
    FixType fix_type;
    std::int64_t lasts_ns;
    double fall_probability;
  };

  void set_rungs(const LadderRungs& profile);
  std::size_t top() const { return rungs_.size(); }
  FixType fix_type_of(std::size_t rung) const { return rung < top() ? rungs_[rung].fix_type : best_; }

  double period_s_;
  std::array<random::Stream, EnumNames<FixType>::values.size()> falls_;
  std::vector<Rung> rungs_;
  FixType best_ = FixType::None;
  std::size_t rung_ = 0;
  std::int64_t since_ns_ = 0;
  bool lost_ = false;
};

}  // namespace inslab::gnss
