#pragma once

#include "inslab/data/samples/nav_solution.hpp"
#include "inslab/data/samples/truth_state.hpp"
#include "inslab/nav/geodesy.hpp"

namespace inslab::score {

/// Where a sensor truly sits on the vehicle.
struct Mounting {
  Vector3 lever_arm_v_m = Vector3::Zero();
  Quaternion q_vb = Quaternion::Identity();
};

/// Where a reference point truly is, how it moves, and which way its axes look, in its own NED.
struct TruePose {
  nav::Geodetic position;
  Vector3 v_n = Vector3::Zero();                 ///< m/s
  Quaternion q_n_body = Quaternion::Identity();  ///< q_nb of an IMU, q_nv otherwise
};

/// The truth at `sim_time_ns`, between two neighbouring samples of it: position on the cubic that takes both positions
/// and both velocities, attitude on the cubic of the rotation vector that takes both attitudes and both rates (before a
/// jump of the rate, which the later sample already carries, on the quadratic that leaves its rate out). Off by
/// h^4/384 of the fourth derivative of position: 7e-9 m at 200 Hz for 1 m/s^2 at 10 Hz. Fields that hold integrals, and
/// f_v, are the later sample's.
TruthState truth_between(const TruthState& before, const TruthState& after, std::int64_t sim_time_ns);

/// The pose of the point at `mounting` for this truth.
TruePose true_pose(const TruthState& truth, const Mounting& mounting);

/// Errors of a solution: estimate less truth.
struct SolutionError {
  Vector3 position_ned_m = Vector3::Zero();        ///< in NED at the true point
  Vector3 velocity_ned_m_per_s = Vector3::Zero();  ///< each in its own NED
  Vector3 phi_rad = Vector3::Zero();               ///< rotation vector of C_true C_estimated^T, in n
};

/// What the solution is off by. The solution is finite, its quaternion a rotation.
SolutionError error_of(const NavSolution& solution, const TruePose& truth);

}  // namespace inslab::score
