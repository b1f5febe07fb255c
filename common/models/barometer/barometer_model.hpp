#pragma once

#include <optional>

#include "inslab/data/samples/air_pressure.hpp"
#include "inslab/models/barometer/static_port.hpp"
#include "inslab/models/faults/axis_faults.hpp"
#include "inslab/models/sensing/instrument.hpp"
#include "inslab/noise/random/scalar_noise.hpp"

namespace inslab::barometer {

/// One barometer on the vehicle.
///
/// Sample k is at instant k of its rate, k >= 1, and shows that instant:
///
///   p = lag(p_air(height) + K q) + offset + white + Gauss-Markov
///
/// then the jump and burst of a fault, range, counts, what is wrong with the pressure. The air is the standard
/// atmosphere (ISO 2533) with the profile's pressure at sea level and deviation of the temperature, both of which
/// drift; q is the dynamic pressure of the speed over ground. The drifts of the air are those of the scenario, not of
/// the sensor: barometers of one rate are in the same weather. Draws depend on (seed, sensor number, k) alone.
class BarometerModel {
 public:
  using Setup = sensing::Setup<catalog::Barometer>;

  /// Throws std::invalid_argument when a profile breaks a rule of data/catalog/profile_rules.hpp.
  explicit BarometerModel(const Setup& setup);

  /// Swaps a profile from the next sample on. Throws std::invalid_argument when it breaks a rule, and then changes
  /// nothing.
  void apply(const BarometerErrorProfile& profile);
  void apply(const InstallationProfile& profile);
  void apply(const FaultProfile& profile);

  /// The sample at `truth`'s time; nothing between the instants, at t = 0 and while a fault silences the sensor. Truth
  /// comes in order, and every instant's among it. Samples are numbered from 0 without gaps.
  std::optional<AirPressure> observe(const TruthState& truth);

  /// What a model of the same setup needs to go on from here (data/state/state_stream.hpp).
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.instrument_);
    if constexpr (!std::is_const_v<Self>) self.take_profiles();
    visit(self.port_, self.sea_level_drift_, self.temperature_drift_, self.noise_, self.stuck_);
  }

 private:
  struct Noise {
    double pressure_pa = 0.0;
    double temperature_deg_c = 0.0;
  };

  void take_profiles();
  Noise drawn();

  sensing::Instrument<catalog::Barometer> instrument_;
  StaticPort port_;
  random::GaussMarkov sea_level_drift_;
  random::GaussMarkov temperature_drift_;
  random::ScalarNoise noise_;  ///< of the sensor's pressure
  random::NormalCursor temperature_white_;
  random::NormalCursor burst_;  ///< of a fault
  faults::AxisFaults stuck_;    ///< the pressure is its first axis
};

}  // namespace inslab::barometer
