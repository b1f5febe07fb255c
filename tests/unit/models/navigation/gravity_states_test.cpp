// Gravity's departure from its model as states of the filter.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/navigation/app_setup.hpp"
#include "inslab/models/navigation/matching_gravity.hpp"
#include "inslab/models/navigation/navigation_filter.hpp"
#include "inslab/models/navigation/processes.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/noise/random/stream.hpp"
#include "inslab/scenario/terrain_gravity.hpp"

namespace inslab::navigation {
namespace gravity_states_test {

constexpr double kDt_s = 0.02;
constexpr std::int64_t kDt_ns = 20'000'000;
const nav::Geodetic kPlace{30.0 * units::kDeg, 114.0 * units::kDeg, 0.0};

/// What no receiver or IMU of the tests is: errors of an IMU by which an aircraft crosses an ocean.
NavigationParameters navigation_grade() {
  NavigationParameters p;
  p.gyro.arw_deg_per_sqrt_h.setConstant(0.002);
  p.gyro.bias_sigma_deg_per_h.setConstant(0.003);
  p.accel.vrw_m_per_s_per_sqrt_h.setConstant(0.003);
  p.accel.bias_sigma_mgal.setConstant(10.0);
  p.gyro.scale_factor_sigma_ppm.setConstant(5.0);
  p.accel.scale_factor_sigma_ppm.setConstant(20.0);
  for (Vector3* constant : {&p.gyro.bias_correlation_time_s, &p.gyro.scale_factor_correlation_time_s,
                            &p.accel.bias_correlation_time_s, &p.accel.scale_factor_correlation_time_s}) {
    constant->setZero();
  }
  p.initial.attitude_sigma_ned_deg = Vector3(0.002, 0.002, 0.02);
  p.initial.position_sigma_ned_m.setConstant(0.02);
  p.initial.velocity_sigma_ned_m_per_s.setConstant(0.01);
  p.zero_velocity.use = false;
  return p;
}

ImuInterval interval(const nav::ImuIncrements& increments, std::int64_t k) {
  ImuInterval one;
  one.end_ns = k * kDt_ns;
  one.increments = increments;
  return one;
}

// What is estimated of a constant departure is felt as by a mechanization that knows it.
TEST(GravityStates, WhatIsEstimatedPullsAsGravityDoes) {
  const double g = nav::Gravity().g_n(kPlace).z();
  const nav::Gravity::Disturbance disturbance{40.0, 20.0, -10.0};
  const Vector3 added(-g * 20.0 * units::kArcsec, g * 10.0 * units::kArcsec, 40.0 * units::kMGal);
  NavigationParameters p = navigation_grade();
  p.states.gravity_disturbance = true;
  p.gravity_disturbance.correlation_m = 0.0;
  const nav::NavState start{kPlace, {100.0, 0.0, 0.0}, nav::Quaternion::Identity()};
  Estimates errors;
  errors[StateBlock::Gravity] = added;
  InertialFilter filter(p, nav::Gravity(), start, errors, Covariance(initial_sigmas(p)), 0, std::nullopt);
  nav::Strapdown knows(start, nav::Gravity(nav::GravityModel::Somigliana, disturbance), {true});
  const nav::ImuIncrements turning{kDt_s * Vector3(0.0, 0.01, 0.05), kDt_s * Vector3(0.5, 1.0, -9.8), kDt_s};
  for (std::int64_t k = 1; k <= 3000; ++k) {
    filter.advance(interval(turning, k));
    knows.advance(turning);
  }
  const double gained_m_per_s = 60.0 * added.norm();
  // The first interval's half is the mean attitude's against its start's, 5e-4 rad, the turn; sculling terms are less.
  EXPECT_LT((filter.state().v_n - knows.v_n()).norm(), 1e-3 * gained_m_per_s);
  EXPECT_LT(nav::ned_from(filter.state().position, knows.position()).norm(), 1e-3 * 30.0 * gained_m_per_s);
}

// At 200 m/s two seconds are 400 m, u = 0.04 of D = 10 km. The velocity takes the integral of x, and x goes on as it
// is expected to: (1 + u) exp(-u) of it and u exp(-u) of its change.
TEST(GravityStates, TheEstimateAndItsErrorsGoOnWithTheWay) {
  NavigationParameters p = navigation_grade();
  p.states.gravity_disturbance = true;
  p.gravity_disturbance.correlation_m = 10e3;
  const nav::NavState start{kPlace, {160.0, 120.0, 0.0}, nav::Quaternion::Identity()};
  Estimates errors;
  errors[StateBlock::Gravity] = Vector3(1e-4, 2e-4, -1e-4);
  errors[StateBlock::GravityChange] = Vector3(5e-4, 0.0, 3e-4);
  InertialFilter filter(p, nav::Gravity(), start, errors, Covariance(initial_sigmas(p)), 0, std::nullopt);
  for (std::int64_t k = 1; k <= 100; ++k) {
    filter.advance(interval({Vector3::Zero(), kDt_s * -nav::Gravity().g_n(kPlace), kDt_s}, k));
  }
  filter.settle();
  const double u = 0.04, fall = std::exp(-u);
  const Vector3 expected = fall * ((1.0 + u) * errors[StateBlock::Gravity] + u * errors[StateBlock::GravityChange]);
  // Coriolis changes the speed by 2e-4 of it.
  EXPECT_LT((filter.estimates()[StateBlock::Gravity] - expected).norm(), 1e-8);
  const StateMatrix& P = filter.covariance().matrix();
  const Eigen::Index x = filter.layout().first(StateBlock::Gravity);
  const Eigen::Index h = filter.layout().first(StateBlock::GravityChange);
  const double sigma = 28.5 * units::kMGal;
  EXPECT_NEAR(P(x, x) / (sigma * sigma), 1.0, 1e-12);
  EXPECT_NEAR(P(h, h) / (sigma * sigma), 1.0, 1e-12);
  EXPECT_NEAR(P(x, h) / (sigma * sigma), 0.0, 1e-12);
  // E[v x] after 2 s: the integral of (1 + u) exp(-u), 2 s (1 - u^2/6 + ...) sigma^2; tilt takes 1e-6 of it.
  EXPECT_NEAR(P(kVelocity, x) / (2.0 * sigma * sigma), 1.0 - u * u / 6.0 + u * u * u / 12.0, 1e-5);
}

ImuSample at_rest(std::int64_t k, const Vector3& f_b) {
  ImuSample sample;
  sample.dtheta_b = kDt_s * nav::omega_ie_n(kPlace.latitude_rad);
  sample.dv_b = kDt_s * f_b;
  sample.interval_ns = kDt_ns;
  sample.header.sim_time_ns = k * kDt_ns;
  return sample;
}

// Levelled by the plumb line the filter errs by what gravity leans, and feels no force: 30 s later its velocity is as
// sure as at the beginning. A filter whose attitude was given falls aside with sigma t = 8.6 mm/s.
TEST(GravityStates, ARestLevelsByThePlumbLine) {
  NavigationParameters p = navigation_grade();
  p.states.gravity_disturbance = true;
  p.accel.bias_sigma_mgal.setConstant(0.1);
  p.accel.scale_factor_sigma_ppm.setConstant(0.1);
  p.initial.velocity_sigma_ned_m_per_s.setConstant(0.001);
  p.initial.attitude_sigma_ned_deg.setConstant(1e-6);
  p.initial.alignment_s = 60.0;
  for (const bool levels : {true, false}) {
    p.initial.attitude = levels ? InitialAttitude::StaticAlignment : InitialAttitude::Given;
    NavigationFilter filter(p, nav::Gravity());
    const Vector3 f_b = -nav::Gravity().g_n(kPlace);
    GnssFix fix;
    fix.fix_type = FixType::Fixed;
    fix.latitude_rad = kPlace.latitude_rad;
    fix.longitude_rad = kPlace.longitude_rad;
    fix.height_m = kPlace.height_m;
    fix.position_sigma_ned_m.setConstant(0.01);
    fix.velocity_sigma_ned_m_per_s.setConstant(0.001);
    filter.add(fix);
    std::int64_t k = 1;
    while (filter.filter() == nullptr) {
      filter.add(at_rest(k, f_b));
      ASSERT_LT(++k, 4000);
    }
    const double sigma = 28.5 * units::kMGal, g = -f_b.z();
    const Eigen::Index x = filter.filter()->layout().first(StateBlock::Gravity);
    const StateMatrix begun = filter.filter()->covariance().matrix();
    EXPECT_NEAR(begun(kAttitude, x + 1), levels ? sigma * sigma / g : 0.0, 1e-6 * sigma * sigma / g);
    EXPECT_NEAR(begun(kAttitude + 1, x), levels ? -sigma * sigma / g : 0.0, 1e-6 * sigma * sigma / g);
    for (int i = 0; i < 1500; ++i) filter.add(at_rest(k++, f_b));
    InertialFilter now = *filter.filter();
    now.settle();
    const double grown = std::sqrt(now.covariance().matrix()(kVelocity, kVelocity) - 1e-6);
    if (levels) {
      EXPECT_LT(grown, 8e-4)
          << "noise of the forces, 2.7e-4 m/s, and of the rates, 9.8 x 30^1.5/sqrt(3) x 5.8e-7 = 5.4e-4";
    } else {
      EXPECT_NEAR(grown, 30.0 * sigma, 0.01 * 30.0 * sigma);
    }
  }
}

/// A vehicle that goes straight over a field that is drawn with the run, at a speed that sways a little so that forces
/// show heading; a filter that begins with drawn errors, and 60 s without fixes at the end.
class Flight {
 public:
  Flight(const NavigationParameters& p, const scenario::GravityVariation& variation, double speed_m_per_s,
         std::uint64_t seed)
      : p_(p),
        layout_(p.states),
        draws_(seed, "gravity_states"),
        speed_m_per_s_(speed_m_per_s),
        course_rad_(2.0 * units::kPi * draws_.uniform(drawn_++)),
        truth_({kPlace, speed_m_per_s * Vector3(std::cos(course_rad_), std::sin(course_rad_), 0.0),
                nav::quaternion_from_rotation_vector({0.0, 0.0, course_rad_})},
               gravity_of(variation, seed), {true}),
        gravity_(gravity_of(variation, seed)),
        filter_(p, nav::Gravity()) {
    errors_ = initial_sigmas(p);
    for (Eigen::Index i = 0; i < errors_.size(); ++i) errors_[i] *= draws_.normal(drawn_++);
    nav::NavState start = truth_.state();
    start.position = nav::displaced(start.position, errors_.segment<3>(kPosition));
    start.v_n += errors_.segment<3>(kVelocity);
    start.q_nb = nav::quaternion_from_rotation_vector(-errors_.segment<3>(kAttitude)) * start.q_nb;
    filter_.start(start, 0);
  }

