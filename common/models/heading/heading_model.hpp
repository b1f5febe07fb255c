#pragma once

#include <optional>
#include <vector>

#include "inslab/data/samples/baseline_heading.hpp"
#include "inslab/models/gnss/outage_schedule.hpp"
#include "inslab/models/gnss/solution_ladder.hpp"
#include "inslab/models/heading/wrong_fixes.hpp"
#include "inslab/models/sensing/instrument.hpp"
#include "inslab/noise/random/vector_noise.hpp"

namespace inslab::heading {

/// One receiver with two antennas on the vehicle.
///
/// Sample k is at instant k of its rate, k >= 1, and shows the vector from the first antenna to the second, in the NED
/// of the first:
///
///   b = C_nv (second arm - first arm) + white + Gauss-Markov + wrong fix + fault
///
/// by heading, pitch and length. The claimed sigmas are those of the profile through the vector's direction; of wrong
/// fixes a receiver knows nothing. Outages are those of the first antenna's place; after one the receiver climbs its
/// ladder (models/gnss/solution_ladder.hpp). Without a solution there is no sample. Draws depend on (seed, sensor
/// number, k) alone. Source: P. Teunissen, O. Montenbruck (eds.), Springer Handbook of GNSS (2017), chapter 27,
/// attitude of a single baseline.
class HeadingModel {
 public:
  struct Setup : sensing::Setup<catalog::Heading> {
    std::vector<Outage> outages;
    std::vector<OutageArea> outage_areas;
  };

  /// Throws std::invalid_argument when a profile breaks a rule of data/catalog/profile_rules.hpp, and as
  /// gnss::OutageSchedule does.
  explicit HeadingModel(const Setup& setup);

  /// Swaps a profile from the next sample on. Throws std::invalid_argument when it breaks a rule, and then changes
  /// nothing.
  void apply(const HeadingErrorProfile& profile);
  void apply(const InstallationProfile& profile) { instrument_.take(profile); }
  void apply(const FaultProfile& profile) { instrument_.take(profile); }

  /// The sample at `truth`'s time; nothing between the instants, at t = 0 and without a solution. Truth comes in order,
  /// and every instant's among it. Samples are numbered from 0 without gaps.
  std::optional<BaselineHeading> observe(const TruthState& truth);

  /// What a model of the same setup needs to go on from here (data/state/state_stream.hpp).
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.instrument_);
    if constexpr (!std::is_const_v<Self>) {
      self.ladder_.retune(self.instrument_.errors(), Continuity::Reset);
      self.wrong_fixes_.retune(self.instrument_.errors());
    }
    visit(self.ladder_, self.noise_, self.wrong_fixes_, self.rung_);
    if constexpr (!std::is_const_v<Self>) self.take_errors_of(self.rung_);
  }

 private:
  const BaselineErrors& errors_on(std::size_t rung) const;
  FixType fix_type_on(std::size_t rung) const;
  void take_errors_of(std::size_t rung);

  sensing::Instrument<catalog::Heading> instrument_;
  gnss::OutageSchedule outages_;
  gnss::SolutionLadder ladder_;
  random::VectorNoise noise_;
  WrongFixes wrong_fixes_;
  std::size_t rung_ = 0;  ///< whose errors the noise has
};

}  // namespace inslab::heading
