#include "score/true_pose.hpp"

#include <gtest/gtest.h>

#include "nav/attitude.hpp"
#include "tests/unit/score/straight_run.hpp"

namespace inslab::score {
namespace {

constexpr double kRadius_m = 40.0;
constexpr double kTurnRate_rad_per_s = 0.5;

/// A level vehicle on a circle around a point of the ellipsoid's tangent plane; its own height and NED follow from
/// ECEF.
TruthState circling(double t_s) {
  const nav::Geodetic centre{0.5235987755982988, 1.9896753472735358, 20.0};
  const double angle = kTurnRate_rad_per_s * t_s;
  const nav::Geodetic place = nav::displaced(centre, kRadius_m * Vector3(std::sin(angle), -std::cos(angle), 0.0));
  const Matrix3 C_en_centre = nav::C_en(centre.latitude_rad, centre.longitude_rad);
  const Matrix3 C_en = nav::C_en(place.latitude_rad, place.longitude_rad);
  TruthState truth;
  stamp(truth.header, t_s);
  truth.latitude_rad = place.latitude_rad;
  truth.longitude_rad = place.longitude_rad;
  truth.height_m = place.height_m;
  truth.v_n = C_en.transpose() * C_en_centre * Vector3(std::cos(angle), std::sin(angle), 0.0) *
              (kRadius_m * kTurnRate_rad_per_s);
  const Quaternion q_centre_v = nav::quaternion_from_rpy({0.0, 0.0, angle});
  truth.q_nv = Quaternion(C_en.transpose() * C_en_centre) * q_centre_v;
  truth.omega_iv_v =
      q_centre_v.conjugate() * Vector3(nav::omega_ie_n(centre.latitude_rad) + Vector3(0.0, 0.0, kTurnRate_rad_per_s));
  return truth;
}

nav::Geodetic position_of(const TruthState& truth) { return {truth.latitude_rad, truth.longitude_rad, truth.height_m}; }

// h^4/384 of the fourth derivative of position, 40 m (0.5 rad/s)^4, is 4e-12 m at 200 Hz; what remains is the rounding
// of the angles, 1e-9 m. Velocity: that rounding over the interval, and h^3/72 sqrt(3) of the same.
TEST(TruthBetween, IsExactInTheMiddleOfATurn) {
  for (int k = 0; k < 400; ++k) {
    const double t_s = k * 0.005;
    const TruthState between = truth_between(circling(t_s), circling(t_s + 0.005), ns(t_s + 0.0017));
    const TruthState exact = circling(t_s + 0.0017);
    EXPECT_LT(nav::ned_from(position_of(exact), position_of(between)).norm(), 1e-8);
    EXPECT_LT((between.v_n - exact.v_n).norm(), 3e-6);
    EXPECT_LT(nav::angle_between(between.q_nv, exact.q_nv), 1e-9);
    EXPECT_LT((between.omega_iv_v - exact.omega_iv_v).norm(), 1e-6);
  }
}

TEST(TruthBetween, IsTheLaterSampleAtItsTime) {
  const TruthState later = circling(0.005);
  const TruthState between = truth_between(circling(0.0), later, ns(0.005));
  EXPECT_EQ(between.latitude_rad, later.latitude_rad);
  EXPECT_EQ(between.v_n, later.v_n);
}

TEST(TruePose, AnArmInATurnMovesWithTheTurn) {
  const TruthState truth = circling(3.0);
  const Vector3 arm_v_m(2.0, -1.0, 0.5);
  const TruePose pose = true_pose(truth, {arm_v_m, Quaternion::Identity()});
  const Matrix3 C_nv = truth.q_nv.toRotationMatrix();
  EXPECT_LT((nav::ned_from(position_of(truth), pose.position) - C_nv * arm_v_m).norm(), 2e-9);
  const Vector3 turning_v(0.0, 0.0, kTurnRate_rad_per_s);
  // The arm's NED is turned against the vehicle's by the arm over the Earth's radius: 20 m/s x 4e-7.
  EXPECT_LT((pose.v_n - truth.v_n - C_nv * turning_v.cross(arm_v_m)).norm(), 1e-5);
}

TEST(ErrorOf, AttitudeIsTheRotationVectorFromTheEstimateToTheTruth) {
  const TruthState truth = circling(1.0);
  const Vector3 phi_rad(1e-3, -2e-3, 5e-3);
  NavSolution solution = solution_at(truth, Vector3(1.0, 2.0, -3.0));
  solution.q_n_body = nav::quaternion_from_rotation_vector(phi_rad).conjugate() * truth.q_nv;
  const SolutionError error = error_of(solution, true_pose(truth, {}));
  EXPECT_LT((error.phi_rad - phi_rad).norm(), 1e-12);
  EXPECT_LT((error.position_ned_m - Vector3(1.0, 2.0, -3.0)).norm(), 1e-8);
}

}  // namespace
}  // namespace inslab::score