  void fly(double until_s, bool has_fixes) {
    while (static_cast<double>(k_) * kDt_s < until_s - 0.5 * kDt_s) {
      advance();
      if (has_fixes && k_ % 50 == 0) fix();
    }
  }

  /// Squared normalised error of position, velocity and attitude: 9 degrees of freedom.
  double nees() const {
    InertialFilter now = *filter_.filter();
    now.settle();
    const nav::NavState state = now.state(), is = truth_.state();
    Eigen::Matrix<double, 9, 1> error;
    error << nav::ned_from(is.position, state.position), state.v_n - is.v_n,
        -nav::rotation_vector_from_quaternion(state.q_nb * is.q_nb.conjugate());
    const Eigen::Matrix<double, 9, 9> P = now.covariance().matrix().topLeftCorner<9, 9>();
    return error.dot(P.llt().solve(error));
  }

 private:
  static nav::Gravity gravity_of(const scenario::GravityVariation& variation, std::uint64_t seed) {
    const auto field = std::make_shared<nav::GravityField>(scenario::gravity_field(variation, kPlace, seed));
    return nav::Gravity(nav::GravityModel::Somigliana, {}, field);
  }

  Vector3 normals(const Vector3& sigma) {
    const double x = draws_.normal(drawn_), y = draws_.normal(drawn_ + 1), z = draws_.normal(drawn_ + 2);
    drawn_ += 3;
    return sigma.cwiseProduct(Vector3(x, y, z));
  }
  Vector3 of(StateBlock block) const { return errors_.segment<3>(layout_.first(block)); }

