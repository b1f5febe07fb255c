// A ship's heave against closed forms: what a sinusoid along the ellipsoid's normal adds to a path.

#include "inslab/models/trajectory/heave.hpp"

#include <gtest/gtest.h>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/trajectory/smooth_model.hpp"
#include "inslab/models/trajectory/waypoint_motion.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::trajectory {
namespace heave_test {

constexpr double kAmplitude_m = 15.0;
constexpr double kPeriod_s = 20.0;
constexpr double kOmega = 2.0 * units::kPi / kPeriod_s;

/// A ship between two places, far too fast, so that what depends on its speed is seen.
scenario::Trajectory route(double speed_m_per_s, double heave_amplitude_m = kAmplitude_m) {
  scenario::Trajectory trajectory;
  trajectory.source = scenario::TrajectorySource::Waypoints;
  scenario::VehicleAttitude& ship = trajectory.attitude_from_path;
  ship.vehicle_class = scenario::VehicleClass::Ship;
  ship.heave_amplitude_m = heave_amplitude_m;
  ship.heave_period_s = kPeriod_s;
  trajectory.waypoints = {{60.0, 5.0, 40.0, speed_m_per_s}, {60.2, 5.7, 40.0, speed_m_per_s}};
  return trajectory;
}

/// A ship that stays where it is for a while, then leaves.
scenario::Trajectory at_anchor() {
  scenario::Trajectory trajectory = route(0.0);
  trajectory.waypoints.front().wait_s = 1000.0;
  trajectory.waypoints.back().speed_m_per_s = 5.0;
  return trajectory;
}

std::vector<TruthState> run(const scenario::Trajectory& trajectory, double rate_hz, double seconds) {
  SmoothModel model(motion_along_waypoints(trajectory, time::from_seconds(seconds)), "waypoint", nav::Gravity(),
                    time::Rate(rate_hz), {2300, 0});
  std::vector<TruthState> truth{model.current()};
  while (time::Rate(rate_hz).at(truth.size()) <= time::from_seconds(seconds)) truth.push_back(model.advance());
  return truth;
}

double seconds(const TruthState& truth) { return time::to_seconds(truth.header.sim_time_ns); }
TEST(Heave, IsASinusoidInHeightAndLeavesLatitudeAndLongitude) {
  const auto calm = run(route(300.0, 0.0), 50.0, 100.0), sea = run(route(300.0), 50.0, 100.0);
  for (std::size_t i = 0; i < sea.size(); ++i) {
    const double up_m = kAmplitude_m * std::sin(kOmega * seconds(sea[i]));
    ASSERT_EQ(sea[i].latitude_rad, calm[i].latitude_rad);
    ASSERT_EQ(sea[i].longitude_rad, calm[i].longitude_rad);
    ASSERT_NEAR(sea[i].height_m - calm[i].height_m, up_m, 1e-12) << i;
    // Further from the Earth's axis the same latitude and longitude pass faster.
    const double s = std::sin(sea[i].latitude_rad);
    const double north = nav::wgs84::meridian_radius_from_sine_m(s) + calm[i].height_m;
    const double east = nav::wgs84::transverse_radius_from_sine_m(s) + calm[i].height_m;
    ASSERT_NEAR(sea[i].v_n.x(), calm[i].v_n.x() * (1.0 + up_m / north), 1e-12) << i;
    ASSERT_NEAR(sea[i].v_n.y(), calm[i].v_n.y() * (1.0 + up_m / east), 1e-12) << i;
    ASSERT_NEAR(sea[i].v_n.z() - calm[i].v_n.z(), -kAmplitude_m * kOmega * std::cos(kOmega * seconds(sea[i])), 1e-12);
    ASSERT_EQ(sea[i].q_nv.coeffs(), calm[i].q_nv.coeffs());
  }
}

TEST(Heave, AtAnchorIsFeltAsTheSinusoidsAcceleration) {
  const nav::Gravity gravity;
  const auto truth = run(at_anchor(), 100.0, 60.0);
  const nav::Matrix3 C_vn = nav::matrix_from_quaternion(truth[0].q_nv).transpose();
  const nav::Vector3 omega_ie_n = nav::omega_ie_n(truth[0].latitude_rad);
  const double g_0 = gravity.g_n({truth[0].latitude_rad, truth[0].longitude_rad, 40.0}).z();
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const auto angle = [&](std::size_t k) { return kOmega * seconds(truth[k]); };
    const nav::Vector3 v_n(0.0, 0.0, -kAmplitude_m * kOmega * std::cos(angle(i)));
    const nav::Vector3 a_n(0.0, 0.0, kAmplitude_m * kOmega * kOmega * std::sin(angle(i)));
    const nav::Vector3 f_n = a_n + 2.0 * omega_ie_n.cross(v_n) - gravity.g_n(geodetic_of(truth[i]));
    ASSERT_LT((truth[i].f_v - C_vn * f_n).norm(), 1e-12) << i;
    // Velocity and height gained are closed forms; gravity falls nearly linearly over the 30 m: its slope's slope,
    // 7e-13/(m s^2), leaves 2e-12 of the 10 ms.
    const double up_m = kAmplitude_m * (std::sin(angle(i)) - std::sin(angle(i - 1)));
    const double g_slope = (gravity.g_n({truth[0].latitude_rad, truth[0].longitude_rad, 41.0}).z() -
                            gravity.g_n({truth[0].latitude_rad, truth[0].longitude_rad, 39.0}).z()) /
                           2.0;
    const double up_m_s = kAmplitude_m / kOmega * (std::cos(angle(i - 1)) - std::cos(angle(i)));
    nav::Vector3 dv_n(0.0, 0.0, -kAmplitude_m * kOmega * (std::cos(angle(i)) - std::cos(angle(i - 1))));
    dv_n += 2.0 * omega_ie_n.cross(nav::Vector3(0.0, 0.0, -up_m));
    dv_n.z() -= g_0 * 0.01 + g_slope * up_m_s;
    ASSERT_LT((truth[i].dv_v - C_vn * dv_n).norm(), 3e-12) << i;
    ASSERT_LT((truth[i].dtheta_v - C_vn * omega_ie_n * 0.01).norm(), 1e-15) << i;
  }
}

