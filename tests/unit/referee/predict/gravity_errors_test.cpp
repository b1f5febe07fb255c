#include <gtest/gtest.h>

#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/referee/predict/error_growth.hpp"
#include "inslab/referee/predict/expected_errors.hpp"
#include "inslab/scenario/terrain_gravity.hpp"

namespace inslab::predict {
namespace gravity_errors_test {

constexpr double kD_m = 20e3;
constexpr double kEarth_m = 6371e3;
constexpr double kHills_rad = 6.0 * units::kArcsec;

using Correlation = double (*)(double);
double along(double u) { return (1.0 + u - u * u) * std::exp(-u); }
double across(double u) { return (1.0 + u) * std::exp(-u); }

/// RMS of the way that a departure of gravity of the correlation makes of a level inertial navigation on a round Earth
/// that does not turn, begun on the plumb line: the double integral of sin(w (T - t))/w over what the departure has
/// changed by since the start.
double way_m(double speed_m_per_s, double span_s, Correlation correlation) {
  constexpr int kParts = 400;
  const double w = std::sqrt(units::kG / kEarth_m), dt_s = span_s / kParts;
  const auto weight = [&](int i) { return std::sin(w * (span_s - (i + 0.5) * dt_s)) / w * dt_s; };
  const auto r = [&](double t_s) { return correlation(speed_m_per_s * t_s / kD_m); };
  double sum = 0.0;
  for (int i = 0; i < kParts; ++i) {
    for (int j = 0; j < kParts; ++j) {
      const double ti = (i + 0.5) * dt_s, tj = (j + 0.5) * dt_s;
      sum += weight(i) * weight(j) * (1.0 + r(std::abs(ti - tj)) - r(ti) - r(tj));
    }
  }
  return units::kG * kHills_rad * std::sqrt(sum);
}

ImuTruth level(double speed_m_per_s, double t_s, double dt_s) {
  ImuTruth truth;
  truth.header.sim_time_ns = std::llround(1e9 * t_s);
  truth.interval_ns = std::llround(1e9 * dt_s);
  truth.latitude_rad = 30.0 * units::kDeg;
  truth.v_n = nav::Vector3(speed_m_per_s, 0.0, 0.0);
  truth.dv_b = nav::Vector3(0.0, 0.0, -units::kG * dt_s);
  return truth;
}

GravityErrors hills(bool on_plumb_line) {
  scenario::GravityOptions options;
  options.variation = scenario::GravityVariation{};
  return {*scenario::gravity_along_way(options, nullptr), on_plumb_line};
}

PredictedError at_end(double speed_m_per_s, double span_s, bool on_plumb_line) {
  constexpr double kStep_s = 0.2;
  ErrorGrowth growth({}, {}, nav::Gravity(), Vertical::Held, kStep_s, hills(on_plumb_line));
  const int steps = static_cast<int>(std::lround(span_s / kStep_s));
  for (int k = 1; k <= steps; ++k) growth.advance(level(speed_m_per_s, k * kStep_s, kStep_s), 0.0, 0.0);
  return growth.current();
}

struct Way {
  double speed_m_per_s;
  double span_s;
  double about_m;  ///< one axis
};

class ErrorGrowthOfGravity : public testing::TestWithParam<Way> {};

// The process is told no direction: of both axes together its way is the third-order model's, within 3 %.
TEST_P(ErrorGrowthOfGravity, FromThePlumbLineIsThatOfTheThirdOrderModel) {
  const Way& way = GetParam();
  const PredictedError end = at_end(way.speed_m_per_s, way.span_s, true);
  const double expected =
      std::hypot(way_m(way.speed_m_per_s, way.span_s, along), way_m(way.speed_m_per_s, way.span_s, across));
  const double found = end.position_n_m.head<2>().norm();
  EXPECT_NEAR(found / expected, 1.0, 0.03);
  EXPECT_NEAR(found / std::sqrt(2.0) / way.about_m, 1.0, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Vehicles, ErrorGrowthOfGravity,
                         testing::Values(Way{15.0, 60.0, 0.0107}, Way{200.0, 60.0, 0.124}, Way{200.0, 1200.0, 164.0}));

// Begun with the true attitude it falls aside at once: sigma t^2/2, 0.51 m in 60 s.
TEST(ErrorGrowth, OfGravityFromTheTrueAttitudeIsAConstantForce) {
  const double expected = 0.5 * 3600.0 * units::kG * kHills_rad;
  EXPECT_NEAR(at_end(0.0, 60.0, false).position_n_m.x(), expected, 1e-3 * expected);
  // Levelled nothing pulls but what the Earth turns of the tilt: sigma omega sin(30 deg) t^3/6 = 3.7e-4 m.
  EXPECT_LT(at_end(0.0, 60.0, true).position_n_m.x(), 2e-3 * expected);
}

TEST(ExpectedErrors, NameGravityAsLeftOutUnlessTheyAreToldOfIt) {
  ExpectedErrors::Setup setup;
  setup.gravity = nav::Gravity(nav::GravityModel::Somigliana, {10.0, 0.0, 0.0});
  EXPECT_EQ(ExpectedErrors(setup, {}).left_out(), std::vector<std::string>{"gravity disturbance"});
  setup.gravity_errors = hills(false);
  EXPECT_TRUE(ExpectedErrors(setup, {}).left_out().empty());
}

}  // namespace gravity_errors_test
}  // namespace inslab::predict