  void advance() {
    const double t_s = kDt_s * static_cast<double>(k_);
    const nav::NavState now = truth_.state();
    const Matrix3 C_bn = nav::matrix_from_quaternion(now.q_nb).transpose();
    const Vector3 omega_ie = nav::omega_ie_n(kPlace.latitude_rad);
    const Vector3 omega_en = nav::omega_en_n(now.position, now.v_n);
    // Sways across the track and along it; the force holds the height.
    const double rate = 0.02 * std::cos(0.2 * t_s);
    const Vector3 omega_b = C_bn * (omega_ie + omega_en) + Vector3(0.0, 0.0, rate);
    const Vector3 push_b(0.5 * std::cos(0.25 * t_s), speed_m_per_s_ * rate, 0.0);
    const Vector3 f_b = push_b + C_bn * ((2.0 * omega_ie + omega_en).cross(now.v_n) - gravity_.g_n(now.position));
    ImuSample sample;
    sample.dtheta_b = kDt_s * omega_b;
    sample.dv_b = kDt_s * f_b;
    truth_.advance({sample.dtheta_b, sample.dv_b, kDt_s});
    // The filter's estimates begin with 0, so what its state errs by is the negative of the sensors' errors.
    sample.dtheta_b -= sample.dtheta_b.cwiseProduct(of(StateBlock::GyroScale)) + kDt_s * of(StateBlock::GyroBias);
    sample.dv_b -= sample.dv_b.cwiseProduct(of(StateBlock::AccelScale)) + kDt_s * of(StateBlock::AccelBias);
    sample.dtheta_b += normals(std::sqrt(kDt_s) * units::kDegPerSqrtH * p_.gyro.arw_deg_per_sqrt_h);
    sample.dv_b += normals(std::sqrt(kDt_s) * units::kMPerSPerSqrtH * p_.accel.vrw_m_per_s_per_sqrt_h);
    sample.interval_ns = kDt_ns;
    sample.header.sim_time_ns = ++k_ * kDt_ns;
    filter_.add(sample);
  }