TEST(Heave, OfAShipInMotionHasTheForceOfItsVelocitysRate) {
  // The normal turns by v/R = 4.7e-5 rad/s: twice that times 4.7 m/s is 4.4e-4 m/s^2 along the track, the square of it
  // times 15 m is 3.3e-8 m/s^2.
  const nav::Gravity gravity;
  const auto truth = run(route(300.0), 50.0, 100.0);
  for (std::size_t i = 2; i + 2 < truth.size(); ++i) {
    const TruthState& here = truth[i];
    const auto derivative = [&](auto value) -> Vector3 {
      return (8.0 * (value(truth[i + 1]) - value(truth[i - 1])) - (value(truth[i + 2]) - value(truth[i - 2]))) / 240e-3;
    };
    const Vector3 omega_ie_n = nav::omega_ie_n(here.latitude_rad);
    const Vector3 omega_en_n = nav::omega_en_n(geodetic_of(here), here.v_n);
    const Vector3 a_n = derivative([](const TruthState& t) { return t.v_n; });
    const Vector3 f_n = a_n + (2.0 * omega_ie_n + omega_en_n).cross(here.v_n) - gravity.g_n(geodetic_of(here));
    // h^4/30 of the fifth derivative, 15 m (2 pi/20 s)^6: 7e-11 m/s^2; the rounding of 300 m/s over 20 ms 4e-12.
    ASSERT_LT((here.q_nv * here.f_v - f_n).norm(), 3e-10) << i;
  }
}

TEST(Heave, IsInTheIncrementsAsTheIntegralOfTheForce) {
  scenario::Trajectory trajectory = route(300.0);
  trajectory.attitude_from_path.roll_amplitude_deg = 10.0;
  const auto coarse = run(trajectory, 100.0, 50.0), fine = run(trajectory, 200.0, 50.0);
  for (std::size_t i = 1; i < coarse.size(); ++i) {
    const Vector3 &f0 = fine[2 * i - 2].f_v, &f1 = fine[2 * i - 1].f_v, &f2 = fine[2 * i].f_v;
    // Simpson's rule: h^5/2880 of the fourth derivative, which jumps with the attitude spline's third: 10 m/s^2 times
    // 0.04 rad/s^3 over a knot interval of 0.16 s is 3 m/s^6.
    ASSERT_LT((coarse[i].dv_v - 0.01 / 6.0 * (f0 + 4.0 * f1 + f2)).norm(), 2e-11) << i;
    const Vector3 sum = fine[2 * i].dv_v + fine[2 * i - 1].dv_v;
    ASSERT_LT((coarse[i].dv_v - sum).norm(), 1e-14) << i;
  }
}

}  // namespace heave_test
}  // namespace inslab::trajectory
