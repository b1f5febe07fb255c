#pragma once

#include <optional>

#include "inslab/data/samples/airflow_truth.hpp"
#include "inslab/models/air_data/pitot_lines.hpp"
#include "inslab/models/air_data/pressure_sensor.hpp"
#include "inslab/models/air_data/vane.hpp"
#include "inslab/models/sensing/instrument.hpp"

namespace inslab::air_data {

/// One air data probe on the vehicle: a pitot tube, a static port, a temperature probe, two vanes, and the computer
/// behind them.
///
/// Sample k is at instant k of its rate, k >= 1, and shows that instant. The wind, the air at the probe and its
/// velocity against it are in airstream.hpp, what comes to the pressure sensors in pitot_lines.hpp, how sensors and
/// vanes err in pressure_sensor.hpp and vane.hpp; total temperature is T (1 + r 0.2 M^2) + offset + white. Speeds, Mach
/// number and pressure altitude follow from what is shown (Airflow::compute()), so that each error goes where it goes
/// in flight. The wind moves the air alone: the vehicle's motion is the scenario's. Draws depend on (seed, sensor
/// number, k).
class AirDataModel {
 public:
  using Setup = sensing::Setup<catalog::AirData>;
  struct Output {
    Airflow sample;
    AirflowTruth truth;
  };

  /// Throws std::invalid_argument when a profile breaks a rule of data/catalog/profile_rules.hpp.
  explicit AirDataModel(const Setup& setup);

  /// Swaps a profile from the next sample on. Throws std::invalid_argument when it breaks a rule, and then changes
  /// nothing.
  void apply(const AirDataErrorProfile& profile);
  void apply(const InstallationProfile& profile);
  void apply(const FaultProfile& profile);

  /// The sample at `truth`'s time; nothing between the instants and at t = 0. Truth comes in order, and every instant's
  /// among it. Samples are numbered from 0 without gaps.
  std::optional<Output> observe(const TruthState& truth);

  /// What a model of the same setup needs to go on from here (data/state/state_stream.hpp).
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.instrument_);
    if constexpr (!std::is_const_v<Self>) self.take_profiles();
    visit(self.air_, self.lines_, self.impact_, self.static_, self.attack_, self.sideslip_);
  }

 private:
  void take_profiles();
  double total_temperature_deg_c(const Airstream& stream);

  sensing::Instrument<catalog::AirData> instrument_;
  AirOnTheWay air_;
  PitotLines lines_;
  PressureSensor impact_;
  PressureSensor static_;
  Vane attack_;
  Vane sideslip_;
  random::NormalCursor temperature_white_;
};

}  // namespace inslab::air_data
