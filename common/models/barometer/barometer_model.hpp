#pragma once

#include <cstdint>
#include <optional>

#include "inslab/data/profiles/barometer_error_profile.hpp"
#include "inslab/data/profiles/fault_profile.hpp"
#include "inslab/data/profiles/installation_profile.hpp"
#include "inslab/data/samples/air_pressure.hpp"
#include "inslab/data/samples/truth_state.hpp"
#include "inslab/foundation/time/rate.hpp"
#include "inslab/models/barometer/static_port.hpp"
#include "inslab/models/faults/axis_faults.hpp"
#include "inslab/models/timing/sensor_clock.hpp"
#include "inslab/noise/random/gauss_markov.hpp"

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
  struct Setup {
    std::uint64_t seed = 0;
    std::uint32_t sensor_number = 0;
    time::Rate rate;
    BarometerErrorProfile errors;
    InstallationProfile installation;
  };

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
    visit(self.errors_, self.installation_, self.fault_);
    if constexpr (!std::is_const_v<Self>) self.take_profiles();
    visit(self.port_, self.clock_, self.sea_level_drift_, self.temperature_drift_, self.drift_, self.stuck_,
          self.instant_, self.samples_);
  }

 private:
  struct Noise {
    double pressure_pa = 0.0;
    double temperature_deg_c = 0.0;
  };

  void take_profiles();
  Noise drawn();

  std::uint32_t sensor_number_;
  time::Rate rate_;
  BarometerErrorProfile errors_;
  InstallationProfile installation_;
  FaultProfile fault_;
  StaticPort port_;
  random::GaussMarkov sea_level_drift_;
  random::GaussMarkov temperature_drift_;
  random::GaussMarkov drift_;  ///< of the sensor
  random::NormalCursor white_;
  random::NormalCursor temperature_white_;
  random::NormalCursor burst_;  ///< of a fault
  timing::SensorClock clock_;
  faults::AxisFaults stuck_;   ///< the pressure is its first axis
  std::uint64_t instant_ = 0;  ///< the last one
  std::uint64_t samples_ = 0;
};

}  // namespace inslab::barometer