  void fix() {
    GnssFix fix;
    fix.header.sim_time_ns = k_ * kDt_ns;
    fix.fix_type = FixType::Fixed;
    fix.position_sigma_ned_m.setConstant(0.02);
    fix.velocity_sigma_ned_m_per_s.setConstant(0.01);
    const nav::NavState now = truth_.state();
    const nav::Geodetic measured = nav::displaced(now.position, normals(fix.position_sigma_ned_m));
    fix.latitude_rad = measured.latitude_rad;
    fix.longitude_rad = measured.longitude_rad;
    fix.height_m = measured.height_m;
    fix.v_n = now.v_n + normals(fix.velocity_sigma_ned_m_per_s);
    filter_.add(fix);
  }

  NavigationParameters p_;
  StateLayout layout_;
  random::Stream draws_;
  std::uint64_t drawn_ = 0;
  double speed_m_per_s_;
  double course_rad_;
  StateVector errors_;
  nav::Strapdown truth_;
  nav::Gravity gravity_;
  NavigationFilter filter_;
  std::int64_t k_ = 0;
};

struct Terrain {
  const char* name;
  scenario::GravityTerrain terrain;
  double speed_m_per_s;
};

class FilterOverTerrain : public testing::TestWithParam<Terrain> {};

// 60 runs of 240 s with fixes and 60 s without. The mean of chi-square of 9 degrees of freedom has a standard deviation
// of sqrt(18/60) = 0.55; 99.9 % of honest filters are within 3.29 of them, 1.8. The process is not the field's to the
// letter: along a track its spectrum is within a factor of 1.6 (docs/navigation.md), and the mean of all within that.
TEST_P(FilterOverTerrain, IsHonestWithTheStatesAndNotWithoutThem) {
  constexpr int kRuns = 60;
  scenario::GravityOptions options;
  options.variation = scenario::GravityVariation{GetParam().terrain};
  NavigationParameters without = navigation_grade(), with = without;
  match(*scenario::gravity_along_way(options, nullptr), with);
  std::array<double, 4> means{};
  for (int run = 1; run <= kRuns; ++run) {
    std::size_t i = 0;
    for (const NavigationParameters* p : {&with, &without}) {
      Flight flight(*p, *options.variation, GetParam().speed_m_per_s, static_cast<std::uint64_t>(run));
      flight.fly(240.0, true);
      means[i++] += flight.nees() / kRuns;
      flight.fly(300.0, false);
      means[i++] += flight.nees() / kRuns;
    }
  }
  std::printf(
      "mean NEES of 9 over %s at %g m/s: with fixes %.2f, after 60 s without %.2f; without the states %.1f, %.1f\n",
      GetParam().name, GetParam().speed_m_per_s, means[0], means[1], means[2], means[3]);
  EXPECT_NEAR(means[0], 9.0, 1.8);
  EXPECT_NEAR(means[1], 9.0, 1.8);
  EXPECT_GT(means[2], 2.0 * 9.0);
  EXPECT_GT(means[3], 2.0 * 9.0);
}

INSTANTIATE_TEST_SUITE_P(Terrains, FilterOverTerrain,
                         testing::Values(Terrain{"hills", scenario::GravityTerrain::Hills, 200.0},
                                         Terrain{"mountains", scenario::GravityTerrain::Mountains, 200.0},
                                         Terrain{"mountains", scenario::GravityTerrain::Mountains, 25.0}),
                         [](const auto& tested) {
                           return std::string(tested.param.name) +
                                  (tested.param.speed_m_per_s > 100.0 ? "Air" : "Road");
                         });

TEST(GravityStates, MatchTheScenariosGravityWhereItIsAskedFor) {
  scenario::LoadedScenario scenario;
  scenario.imus.resize(1);
  scenario.gnss.resize(1);
  scenario.scenario.trajectory.gravity.variation = scenario::GravityVariation{};
  scenario::ReferenceNav app;
  EXPECT_FALSE(setup_for(scenario, app).parameters.states.gravity_disturbance);
  app.gravity_disturbance = true;
  const NavigationParameters p = setup_for(scenario, app).parameters;
  EXPECT_TRUE(p.states.gravity_disturbance);
  // 6 arcsec are 28.53 mGal, the anomaly has sqrt(2) of it; 20 km over sqrt(2).
  EXPECT_NEAR(p.gravity_disturbance.sigma_ned_mgal.x(), 28.526, 0.001);
  EXPECT_NEAR(p.gravity_disturbance.sigma_ned_mgal.z(), 40.342, 0.001);
  EXPECT_NEAR(p.gravity_disturbance.correlation_m, 14142.1, 0.1);
  scenario.scenario.trajectory.gravity.variation.reset();
  EXPECT_FALSE(setup_for(scenario, app).parameters.states.gravity_disturbance) << "there is nothing to estimate";
}

}  // namespace gravity_states_test
}  // namespace inslab::navigation
