#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "inslab/data/samples/truth_state.hpp"
#include "inslab/referee/verify/reference_earth.hpp"
#include "inslab/referee/verify/subjects.hpp"
#include "inslab/scenario/trajectory.hpp"

/// The truth against an independent solution: the same motion written in ECEF as displacement from the start, in
/// extended precision, solved by two general methods of Boost.Odeint and restarted at every corner of the motion.
/// Nothing of the integrator is shared: motions, ellipsoid and gravity are written again from their sources.
namespace inslab::verify {

using RealQuaternion = Eigen::Quaternion<Real>;

/// The vehicle at one instant, and what a perfect IMU at its reference point measured since the instant before.
struct ReferenceState {
  Real time_s = 0;
  RealVector displacement_e_m = RealVector::Zero();  ///< from the start
  RealVector v_n = RealVector::Zero();               ///< m/s
  RealQuaternion q_nv = RealQuaternion::Identity();
  RealVector dtheta_v = RealVector::Zero();  ///< rad
  RealVector dv_v = RealVector::Zero();      ///< m/s
};

enum class Solver { BulirschStoer, DormandPrince };

/// The motion of a table every whole second, from second 1 to the last one within `duration_s`, by the given solver at
/// an absolute tolerance of 1e-11 m. `start` is the truth at the table's start. Somigliana gravity without
/// disturbance; throws std::invalid_argument when the trajectory asks for another, or breaks a rule.
std::vector<ReferenceState> solve_in_ecef(const scenario::Trajectory& trajectory, const TruthState& start,
                                          double duration_s, Solver solver);

/// Of the whole-second instants, RMS of the norm: truth minus reference.
struct Differences {
  Real position_m = 0;
  Real velocity_m_per_s = 0;
  Real attitude_deg = 0;
  Real dtheta_rad = 0;       ///< of the increments of a second
  Real dv_m_per_s = 0;       ///< of the increments of a second
  Real dv_size_m_per_s = 0;  ///< of the increments of a second themselves
  Real solvers_m = 0;        ///< the largest distance between the positions of the two solvers
  std::size_t seconds = 0;
};

/// Runs the truth of the table at 200 Hz beside both solvers.
Differences compare_with_ecef(const scenario::Trajectory& trajectory, double duration_s,
                              const TruthOf& truth = product_truth);

}  // namespace inslab::verify
