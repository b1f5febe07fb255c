#pragma once

#include "inslab/data/profiles/barometer_error_profile.hpp"
#include "inslab/data/profiles/installation_profile.hpp"
#include "inslab/data/samples/truth_state.hpp"
#include "inslab/models/sensing/first_order_lag.hpp"
#include "inslab/nav/standard_atmosphere.hpp"

namespace inslab::barometer {

/// How the air differs at an instant from what the profile says for good: its random drifts.
struct Weather {
  double sea_level_pressure_pa = 0.0;
  double temperature_k = 0.0;
};

/// What the port of a barometer gives to the sensor: the air at its place, the static pressure error, the lag.
class StaticPort {
 public:
  void use(const InstallationProfile& installation) { lever_arm_v_m_ = installation.lever_arm_v_m; }
  void use(const BarometerErrorProfile& errors) { errors_ = errors; }

  /// At `truth`'s time, which goes on from call to call: between two calls the pressure at the port goes in a straight
  /// line, to which the lag answers exactly.
  nav::standard_atmosphere::Air air(const TruthState& truth, const Weather& drift);

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.lag_);
  }

 private:
  BarometerErrorProfile errors_;
  Vector3 lever_arm_v_m_ = Vector3::Zero();
  sensing::FirstOrderLag lag_;
};

}  // namespace inslab::barometer
