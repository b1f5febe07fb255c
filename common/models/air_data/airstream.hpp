#pragma once

#include "inslab/data/profiles/air_data_error_profile.hpp"
#include "inslab/data/profiles/installation_profile.hpp"
#include "inslab/data/samples/truth_state.hpp"
#include "inslab/models/air_data/dryden_gusts.hpp"
#include "inslab/nav/standard_atmosphere.hpp"
#include "inslab/noise/random/gauss_markov.hpp"

namespace inslab::air_data {

/// The air at a probe, and how it meets it.
struct Airstream {
  nav::standard_atmosphere::Air air;           ///< static
  Vector3 wind_ned_m_per_s = Vector3::Zero();  ///< gusts included
  Vector3 gust_ned_m_per_s = Vector3::Zero();
  Vector3 v_ab_b_m_per_s = Vector3::Zero();  ///< of the probe against the air, along its axes: x into the flow
  double airspeed_m_per_s = 0.0;
  double mach = 0.0;
  double impact_pressure_pa = 0.0;
  double angle_of_attack_rad = 0.0;    ///< atan2(w, u)
  double angle_of_sideslip_rad = 0.0;  ///< asin(v/V); both 0 without any flow
};

/// The scenario's air along a vehicle's way, as one probe on it meets it.
///
/// The velocity against the air is that of the probe's own place, v_n + C_nv (omega_ev x l), less the wind there. The
/// drifts of the air and the gusts are those of the scenario and not of the sensor: the gusts are of the vehicle's
/// reference point, with its own way through the mean wind, so that probes of one rate and profile are in the same.
class AirOnTheWay {
 public:
  /// Weather streams as a barometer's (models/barometer), gusts from "air/gust"; `air_of_scenario` names one.
  template <class NameStream>
  AirOnTheWay(double period_s, const NameStream& air_of_scenario)
      : period_s_(period_s),
        sea_level_drift_({}, period_s, air_of_scenario("air/sea_level_pressure")),
        temperature_drift_({}, period_s, air_of_scenario("air/temperature")),
        gusts_(air_of_scenario("air/gust")) {}

  void use(const AirDataErrorProfile& profile);
  void use(const InstallationProfile& installation);

  /// At sample k >= 1, which `truth` is of. Samples come in order, each once.
  Airstream at(std::uint64_t k, const TruthState& truth);

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.sea_level_drift_, self.temperature_drift_, self.gusts_);
  }

 private:
  nav::standard_atmosphere::Air air_at(std::uint64_t k, double height_m, std::int64_t sim_time_ns);
  Vector3 gust_ned_m_per_s(std::uint64_t k, const TruthState& truth);

  double period_s_;
  DaysAir air_;
  WindField wind_;
  Vector3 lever_arm_v_m_ = Vector3::Zero();
  Matrix3 C_bv_ = Matrix3::Identity();
  random::GaussMarkov sea_level_drift_;
  random::GaussMarkov temperature_drift_;
  DrydenGusts gusts_;
};

}  // namespace inslab::air_data
