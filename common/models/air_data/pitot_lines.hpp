#pragma once

#include "inslab/data/profiles/air_data_error_profile.hpp"
#include "inslab/data/profiles/fault_profile.hpp"
#include "inslab/data/samples/airflow_truth.hpp"
#include "inslab/models/air_data/airstream.hpp"
#include "inslab/models/sensing/first_order_lag.hpp"

namespace inslab::air_data {

/// Part of the impact pressure that a tube feels whose axis is that of `v_b`'s x: all of it to the acceptance angle a,
/// beyond it cos^2(90 deg (angle - a)/(90 deg - a)), nothing from abeam or from behind. Published tubes are within a
/// percent to an angle of 10 to 25 deg and fall off beyond (W. Gracey, NACA Report 1303, 1957); the shape is ours.
double part_felt(const Vector3& v_b, double acceptance_angle_rad);

/// The pitot and the static line of a probe, from their mouths to the sensors: each lags, and each may be blocked.
///
/// A pitot tube with ice in its mouth empties through its drain, and the airspeed falls to zero; with ice in the drain
/// too its pressure stays, and against the static line the airspeed grows as the vehicle climbs. Source: FAA-H-8083-25,
/// Pilot's handbook of aeronautical knowledge, chapter on flight instruments (blockage of the pitot-static system).
class PitotLines {
 public:
  struct Pressures {
    double pitot_pa = 0.0;
    double static_pa = 0.0;
  };

  void use(const AirDataErrorProfile& errors) { errors_ = errors; }
  void use(const FaultProfile& fault) { fault_ = fault; }

  /// What comes to the sensors at a sim time later than that of the call before, entered into both budgets.
  Pressures follow(std::int64_t sim_time_ns, const Airstream& stream, AirflowTruth& truth);

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.pitot_, self.static_, self.drains_);
  }

 private:
  double pitot_pa(std::int64_t sim_time_ns, double mouth_pa, double outside_pa);

  AirDataErrorProfile errors_;
  FaultProfile fault_;
  sensing::FirstOrderLag pitot_;
  sensing::FirstOrderLag static_;
  bool drains_ = false;  ///< the pitot line was empty to the drain at the last call
};

}  // namespace inslab::air_data
