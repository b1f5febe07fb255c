#include "inslab/referee/score/true_pose.hpp"

#include <gtest/gtest.h>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/nav/attitude.hpp"
#include "tests/unit/referee/score/straight_run.hpp"

namespace inslab::score {
namespace true_pose_test {

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

/// Where a point of that vehicle is and how it moves, by the circle's own geometry: turned and carried along in the
/// tangent plane, then seen from the point's own NED.
TruePose point_of_circle(double t_s, const Vector3& arm_v_m, const Quaternion& q_vb) {
  const nav::Geodetic centre{0.5235987755982988, 1.9896753472735358, 20.0};
  const double angle = kTurnRate_rad_per_s * t_s;
  const Quaternion q_centre_v = nav::quaternion_from_rpy({0.0, 0.0, angle});
  const Vector3 from_centre = kRadius_m * Vector3(std::sin(angle), -std::cos(angle), 0.0) + q_centre_v * arm_v_m;
  TruePose pose;
  pose.position = nav::displaced(centre, from_centre);
  const Matrix3 C_point_centre = nav::C_en(pose.position.latitude_rad, pose.position.longitude_rad).transpose() *
                                 nav::C_en(centre.latitude_rad, centre.longitude_rad);
  pose.v_n = C_point_centre * Vector3(0.0, 0.0, kTurnRate_rad_per_s).cross(from_centre);
  pose.q_n_body = Quaternion(C_point_centre) * q_centre_v * q_vb;
  return pose;
}

// h^4/384 of the fourth derivative of position, 40 m (0.5 rad/s)^4, is 4e-12 m at 200 Hz; what remains is the rounding
// of the angles, 1e-9 m. Velocity: that rounding over the interval, and h^3/72 sqrt(3) of the same.
TEST(TruthBetween, IsExactInTheMiddleOfATurn) {
  for (int k = 0; k < 400; ++k) {
    const double t_s = k * 0.005;
    const TruthState between = truth_between(circling(t_s), circling(t_s + 0.005), ns(t_s + 0.0017));
    const TruthState exact = circling(t_s + 0.0017);
    EXPECT_LT(nav::ned_from(geodetic_of(exact), geodetic_of(between)).norm(), 1e-8);
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
  EXPECT_LT((nav::ned_from(geodetic_of(truth), pose.position) - C_nv * arm_v_m).norm(), 2e-9);
  const Vector3 turning_v(0.0, 0.0, kTurnRate_rad_per_s);
  // The arm's NED is turned against the vehicle's by the arm over the Earth's radius: 20 m/s x 4e-7.
  EXPECT_LT((pose.v_n - truth.v_n - C_nv * turning_v.cross(arm_v_m)).norm(), 1e-5);
}

/// Scores an app whose answers are the closed form of a point that turns with the vehicle.
Scorer with_answers_of(ReferencePoint point, const InstallationProfile& installation) {
  scenario::Scenario scenario = scenario_with();
  scenario.gnss.emplace_back();
  Scorer scorer(scenario);
  scorer.add(installation, -1);
  const Vector3 rpy_rad = installation.mounting_rpy_deg * (std::acos(-1.0) / 180.0);
  const Quaternion q_vb = nav::quaternion_from_rpy({rpy_rad.x(), rpy_rad.y(), rpy_rad.z()});
  for (int k = 0; k <= 400; ++k) scorer.add(circling(k * 0.005));
  for (int k = 0; k < 400; ++k) {
    const double t_s = k * 0.005 + 0.0017;
    NavSolution solution = solution_at(circling(t_s), Vector3::Zero());
    const TruePose pose = point_of_circle(t_s, installation.lever_arm_v_m, q_vb);
    solution.reference_point = point;
    solution.latitude_rad = pose.position.latitude_rad;
    solution.longitude_rad = pose.position.longitude_rad;
    solution.height_m = pose.position.height_m;
    solution.v_n = pose.v_n;
    solution.q_n_body = pose.q_n_body;
    scorer.add(solution, 0);
  }
  scorer.finish();
  return scorer;
}

// Positions to the rounding of their angles; velocities to that over an interval, and to the rate's own over the arm,
// 1e-6 rad/s times 3 m; attitudes to 1e-9 rad.
void expect_no_error(const Scorer& scorer) {
  const ErrorStatistics& all = scorer.phases().at({});
  EXPECT_EQ(all.count(), 400u);
  EXPECT_LT(all.position().largest.norm(), 1e-8);
  EXPECT_LT(all.velocity().largest.norm(), 6e-6);
  EXPECT_LT(all.phi().largest.norm(), 2e-9);
}

TEST(ReferencePoint, OfTheImuIsItsCentreWithItsOwnAxes) {
  InstallationProfile installation;
  installation.target = {SensorKind::Imu, 0};
  installation.lever_arm_v_m = Vector3(-1.5, 0.7, 0.9);
  installation.mounting_rpy_deg = Vector3(10.0, -20.0, 120.0);
  expect_no_error(with_answers_of(ReferencePoint::Imu, installation));
}

TEST(ReferencePoint, OfTheAntennaIsItsPhaseCentreWithTheVehiclesAxes) {
  InstallationProfile installation;
  installation.target = {SensorKind::Gnss, 0};
  installation.lever_arm_v_m = Vector3(2.0, -1.0, -1.4);
  expect_no_error(with_answers_of(ReferencePoint::Antenna, installation));
}

TEST(ReferencePoint, OfTheVehicleIsNeitherSensors) {
  InstallationProfile nowhere;
  nowhere.target = {SensorKind::Imu, 0};
  expect_no_error(with_answers_of(ReferencePoint::Vehicle, nowhere));
}

// An app that answers for the IMU but says it is the vehicle's point is off by the arm: sqrt(1.5^2 + 0.7^2) level.
TEST(ReferencePoint, ThatIsNamedWronglyShowsAsTheArm) {
  InstallationProfile installation;
  installation.target = {SensorKind::Imu, 0};
  installation.lever_arm_v_m = Vector3(-1.5, 0.7, 0.9);
  const Scorer scorer = with_answers_of(ReferencePoint::Vehicle, installation);
  EXPECT_NEAR(*in_all(scorer, scenario::Metric::HorizontalRms), std::hypot(1.5, 0.7), 1e-5);  // 0.9 m, 40 m off: 6e-6
  EXPECT_NEAR(*in_all(scorer, scenario::Metric::VerticalRms), 0.9, 1e-5);
}

/// A vehicle on the spot that does not turn until the corner at 0 and then turns about down.
TruthState turning_from_a_corner(double t_s) {
  TruthState truth = standing(t_s);
  const double yaw_rad = std::max(0.0, t_s) * kTurnRate_rad_per_s;
  truth.q_nv = nav::quaternion_from_rpy({0.0, 0.0, yaw_rad});
  const Vector3 turning_v(0.0, 0.0, t_s < 0.0 ? 0.0 : kTurnRate_rad_per_s);
  truth.omega_iv_v = truth.q_nv.conjugate() * nav::omega_ie_n(truth.latitude_rad) + turning_v;
  truth.rate_jump = t_s == 0.0;
  return truth;
}

// The sample at the corner carries the rate after it; between it and the one before, nothing has turned yet.
TEST(TruthBetween, AJumpOfTheRateDoesNotReachIntoTheIntervalBeforeIt) {
  for (const double t_s : {-0.004, -0.0025, -0.001}) {
    const TruthState between = truth_between(turning_from_a_corner(-0.005), turning_from_a_corner(0.0), ns(t_s));
    EXPECT_LT(nav::angle_between(between.q_nv, turning_from_a_corner(t_s).q_nv), 1e-12);
    EXPECT_LT((between.omega_iv_v - turning_from_a_corner(t_s).omega_iv_v).norm(), 1e-10);
  }
  for (const double t_s : {0.001, 0.0025, 0.004}) {
    const TruthState between = truth_between(turning_from_a_corner(0.0), turning_from_a_corner(0.005), ns(t_s));
    EXPECT_LT(nav::angle_between(between.q_nv, turning_from_a_corner(t_s).q_nv), 1e-12);
    EXPECT_LT((between.omega_iv_v - turning_from_a_corner(t_s).omega_iv_v).norm(), 1e-10);
  }
}

// A corner in the middle of an interval h, which no flag tells of: the cubic with the ends' angles 0 and J h/2 and
// rates 0 and J is at J h/8 in the middle, where the truth is at 0, and nowhere further off.
TEST(TruthBetween, ACornerInsideAnIntervalCostsAnEighthOfTheJumpOverIt) {
  const double h_s = 0.005;
  const TruthState before = turning_from_a_corner(-0.5 * h_s), after = turning_from_a_corner(0.5 * h_s);
  const double bound_rad = kTurnRate_rad_per_s * h_s / 8.0;
  double largest_rad = 0.0;
  for (int i = 1; i < 20; ++i) {
    const double t_s = (i / 20.0 - 0.5) * h_s;
    const TruthState between = truth_between(before, after, ns(t_s));
    largest_rad = std::max(largest_rad, nav::angle_between(between.q_nv, turning_from_a_corner(t_s).q_nv));
  }
  EXPECT_NEAR(largest_rad, bound_rad, 1e-6 * bound_rad);
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

}  // namespace true_pose_test
}  // namespace inslab::score
