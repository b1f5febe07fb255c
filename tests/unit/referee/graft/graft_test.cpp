#include <gtest/gtest.h>

#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/imu/imu_model.hpp"
#include "inslab/models/trajectory/row_motion.hpp"
#include "inslab/models/trajectory/smooth_model.hpp"
#include "inslab/nav/wgs84.hpp"
#include "inslab/noise/allan/allan_stream.hpp"
#include "inslab/referee/graft/geometry_fit.hpp"
#include "inslab/referee/graft/motion_terms.hpp"
#include "inslab/referee/graft/still_errors.hpp"

/// Errors that were put in come out of a recording again.
namespace inslab::graft {
namespace graft_test {

constexpr double kHz = 100.0;

/// A vehicle that turns, accelerates, climbs and rolls: rows every 50 ms.
TrajectoryFile rows(double seconds) {
  TrajectoryFile file;
  file.name = "reference";
  file.start = {2399, 1'000'000'000};
  for (int k = 0; k <= static_cast<int>(seconds * 20.0); ++k) {
    const double t = 0.05 * k;
    TrajectoryRow row;
    row.time = time::from_seconds(t);
    row.position = {0.5 + 2e-6 * std::sin(0.3 * t), 1.9 + 3e-6 * std::sin(0.21 * t), 100.0 + 4.0 * std::sin(0.37 * t)};
    row.rpy = nav::RollPitchYaw{0.3 * std::sin(0.9 * t), 0.2 * std::sin(0.7 * t), 0.8 * std::sin(0.4 * t)};
    row.v_n = Vector3::Zero();
    file.rows.push_back(row);
  }
  return file;
}

struct Measured {
  std::vector<RecordedErrors::Increments> increments;
  std::vector<RecordedErrors::Increments> errors;
};

/// What an IMU on that vehicle measures, by the models of the simulator.
Measured measured(const TrajectoryFile& file, const ImuErrorProfile& errors, const InstallationProfile& installation) {
  const nav::Gravity gravity(nav::GravityModel::Normal);
  const time::Grid grid{time::Rate(kHz)};
  trajectory::SmoothModel vehicle(trajectory::motion_through(file, {}, gravity), "row", gravity, grid, file.start);
  imu::ImuModel model({3, 0, time::Rate(kHz), gravity, errors, {}, installation});
  Measured all;
  model.measure(vehicle.current());
  while (vehicle.current().header.sim_time_ns + 10'000'000 <= file.rows.back().time.count()) {
    const auto output = model.measure(vehicle.advance());
    const auto as_array = [](const Vector3& theta, const Vector3& v) {
      return RecordedErrors::Increments{theta.x(), theta.y(), theta.z(), v.x(), v.y(), v.z()};
    };
    all.increments.push_back(as_array(output->sample.dtheta_b, output->sample.dv_b));
    all.errors.push_back(
        as_array(output->sample.dtheta_b - output->truth.dtheta_b, output->sample.dv_b - output->truth.dv_b));
  }
  return all;
}

ImuErrorProfile noisy() {
  ImuErrorProfile profile;
  profile.gyro.arw_deg_per_sqrt_h.setConstant(0.05);
  profile.accel.vrw_m_per_s_per_sqrt_h.setConstant(0.02);
  profile.gyro.bias_constant_deg_per_h = {20.0, -10.0, 5.0};
  profile.accel.bias_constant_mgal = {300.0, -200.0, 100.0};
  return profile;
}

TEST(GeometryFit, FindsTimeOffsetMountingAndLeverArm) {
  const TrajectoryFile file = rows(60.0);
  InstallationProfile installation;
  installation.lever_arm_v_m = {0.8, -0.5, 0.3};
  installation.mounting_rpy_deg = {1.0, -2.0, 90.0};
  const Measured all = measured(file, noisy(), installation);

  // The recording's clock is 7 ms behind the reference's.
  constexpr std::int64_t kBehindNs = 7'000'000;
  const std::int64_t first_ns = file.start.time_of_week_ns + 10'000'000 - kBehindNs;
  const ReferenceImu reference(file, time::Rate(kHz), first_ns, all.increments.size());
  const auto begin = all.increments.begin() + static_cast<std::ptrdiff_t>(reference.first());
  Geometry start;
  start.mounting_rpy_rad.z() = 80.0 * units::kDeg;
  const GeometryFit fit =
      fit_geometry(reference, {begin, begin + static_cast<std::ptrdiff_t>(reference.count())}, start);

  const auto expect_within = [](double value, double truth, double sigma, double most, const char* what) {
    EXPECT_NEAR(value, truth, 4.0 * sigma) << what;
    EXPECT_LT(sigma, most) << what;
  };
  expect_within(fit.geometry.time_offset_s, 0.007, fit.sigma.time_offset_s, 1e-4, "time offset");
  const Vector3 rpy = installation.mounting_rpy_deg * units::kDeg;
  for (int i = 0; i < 3; ++i) {
    expect_within(fit.geometry.mounting_rpy_rad[i], rpy[i], fit.sigma.mounting_rpy_rad[i], 1e-4, "mounting");
    expect_within(fit.geometry.lever_arm_v_m[i], installation.lever_arm_v_m[i], fit.sigma.lever_arm_v_m[i], 0.01,
                  "arm");
  }
}

TEST(GeometryFit, LeavesWhatTheMotionDoesNotTellWhereItBegan) {
  TrajectoryFile file = rows(60.0);
  for (TrajectoryRow& row : file.rows)
    row.rpy = nav::RollPitchYaw{0.0, 0.0, 0.8 * std::sin(0.4 * time::to_seconds(row.time))};
  const Measured all = measured(file, noisy(), {});
  const ReferenceImu reference(file, time::Rate(kHz), file.start.time_of_week_ns + 10'000'000, all.increments.size());
  const auto begin = all.increments.begin() + static_cast<std::ptrdiff_t>(reference.first());
  Geometry start;
  start.lever_arm_v_m = {0.0, 0.0, 1.5};
  const GeometryFit fit =
      fit_geometry(reference, {begin, begin + static_cast<std::ptrdiff_t>(reference.count())}, start);
  EXPECT_NEAR(fit.geometry.lever_arm_v_m.z(), 1.5, 1.0);  // it only turns about z
  EXPECT_GT(fit.sigma.lever_arm_v_m.z(), 5.0);
  EXPECT_LT(fit.sigma.lever_arm_v_m.x(), 0.1);
}

TEST(ReferenceImu, SaysWhenItIsOfAnotherTimeOrHasNoAttitude) {
  const auto refusal = [](const TrajectoryFile& file, std::int64_t first_ns) -> std::string {
    try {
      ReferenceImu(file, time::Rate(kHz), first_ns, 6000);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(rows(60.0), 5'000'010'000'000),
            "reference: covers 0.000000 s of the recording, whose first interval begins 4999.000000 s after its first "
            "row; expected 10 s (--time-offset moves the recording)");
  TrajectoryFile bare = rows(60.0);
  for (TrajectoryRow& row : bare.rows) row.rpy.reset();
  EXPECT_EQ(refusal(bare, 1'010'000'000), "reference: has no attitude; a reference needs one in every row");
}

TEST(MotionTerms, AreThoseThatWerePutIn) {
  ImuErrorProfile profile = noisy();
  profile.gyro.scale_factor_ppm = {800.0, -500.0, 300.0};
  profile.gyro.cross_axis_arcsec << 100.0, -200.0, 300.0, 150.0, -250.0, 50.0;
  profile.gyro.g_sensitivity_deg_per_h_per_g << 20.0, -30.0, 10.0, 5.0, 40.0, -15.0, 25.0, -5.0, 30.0;
  profile.accel.scale_factor_ppm = {-600.0, 400.0, 900.0};
  profile.accel.cross_axis_arcsec << 60.0, -120.0, 90.0, 30.0, -45.0, 75.0;
  const Measured all = measured(rows(600.0), profile, {});
  std::vector<RecordedErrors::Increments> perfect = all.increments;
  for (std::size_t k = 0; k < perfect.size(); ++k) {
    for (std::size_t axis = 0; axis < RecordedErrors::kAxes; ++axis) perfect[k][axis] -= all.errors[k][axis];
  }
  const MotionTerms terms = fit_motion_terms(all.errors, perfect, 0.01);
  // 600 s of 0.05 deg/sqrt(h) on rates of 0.2 rad/s: 3e-6; of 0.02 m/s/sqrt(h) on forces of 1 m/s^2: 1.4e-5, and on the
  // force along z, which hardly changes, 2e-3 of a g's: bias and scale factor of that axis are told apart by little.
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(terms.gyro(axis, axis) / units::kPpm, profile.gyro.scale_factor_ppm[axis], 15.0) << axis;
    EXPECT_NEAR(terms.accel(axis, axis) / units::kPpm, profile.accel.scale_factor_ppm[axis], axis == 2 ? 400.0 : 60.0);
    for (int by = 0; by < 2; ++by) {
      EXPECT_NEAR(terms.g_sensitivity(axis, by) * units::kG / units::kDegPerH,
                  profile.gyro.g_sensitivity_deg_per_h_per_g[3 * axis + by], 6.0);
    }
  }
  EXPECT_NEAR(terms.gyro(1, 0) / units::kArcsec, 100.0, 3.0);
  EXPECT_NEAR(terms.gyro(2, 0) / units::kArcsec, -200.0, 3.0);
  EXPECT_NEAR(terms.gyro(0, 1) / units::kArcsec, 300.0, 3.0);
  EXPECT_NEAR(terms.accel(1, 0) / units::kArcsec, 60.0, 12.0);
  EXPECT_NEAR(terms.accel(0, 1) / units::kArcsec, 90.0, 12.0);
}

TEST(MotionTerms, ThatTheMotionDoesNotExciteStayAtZero) {
  // At rest: a bias, and nothing that follows the noise.
  std::vector<RecordedErrors::Increments> perfect(6000, {0.0, 0.0, 0.0, 0.0, 0.0, -9.8e-2}), errors(6000);
  for (std::size_t k = 0; k < errors.size(); ++k) {
    for (std::size_t axis = 0; axis < RecordedErrors::kAxes; ++axis) {
      errors[k][axis] = 1e-5 + 1e-4 * random::Stream(5, "axis" + std::to_string(axis)).normal(k);
    }
  }
  const MotionTerms terms = fit_motion_terms(errors, perfect, 0.01);
  EXPECT_LT(terms.gyro.norm(), 1e-9);
  EXPECT_LT(terms.accel_square.head<2>().norm(), 1e-9);
  // A mean of 1e-3 m/s^2 is a bias (1 m/s^2) rather than a scale factor or an angle on 1 g (0.098 m/s^2): 1e-6 of each.
  EXPECT_LT(terms.accel.norm(), 3e-6);
}

/// An IMU at rest with errors of its own, tilted.
RecordedErrors still(const std::vector<RecordedErrors::Increments>& errors, const nav::Matrix3& C_nb,
                     double latitude_rad) {
  const Vector3 g_n = nav::Gravity(nav::GravityModel::Normal).g_n({latitude_rad, 0.0, 0.0});
  const Vector3 omega_n = nav::wgs84::omega_e_rad_per_s * Vector3(std::cos(latitude_rad), 0.0, -std::sin(latitude_rad));
  const Vector3 theta = C_nb.transpose() * omega_n / kHz, v = -(C_nb.transpose() * g_n) / kHz;
  RecordedErrors measured;
  measured.rate = time::Rate(kHz);
  for (auto increments : errors) {
    for (int axis = 0; axis < 3; ++axis) {
      increments[static_cast<std::size_t>(axis)] += theta[axis];
      increments[static_cast<std::size_t>(axis + 3)] += v[axis];
    }
    measured.intervals.push_back(increments);
  }
  return measured;
}

TEST(StillErrors, HaveTheAllanVarianceOfTheErrorsThatWerePutIn) {
  std::vector<RecordedErrors::Increments> errors(60000);
  for (std::size_t k = 0; k < errors.size(); ++k) {
    for (std::size_t axis = 0; axis < RecordedErrors::kAxes; ++axis) {
      errors[k][axis] = (axis < 3 ? 1e-7 : 1e-5) * random::Stream(9, "axis" + std::to_string(axis)).normal(k);
    }
  }
  const nav::Matrix3 C_nb = nav::matrix_from_rpy({0.02, -0.03, 1.1});
  const auto found = still_errors(still(errors, C_nb, 0.7), {{0.7, 0.0, 0.0}, {}, true});
  ASSERT_TRUE(std::holds_alternative<StillErrors>(found));
  const auto& extracted = std::get<StillErrors>(found).errors.intervals;
  for (std::size_t axis = 0; axis < RecordedErrors::kAxes; ++axis) {
    allan::AllanStream in(0.01, {1, 10, 100, 1000}), out(0.01, {1, 10, 100, 1000});
    for (std::size_t k = 0; k < errors.size(); ++k) {
      in.add(errors[k][axis]);
      out.add(extracted[k][axis]);
    }
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(out.points()[i].variance / in.points()[i].variance, 1.0, 1e-9) << axis;
    }
  }
}

TEST(StillErrors, KeepOfTheMeansWhatIsAlongTheEarthsRateAndGravity) {
  // 1 deg/h along the Earth's rate and 100 mGal along gravity; east and level biases become attitude.
  const nav::Matrix3 C_nb = nav::matrix_from_rpy({0.02, -0.03, 1.1});
  const double latitude_rad = 0.7;
  const Vector3 along = C_nb.transpose() * Vector3(std::cos(latitude_rad), 0.0, -std::sin(latitude_rad));
  const Vector3 up = C_nb.transpose() * Vector3(0.0, 0.0, -1.0);
  const Vector3 gyro = along * (1.0 * units::kDegPerH / kHz), accel = up * (100.0 * units::kMGal / kHz);
  const RecordedErrors::Increments error{gyro.x(), gyro.y(), gyro.z(), accel.x(), accel.y(), accel.z()};
  const auto found = still_errors(still(std::vector<RecordedErrors::Increments>(100, error), C_nb, latitude_rad),
                                  {{latitude_rad, 0.0, 0.0}, {}, true});
  ASSERT_TRUE(std::holds_alternative<StillErrors>(found));
  const auto& out = std::get<StillErrors>(found).errors.intervals.front();
  for (std::size_t axis = 0; axis < RecordedErrors::kAxes; ++axis) {
    EXPECT_NEAR(out[axis], error[axis], axis < 3 ? 1e-12 : 1e-9) << axis;
  }
}

TEST(StillErrors, SayWhyThereIsNoAlignment) {
  std::vector<RecordedErrors::Increments> moving(100);
  for (std::size_t k = 0; k < moving.size(); ++k) moving[k][3] = k % 2 == 0 ? 0.1 : -0.1;
  const auto found = still_errors(still(moving, nav::Matrix3::Identity(), 0.7), {{0.7, 0.0, 0.0}, {}, true});
  ASSERT_TRUE(std::holds_alternative<std::string>(found));
}

}  // namespace graft_test
}  // namespace inslab::graft
