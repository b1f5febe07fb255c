// The truth of a live vehicle is the vehicle's motion, smooth whatever becomes of its states on the way.

#include "tests/unit/models/trajectory/live_vehicle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace inslab::trajectory {
namespace live_vehicle_test {

using namespace live_vehicle;

/// Positions are published as angles: half units in the last place of two longitudes and two latitudes, 3 nm in all;
/// and each of the states' own roundings (1.6e-9 m) is an offset until it is led back, on average 8.4/0.5 s = 17/s:
/// 100/17 of them at a time, at random, 4e-9 m; four standard deviations.
constexpr double kPosition_m = 2e-8;
/// What the offset's decay adds to the velocity: 17/s of that.
constexpr double kVelocity_m_per_s = 17.0 * kPosition_m;
/// T^4/384 of the rotation vector's fourth derivative, for yaw, roll and their product below 5 rad/s^4.
constexpr double kAttitude_rad = 1e-8 / 384.0 * 5.0;

class LiveVehicleAt : public testing::TestWithParam<std::pair<double, double>> {};

TEST_P(LiveVehicleAt, TruthIsTheVehicleDelayedByTheLatency) {
  const scenario::Trajectory motion = drive(GetParam().first, GetParam().second);
  const std::vector<TruthState> vehicle = truth_of(motion, kTruthRate_hz, 10.0);
  LiveVehicleModel model = model_of(followed(motion));
  const std::vector<TruthState> truth = follow(model, arrivals_of(states_of(motion, 10.0), kMillisecond_ns), 10.0);
  const std::size_t latency = 4;  // 20 ms at 200 Hz
  for (std::size_t k = latency; k < truth.size(); ++k) {
    const TruthState &is = truth[k], &was = vehicle[k - latency];
    ASSERT_LT(nav::ned_from(position(was), position(is)).norm(), kPosition_m) << k;
    ASSERT_LT((is.v_n - was.v_n).norm(), kVelocity_m_per_s) << k;
    ASSERT_LT(nav::angle_between(is.q_nv, was.q_nv), kAttitude_rad) << k;
  }
  EXPECT_EQ(model.link().truth_samples_extrapolated, 0u);
  EXPECT_EQ(model.link().late, 0u);
  EXPECT_EQ(model.link().missing, 0u);
}

INSTANTIATE_TEST_SUITE_P(Places, LiveVehicleAt,
                         testing::Values(std::pair(48.0, 11.0), std::pair(-33.9, 179.99995), std::pair(89.5, -120.0)));

TEST(LiveVehicle, IncrementsAreThoseOfTheVehicle) {
  const scenario::Trajectory motion = drive();
  const std::vector<TruthState> vehicle = truth_of(motion, kTruthRate_hz, 10.0);
  LiveVehicleModel model = model_of(followed(motion));
  const std::vector<TruthState> truth = follow(model, arrivals_of(states_of(motion, 10.0), kMillisecond_ns), 10.0);
  for (std::size_t k = 5; k < truth.size(); ++k) {
    // An increment errs by the attitude's or velocity's error at both ends; of the velocity, which turns with the
    // attitude by up to 20 m/s, by that too.
    ASSERT_LT((truth[k].dtheta_v - vehicle[k - 4].dtheta_v).norm(), 2.0 * kAttitude_rad) << k;
    ASSERT_LT((truth[k].dv_v - vehicle[k - 4].dv_v).norm(), 2.0 * (kVelocity_m_per_s + 20.0 * kAttitude_rad)) << k;
  }
}

TEST(LiveVehicle, StandsWhereItStartsUntilStatesCome) {
  scenario::Trajectory trajectory = followed(drive());
  trajectory.initial.speed_m_per_s = 0.0;
  LiveVehicleModel model = model_of(trajectory);
  const TruthState first = model.current();
  EXPECT_EQ(first.interval_ns, 0);
  for (int i = 0; i < 50; ++i) {
    const TruthState truth = model.advance();
    EXPECT_LT(nav::ned_from(position(first), position(truth)).norm(), 3e-9);
    EXPECT_LT(truth.v_n.norm(), 1e-15);
    // A perfect IMU at rest: the Earth's rate and gravity.
    EXPECT_NEAR(truth.omega_iv_v.norm(), nav::wgs84::omega_e_rad_per_s, 1e-18);
    EXPECT_NEAR(truth.dv_v.norm(), 5e-3 * nav::Gravity(nav::GravityModel::Normal).g_n(position(first)).norm(), 1e-15);
  }
}

/// States from 4.00 to 4.20 s lost: the truth has nothing from 4.01 s (3.99 and the latency) to 4.23 s.
struct Outage {
  scenario::Trajectory motion = drive();
  std::vector<Arrival> arrivals = arrivals_of(states_of(motion, 10.0), kMillisecond_ns, 4.0, 4.2);
};

TEST(LiveVehicle, CountsWhatIsMissingAndWhatWasExtrapolated) {
  const Outage outage;
  LiveVehicleModel model = model_of(followed(outage.motion));
  follow(model, outage.arrivals, 9.5);
  const VehicleLink& link = model.link();
  EXPECT_EQ(link.missing, 21u);
  EXPECT_EQ(link.returns, 1u);
  // The state of 4.21 s comes at 4.211 s, before the sample at 4.215 s: those at 4.015 to 4.210 s had to do without.
  EXPECT_EQ(link.truth_samples_extrapolated, 40u);
  EXPECT_DOUBLE_EQ(link.longest_extrapolation_s, 0.2);
  EXPECT_EQ(link.late, 0u);
  EXPECT_EQ(link.used, 949u - 21u);
}

TEST(LiveVehicle, ReturnsToTheStatesWithinTheReturnTime) {
  const Outage outage;
  LiveVehicleModel model = model_of(followed(outage.motion));
  const std::vector<TruthState> truth = follow(model, outage.arrivals, 9.5);
  const std::vector<TruthState> vehicle = truth_of(outage.motion, kTruthRate_hz, 10.0);
  const auto off_m = [&](double t_s) {
    const auto k = static_cast<std::size_t>(std::lround(t_s * kTruthRate_hz));
    return nav::ned_from(position(vehicle[k - 4]), position(truth[k])).norm();
  };
  const double worst_m = off_m(4.21);
  EXPECT_GT(worst_m, 1e-3);
  EXPECT_LT(worst_m, 0.5 * 5.0 * 0.2 * 0.2);  // as if the acceleration, at most 2 + 0.35 * 20, were missing by half
  // Of the position's own offset 1 % is left after 0.5 s; those of velocity and acceleration, which are led back with
  // it, leave at most 8.4/2 (1 + 8.4 e^...)... each less than (k t)^2/2 e^(-k t) = 0.8 % of v/k and a/k^2: as much
  // again.
  EXPECT_LT(off_m(4.71), 0.05 * worst_m);
  EXPECT_LT(off_m(6.0), kPosition_m);
}

TEST(LiveVehicle, NeverJumpsWhenStatesStayOutAndReturn) {
  const Outage outage;
  constexpr double kFine_hz = 1000.0;
  LiveVehicleModel model = model_of(followed(outage.motion), kFine_hz);
  const std::vector<TruthState> truth = follow(model, outage.arrivals, 6.0, kFine_hz);
  // The vehicle's own jerk and angular acceleration are below 20 m/s^3 and 2 rad/s^2; leading back 0.05 m, 0.5 m/s and
  // 3 m/s^2 adds at most k^3 r + 3 k^2 v + 3 k a = 830 m/s^3, and 0.02 rad and 0.3 rad/s add k^2 phi + 2 k w = 16
  // rad/s^2; all for a millisecond. The trapezoid of the velocity errs by jerk dt^3/12, the angles by 3 nm.
  for (std::size_t k = 21; k < truth.size(); ++k) {
    const TruthState &a = truth[k - 1], &b = truth[k];
    const Vector3 moved = nav::ned_from(position(a), position(b));
    ASSERT_LT((moved - 0.5e-3 * (a.v_n + b.v_n)).norm(), 850.0 * 1e-9 / 12.0 + 3e-9) << k;
    ASSERT_LT((b.q_nv * b.f_v - a.q_nv * a.f_v).norm(), 0.85) << k;
    ASSERT_LT((b.omega_iv_v - a.omega_iv_v).norm(), 0.018) << k;
  }
}

TEST(LiveVehicle, IncrementsOfFineSamplesAddUpToThoseOfCoarse) {
  // Known from the start which states will come, so that both grids see the same curve; one is missing.
  const scenario::Trajectory motion = drive();
  const std::vector<VehicleState> states = states_of(motion, 2.0);
  LiveVehicleModel coarse = model_of(followed(motion)), fine = model_of(followed(motion), 1000.0);
  std::size_t next = 0;
  for (int k = 1; k <= 300; ++k) {
    while (next < states.size() && states[next].sim_time_ns <= k * 5 * kMillisecond_ns) {
      if (next != 57) {
        coarse.receive(states[next]);
        fine.receive(states[next]);
      }
      ++next;
    }
    const TruthState whole = coarse.advance();
    Vector3 dtheta = Vector3::Zero(), dv = Vector3::Zero();
    TruthState part;
    for (int j = 0; j < 5; ++j) {
      part = fine.advance();
      dtheta += part.dtheta_v;
      dv += part.dv_v;
    }
    // Rounding of sums of some 0.05 m/s; attitudes that differ by rounding turn gravity by as much.
    ASSERT_LT((dtheta - whole.dtheta_v).norm(), 1e-14) << k;
    ASSERT_LT((dv - whole.dv_v).norm(), 1e-12) << k;
    ASSERT_LT((part.v_n - whole.v_n).norm(), 1e-9) << k;
  }
}

TEST(LiveVehicle, IncrementsCarryOneSampleToTheNextThroughAnOutage) {
  // The velocity equation integrated by its own terms: C_nv dv, and the Earth's part by the trapezoid, in steps of 1
  // ms. The attitude inside a step is taken at its middle: second order, omega^2 f dt^3/24 = 1e-10 m/s and the rate's
  // change, 0.018 rad/s in a step, times 10 m/s^2 dt^2/6 = 3e-8 m/s at the return.
  const Outage outage;
  LiveVehicleModel model = model_of(followed(outage.motion), 1000.0);
  const std::vector<TruthState> truth = follow(model, outage.arrivals, 6.0, 1000.0);
  const auto earth = [](const TruthState& t) -> Vector3 {
    const Vector3 rates = 2.0 * nav::omega_ie_n(t.latitude_rad) + nav::omega_en_n(position(t), t.v_n);
    return nav::Gravity(nav::GravityModel::Normal).g_n(position(t)) - rates.cross(t.v_n);
  };
  for (std::size_t k = 1; k < truth.size(); ++k) {
    const TruthState &a = truth[k - 1], &b = truth[k];
    const Quaternion middle = a.q_nv.slerp(0.5, b.q_nv);
    const Vector3 predicted = a.v_n + middle * b.dv_v + 0.5e-3 * (earth(a) + earth(b));
    ASSERT_LT((predicted - b.v_n).norm(), 5e-8) << k;
    const Vector3 omega_in_n = nav::omega_ie_n(a.latitude_rad) + nav::omega_en_n(position(a), a.v_n);
    const Quaternion turned = nav::quaternion_from_rotation_vector(-1e-3 * omega_in_n) * a.q_nv *
                              nav::quaternion_from_rotation_vector(b.dtheta_v);
    // Coning within a step: omega x omega' dt^3/12 = 1 rad/s 18 rad/s^2 1e-9/12.
    ASSERT_LT(nav::angle_between(turned, b.q_nv), 2e-9) << k;
  }
}

TEST(LiveVehicle, AContradictionOfPositionAndVelocityBecomesAnOffsetAndNoVibration) {
  // A simulator with Euler's method: each position is the last one plus T times the last velocity, so in every step it
  // lags by T^2/2 = 1.5e-4 m at the 3 m/s^2 that the car gains. A curve bent to meet the positions would shake by 6
  // times that over T^2: 9 m/s^2.
  const double T_s = 1.0 / kStateRate_hz;
  scenario::Trajectory trajectory = followed(drive());
  trajectory.initial = {48.0, 11.0, 500.0, 0.0, 0.0, 0.0, 0.0};
  LiveVehicleModel model = model_of(trajectory);
  VehicleState state;
  nav::Geodetic place{trajectory.initial.latitude_deg * M_PI / 180.0, trajectory.initial.longitude_deg * M_PI / 180.0,
                      500.0};
  std::vector<Arrival> arrivals;
  std::vector<nav::Geodetic> places{place};
  for (int i = 1; i <= 500; ++i) {
    place = nav::displaced(place, T_s * state.v_n);
    state.sim_time_ns = i * 10 * kMillisecond_ns;
    state.latitude_rad = place.latitude_rad;
    state.longitude_rad = place.longitude_rad;
    state.height_m = place.height_m;
    state.a_n = Vector3(3.0, 0.0, 0.0);
    state.v_n = i * T_s * state.a_n;
    places.push_back(place);
    arrivals.push_back({state, state.sim_time_ns + kMillisecond_ns});
  }
  const auto truth = follow(model, arrivals, 4.9);
  const double k_per_s = 8.4059 / 0.5;
  const double lag_m = 0.5 * 3.0 * T_s * T_s;
  for (std::size_t k = 240; k < truth.size(); k += 2) {
    // After 1.2 s the offset is steady: what a step adds dies out as (1 + x + x^2/2) e^-x, whose integral is 3/k.
    const double behind_m = nav::ned_from(places[(k - 4) / 2], position(truth[k])).norm();
    ASSERT_NEAR(behind_m, 3.0 / k_per_s * lag_m / T_s, lag_m) << k;
    // A step's third derivative, k^3 of it, is there at once; within the step it changes the acceleration by k^3 T.
    const double shake_m_per_s2 = std::pow(k_per_s, 3) * T_s * lag_m;
    ASSERT_NEAR(truth[k].dv_v.x(), 3.0 * 5e-3, shake_m_per_s2 * 5e-3) << k;
  }
}

}  // namespace live_vehicle_test
}  // namespace inslab::trajectory
