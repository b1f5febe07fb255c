#pragma once

#include <cstdint>
#include <optional>

#include "inslab/data/samples/wheel_travel.hpp"
#include "inslab/models/faults/axis_faults.hpp"
#include "inslab/models/odometer/wheel_contact.hpp"
#include "inslab/models/sensing/instrument.hpp"
#include "inslab/noise/random/gauss_markov.hpp"
#include "inslab/noise/random/random_constant.hpp"

namespace inslab::odometer {

/// An odometer on one wheel.
///
/// Sample k, k >= 1, is of the interval from instant k - 1 to instant k of its rate:
///
///   distance = counts((1 + scale) sum of (1 + slip) way + noise sqrt(|way|))
///
/// over the intervals of the truth in it; ways slower than the odometer hears are lost. Counts keep their remainder:
/// those of all samples together are within one of the whole way. The phase of the first count is drawn. Scale is
/// constant + drawn once + Gauss-Markov + warming tyre. Then faults. Draws depend on (seed, sensor number, k) alone.
class OdometerModel {
 public:
  using Setup = sensing::Setup<catalog::Odometer>;

  /// Throws std::invalid_argument when a profile breaks a rule of data/catalog/profile_rules.hpp.
  explicit OdometerModel(const Setup& setup);

  /// Swaps a profile from the present interval on. Throws std::invalid_argument when it breaks a rule, and then changes
  /// nothing.
  void apply(const OdometerErrorProfile& profile);
  void apply(const InstallationProfile& profile);
  void apply(const FaultProfile& profile);

  /// The sample of the interval that ends at `truth`; nothing between the instants, at t = 0 and while a fault silences
  /// the sensor. Samples are numbered from 0 without gaps. Throws std::invalid_argument when `truth` does not continue
  /// the one before; the model is then as it was.
  std::optional<WheelTravel> measure(const TruthState& truth);

  /// What a model of the same setup needs to go on from here (data/state/state_stream.hpp).
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.instrument_);
    if constexpr (!std::is_const_v<Self>) self.take_profiles();
    visit(self.scale_turn_on_, self.scale_drift_, self.faulty_, self.previous_, self.turned_m_, self.part_of_count_);
  }

 private:
  void take_profiles();
  double shown_m(double dt_s, std::int64_t sim_time_ns);
  double counted_m(double distance_m);

  sensing::Instrument<catalog::Odometer> instrument_;
  WheelContact contact_;
  random::RandomConstant scale_turn_on_;
  random::GaussMarkov scale_drift_;
  random::NormalCursor noise_;
  random::NormalCursor burst_;  ///< of a fault
  faults::AxisFaults faulty_;   ///< the distance is its first axis
  std::optional<TruthState> previous_;
  double turned_m_ = 0.0;  ///< in the interval that is open
  double part_of_count_;   ///< since the last whole one, 0 to 1
};

}  // namespace inslab::odometer
