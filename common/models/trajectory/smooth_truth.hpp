#pragma once

#include "inslab/data/samples/truth_state.hpp"
#include "inslab/models/trajectory/smooth_vehicle.hpp"

namespace inslab::trajectory {

/// The truth of a vehicle on smooth curves, now, with the increments of its last advance(), which took `interval`. The
/// sample's number and its GPS time are left to who has them.
inline TruthState truth_of(const SmoothVehicle& vehicle, time::Nanoseconds interval) {
  TruthState truth;
  truth.header.sim_time_ns = vehicle.now().count();
  truth.latitude_rad = vehicle.position().latitude_rad;
  truth.longitude_rad = vehicle.position().longitude_rad;
  truth.height_m = vehicle.position().height_m;
  truth.v_n = vehicle.v_n();
  truth.q_nv = vehicle.q_nv();
  truth.omega_iv_v = vehicle.omega_iv_v();
  truth.f_v = vehicle.f_v();
  truth.dtheta_v = vehicle.dtheta_v();
  truth.dv_v = vehicle.dv_v();
  truth.interval_ns = interval.count();
  truth.segment_index = vehicle.piece_index();
  return truth;
}

}  // namespace inslab::trajectory
