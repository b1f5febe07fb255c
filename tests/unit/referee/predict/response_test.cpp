#include "inslab/referee/predict/response.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/wgs84.hpp"
#include "inslab/referee/verify/propagation_runs.hpp"

namespace inslab::predict {
namespace response_test {

using testing::HasSubstr;

std::vector<Response> at_rest(const std::vector<std::string>& texts, const ResponseOptions& options) {
  std::vector<ErrorSource> sources;
  for (const std::string& text : texts) sources.push_back(error_source(text));
  Responses responses(sources, nav::Gravity(), options.vertical());
  steps_at_rest(options, [&](const LinearStep& step) { responses.add(step); });
  return responses.list();
}

/// y' = A y + b from y0 by Runge-Kutta of fourth order with steps of a second: independent of any closed form.
Vector3 integrated(const nav::Matrix3& A, const Vector3& b, Vector3 y, int duration_s) {
  const auto slope = [&](const Vector3& at) { return Vector3(A * at + b); };
  for (int second = 0; second < duration_s; ++second) {
    const Vector3 k1 = slope(y), k2 = slope(y + 0.5 * k1), k3 = slope(y + 0.5 * k2), k4 = slope(y + k3);
    y += (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
  }
  return y;
}

class ClosedFormsAtALatitude : public testing::TestWithParam<double> {
 protected:
  const nav::Geodetic place_{GetParam() * units::kDeg, 0.0, 500.0};
  const nav::Gravity gravity_;
  const double g_ = gravity_.g_n(place_).z();
  const double meridian_m_ = nav::wgs84::meridian_radius_m(place_.latitude_rad);
  const double transverse_m_ = nav::wgs84::transverse_radius_m(place_.latitude_rad);
  const ClosedFormsAtRest closed_{place_, gravity_};
  static constexpr int kDuration_s = 5000;

  ClosedForms of(const std::string& source, double t_s) const {
    return closed_.at(constant_errors(error_source(source), nav::Matrix3::Identity()), t_s);
  }
  void expect_close(double found, double expected) const {
    EXPECT_NEAR(found, expected, 1e-6 * std::abs(expected) + 1e-9);
  }
};

// The lecture's (62): delta r' = delta v, delta v' = g phi_E + delta f, phi_E' = -delta v / R - delta omega_E.
TEST_P(ClosedFormsAtALatitude, ForNorthSolveTheNorthChannel) {
  nav::Matrix3 A;
  A << 0.0, 1.0, 0.0, 0.0, 0.0, g_, 0.0, -1.0 / (meridian_m_ + 500.0), 0.0;
  const auto north = [&](const Vector3& drive, const Vector3& start) {
    return integrated(A, drive, start, kDuration_s).x();
  };
  const Vector3 zero = Vector3::Zero();
  expect_close(of("position_n=3m", kDuration_s).north_m, north(zero, {3.0, 0.0, 0.0}));
  expect_close(of("velocity_n=0.1m/s", kDuration_s).north_m, north(zero, {0.0, 0.1, 0.0}));
  expect_close(of("phi_e=5arcsec", kDuration_s).north_m, north(zero, {0.0, 0.0, 5.0 * units::kArcsec}));
  expect_close(of("accel_bias_n=10mGal", kDuration_s).north_m, north({0.0, 1e-4, 0.0}, zero));
  expect_close(of("gyro_bias_e=0.01deg/h", kDuration_s).north_m, north({0.0, 0.0, -0.01 * units::kDegPerH}, zero));
}

// (63): delta v' = -g phi_N + delta f, phi_N' = delta v / R - delta omega_N.
TEST_P(ClosedFormsAtALatitude, ForEastSolveTheEastChannel) {
  nav::Matrix3 A;
  A << 0.0, 1.0, 0.0, 0.0, 0.0, -g_, 0.0, 1.0 / (transverse_m_ + 500.0), 0.0;
  const auto east = [&](const Vector3& drive, const Vector3& start) {
    return integrated(A, drive, start, kDuration_s).x();
  };
  const Vector3 zero = Vector3::Zero();
  expect_close(of("velocity_e=0.1m/s", kDuration_s).east_m, east(zero, {0.0, 0.1, 0.0}));
  expect_close(of("phi_n=5arcsec", kDuration_s).east_m, east(zero, {0.0, 0.0, 5.0 * units::kArcsec}));
  expect_close(of("accel_bias_e=10mGal", kDuration_s).east_m, east({0.0, 1e-4, 0.0}, zero));
  expect_close(of("gyro_bias_n=0.01deg/h", kDuration_s).east_m, east({0.0, 0.0, -0.01 * units::kDegPerH}, zero));
}

// (70): delta h' = -delta v_D, delta v_D' = -2 g delta h / R - 2 omega_N delta v_E + delta f_D.
TEST_P(ClosedFormsAtALatitude, ForTheHeightSolveItsChannel) {
  nav::Matrix3 A = nav::Matrix3::Zero();
  A(0, 1) = -1.0;
  A(1, 0) = -2.0 * g_ / (std::sqrt(meridian_m_ * transverse_m_) + 500.0);
  const double omega_N = nav::wgs84::omega_e_rad_per_s * std::cos(place_.latitude_rad);
  const auto height = [&](double upwards, const Vector3& start, int t_s) {
    return integrated(A, {0.0, -upwards, 0.0}, start, t_s).x();
  };
  struct Case {
    const char* source;
    double upwards_m_per_s2;
    Vector3 start;
  };
  for (const Case& one : {Case{"position_d=-2m", 0.0, {2.0, 0.0, 0.0}}, Case{"velocity_d=0.1m/s", 0.0, {0.0, 0.1, 0.0}},
                          Case{"velocity_e=0.1m/s", 2.0 * omega_N * 0.1, Vector3::Zero()},
                          Case{"accel_bias_d=10mGal", -1e-4, Vector3::Zero()}}) {
    expect_close(of(one.source, 1800.0).height_m, height(one.upwards_m_per_s2, one.start, 1800));
    // (73) leaves out (k t)^2 / 2 of a height, a sixth and a twelfth of (k t)^2 of the others: 60 s are 0.6 %.
    const double expected = height(one.upwards_m_per_s2, one.start, 60);
    EXPECT_NEAR(of(one.source, 60.0).height_short_m, expected, 0.006 * std::abs(expected)) << one.source;
  }
}

INSTANTIATE_TEST_SUITE_P(Latitudes, ClosedFormsAtALatitude, testing::Values(-45.0, 0.0, 30.0, 75.0));

// The whole chain of truth model, IMU model and mechanization, with the sign.
TEST(Response, IsTheErrorThatARunMakes) {
  verify::RestingRun run;
  run.duration_s = 1800;
  run.errors.gyro.bias_constant_deg_per_h.y() = -0.5;
  const verify::ErrorState found = verify::navigate_at_rest(run, 1800).back();
  ResponseOptions options;
  options.latitude_deg = 30.0;
  options.hours = 0.5;
  options.hold_vertical = true;
  for (const char* source : {"gyro_bias_e=-0.5deg/h", "gyro_bias_y=-0.5deg/h"}) {
    const ErrorState end = at_rest({source}, options).front().errors.back();
    for (const int group : {0, 3, 6}) {
      EXPECT_LT((end - found).segment<3>(group).norm(), 1e-3 * found.segment<3>(group).norm()) << source;
    }
    EXPECT_GT(end[0], 1000.0);
  }
}

TEST(Response, NearsTheClosedFormWhileTheEarthHasHardlyTurned) {
  ResponseOptions options;
  options.latitude_deg = 60.0;
  options.hours = 0.25;
  for (const Response& response :
       at_rest({"velocity_n=0.1m/s", "phi_e=5arcsec", "accel_bias_n=10mGal", "gyro_bias_e=0.01deg/h"}, options)) {
    EXPECT_NEAR(response.errors.back()[0], response.closed.back().north_m,
                0.02 * std::abs(response.closed.back().north_m))
        << response.source.text;
  }
  const Response height = at_rest({"accel_bias_d=10mGal"}, options).front();
  EXPECT_NEAR(-height.errors.back()[2], height.closed.back().height_m, 0.01 * std::abs(height.closed.back().height_m));
  EXPECT_LT(height.closed.back().height_m, 0.0);
}

TEST(Response, RefusesAPole) {
  ResponseOptions options;
  options.latitude_deg = -90.0;
  EXPECT_THROW(at_rest({"phi_e=5arcsec"}, options), std::invalid_argument);
}

TEST(ErrorSource, RefusesWhatItCannotTakeSayingWhatThereIs) {
  const auto refusal = [](const std::string& text) {
    try {
      error_source(text);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  EXPECT_THAT(refusal("gyro_bias_e"), HasSubstr("expected NAME_AXIS=VALUE UNIT"));
  EXPECT_THAT(refusal("gyro_e=1deg/h"), HasSubstr("is of none of position, velocity, phi, accel_bias, gyro_bias"));
  EXPECT_THAT(refusal("phi_x=1deg"), HasSubstr("has an axis that is none of ned"));
  EXPECT_THAT(refusal("gyro_bias_e=0.01"), HasSubstr("has the unit ''; expected one of deg/h, deg/s, rad/s"));
  EXPECT_THAT(refusal("gyro_bias_e=deg/h"), HasSubstr("has no number"));
  EXPECT_NEAR(error_source("accel_bias_z=-1 mg").value, -9.80665e-3, 1e-12);
  EXPECT_TRUE(error_source("accel_bias_z=-1 mg").in_body);
}

}  // namespace response_test
}  // namespace inslab::predict
