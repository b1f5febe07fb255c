#pragma once

#include <algorithm>
#include <optional>

#include "inslab/data/samples/wheel_travel.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/navigation/measurement.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::navigation {

/// What the filter knows of the mean velocity of a wheel's contact over the interval of a sample, along the wheel's own
/// axes o, and how its errors show in it:
///
///   v_o = (I - [epsilon x]) C_ob (mean of C_bn v_n + mean of omega_eb_b x l_b),   epsilon = (0, pitch, yaw),
///
/// which is P. Groves, Principles of GNSS, Inertial, and Multisensor Integrated Navigation Systems, 2nd ed. (2013),
/// (6.32), with a misalignment. Nothing without the motion of the interval.
class WheelMotion {
 public:
  static std::optional<WheelMotion> of(const OdometerBelief& wheel, const WheelTravel& sample, const Situation& at) {
    if (at.recent == nullptr) return std::nullopt;
    const auto means = at.recent->over(sample.interval_ns);
    if (!means) return std::nullopt;
    return WheelMotion(wheel, time::to_seconds(sample.interval_ns), *means, at);
  }

  const nav::Vector3& v_o() const { return v_o_; }

  /// What slip adds to the variance of a velocity of the contact, (m/s)^2: of its speed so much as the force over the
  /// interval lets it slip. A slip lasts as the force does, so samples of the same one count once.
  double slip_variance() const { return slip_variance_; }

  /// Rows of the derivatives of v_o by all blocks, taken `rows` times: a matrix with three columns.
  template <class Rows>
  void add_to(Measurement& m, const Rows& rows) const {
    m.by(StateBlock::Velocity, rows * by_velocity_);
    m.by(StateBlock::Attitude, rows * by_attitude_);
    m.by(StateBlock::GyroBias, rows * by_gyro_bias_);
    m.by(StateBlock::GyroScale, rows * by_gyro_scale_);
    m.by(StateBlock::WheelAxis, rows * by_axis_);
  }

 private:
  WheelMotion(const OdometerBelief& wheel, double dt_s, const RecentMotion::Means& means, const Situation& at) {
    const nav::Matrix3 C_bn = at.C_nb.transpose();
    const nav::Vector3 rpy_rad = units::kDeg * wheel.mounting_rpy_deg;
    const nav::Matrix3 C_ob = nav::matrix_from_rpy({rpy_rad.x(), rpy_rad.y(), rpy_rad.z()}).transpose();
    const Vector3& axis = at.estimates[StateBlock::WheelAxis];
    const nav::Matrix3 turned_back = nav::Matrix3::Identity() - nav::skew({0.0, axis[0], axis[1]});
    const nav::Matrix3 C = turned_back * C_ob;
    const nav::Vector3 v_b = C_bn * at.v_n + means.v_b_less_now;
    const nav::Vector3 u_o = C_ob * (v_b + means.omega_eb_b.cross(wheel.lever_arm_b_m));
    v_o_ = turned_back * u_o;
    const nav::Vector3 fall_b = C_bn * nav::Vector3(0.0, 0.0, units::kG);
    const nav::Vector3 force_o = C * (means.v_b_rate + means.omega_eb_b.cross(v_b) - fall_b);
    const double slip_m_per_s = wheel.slip_sigma(force_o.x(), force_o.y()) * v_o_.x();
    slip_variance_ = std::max(1.0, wheel.slip_lasts_s / dt_s) * slip_m_per_s * slip_m_per_s;
    // Errors are as old as the middle of the interval: before half of its turn, and before half of what a wrong tilt
    // makes of its forces.
    const nav::Matrix3 C_bn_middle = (nav::Matrix3::Identity() + nav::skew(0.5 * dt_s * means.omega_eb_b)) * C_bn;
    const nav::Vector3 f_n = at.C_nb * at.f_ib_b;
    by_velocity_ = C * C_bn_middle;
    by_attitude_ = -C * nav::skew(v_b) * C_bn_middle - 0.5 * dt_s * by_velocity_ * nav::skew(f_n);
    by_gyro_bias_ = C * nav::skew(wheel.lever_arm_b_m) * at.rate_by_measured.asDiagonal();
    by_gyro_scale_ = by_gyro_bias_ * at.omega_ib_b.asDiagonal();
    by_axis_ << -u_o.z(), u_o.y(), 0.0, -u_o.x(), u_o.x(), 0.0;
  }

  nav::Vector3 v_o_;
  double slip_variance_;
  nav::Matrix3 by_velocity_, by_attitude_, by_gyro_bias_, by_gyro_scale_;
  Eigen::Matrix<double, 3, 2> by_axis_;
};

}  // namespace inslab::navigation
