#pragma once

#include <optional>

#include "inslab/data/profiles/barometer_error_profile.hpp"
#include "inslab/data/profiles/installation_profile.hpp"
#include "inslab/data/samples/truth_state.hpp"
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
  /// line, to which the lag answers exactly,
  ///
  ///   T dp_s/dt = p - p_s,   p_s[k] = p[k] - T r + (p_s[k-1] - p[k-1] + T r) e^(-dt/T),   r = (p[k] - p[k-1])/dt
  nav::standard_atmosphere::Air air(const TruthState& truth, const Weather& drift);

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.last_);
  }

 private:
  struct Last {
    std::int64_t sim_time_ns;
    double port_pa;
    double sensed_pa;

    template <class Self, class Visitor>
    static void state(Self& self, Visitor& visit) {
      visit(self.sim_time_ns, self.port_pa, self.sensed_pa);
    }
  };

  double lagged_pa(std::int64_t sim_time_ns, double port_pa);

  BarometerErrorProfile errors_;
  Vector3 lever_arm_v_m_ = Vector3::Zero();
  std::optional<Last> last_;
};

}  // namespace inslab::barometer
