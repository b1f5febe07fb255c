#pragma once

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/navigation/processes.hpp"
#include "inslab/noise/random/stream.hpp"
#include "tests/unit/models/navigation/circling.hpp"

/// A run in which everything that a filter is told of is drawn, so that an honest one has a chi-square.
namespace inslab::navigation::circling {

/// The estimate of a situation whose errors are `x` of `layout`: truth plus errors.
inline Situation erring(Situation at, const StateVector& x, const StateLayout& layout) {
  at.position = nav::displaced(at.position, x.segment<3>(kPosition));
  at.v_n += x.segment<3>(kVelocity);
  at.C_nb = nav::matrix_from_quaternion(nav::quaternion_from_rotation_vector(-x.segment<3>(kAttitude))) * at.C_nb;
  layout.for_each_chosen([&](StateBlock block) {
    at.estimates[block].head(size_of(block)) += x.segment(layout.first(block), size_of(block));
  });
  return at;
}

/// The filter begins at the truth plus errors drawn from its own initial sigmas. Estimates begin with 0, so the true
/// errors of the sensors are the negative of the filter's: of().
class DrawnRun {
 public:
  DrawnRun(NavigationParameters parameters, std::uint64_t seed, const char* stream, const Circling& truth = Circling())
      : p_(constant(std::move(parameters))),
        layout_(p_.states),
        draws_(seed, stream),
        e_(initial_sigmas(p_)),
        truth_(truth),
        filter_(p_, kGravity) {
    for (Eigen::Index i = 0; i < e_.size(); ++i) e_[i] *= normal();
    nav::NavState start = truth_.state();
    start.position = nav::displaced(start.position, Vector3(e_.segment<3>(kPosition)));
    start.v_n += e_.segment<3>(kVelocity);
    start.q_nb = nav::quaternion_from_rotation_vector(-e_.segment<3>(kAttitude)) * start.q_nb;
    filter_.start(start, 0);
  }

  double normal() { return draws_.normal(drawn_++); }
  Vector3 normals() {
    const double x = normal(), y = normal(), z = normal();
    return Vector3(x, y, z);
  }
  /// What the filter's estimate of a block errs by at the beginning.
  Vector3 of(StateBlock block) const {
    Vector3 errors = Vector3::Zero();
    errors.head(size_of(block)) = e_.segment(layout_.first(block), size_of(block));
    return errors;
  }

  const Circling& truth() const { return truth_; }
  NavigationFilter& filter() { return filter_; }
  const NavigationParameters& parameters() const { return p_; }
  Eigen::Index states() const { return layout_.size(); }

  /// The next interval, with the push of Circling::next().
  void advance(const Vector3& push_b) { add(truth_.next(push_b)); }
  void advance() { add(truth_.next()); }

  /// A fix, when it is its time.
  void fix_if_due() {
    if (!is_fix_time(truth_)) return;
    GnssFix fix = truth_.fix();
    const nav::Geodetic measured = nav::displaced(geodetic_of(fix), fix.position_sigma_ned_m.cwiseProduct(normals()));
    fix.latitude_rad = measured.latitude_rad;
    fix.longitude_rad = measured.longitude_rad;
    fix.height_m = measured.height_m;
    fix.v_n += fix.velocity_sigma_ned_m_per_s.cwiseProduct(normals());
    filter_.add(fix);
  }

  /// The squared normalised error of the whole state.
  double nees() const {
    InertialFilter now = *filter_.filter();
    now.settle();
    const nav::NavState state = now.state(), is = truth_.state();
    const Matrix3 M = nav::matrix_from_quaternion(state.q_nb) * nav::matrix_from_quaternion(is.q_nb).transpose();
    StateVector error(layout_.size());
    error.segment<3>(kPosition) = nav::ned_from(is.position, state.position);
    error.segment<3>(kVelocity) = state.v_n - is.v_n;
    error.segment<3>(kAttitude) = 0.5 * Vector3(M(1, 2) - M(2, 1), M(2, 0) - M(0, 2), M(0, 1) - M(1, 0));
    layout_.for_each_chosen([&](StateBlock block) {
      error.segment(layout_.first(block), size_of(block)) = (now.estimates()[block] + of(block)).head(size_of(block));
    });
    const Eigen::MatrixXd P = now.covariance().matrix();
    return error.dot(Eigen::VectorXd(P.llt().solve(Eigen::VectorXd(error))));
  }

 private:
  /// Errors that stay as they are drawn, and no rest: the vehicle's way is its own.
  static NavigationParameters constant(NavigationParameters p) {
    p.zero_velocity.use = false;
    p.gyro.bias_sigma_deg_per_h.setConstant(20.0);
    for (auto* constants : {&p.gyro.bias_correlation_time_s, &p.gyro.scale_factor_correlation_time_s,
                            &p.accel.bias_correlation_time_s, &p.accel.scale_factor_correlation_time_s}) {
      constants->setZero();
    }
    return p;
  }

  void add(ImuSample sample) {
    const Vector3 gyro_noise = std::sqrt(kDt_s) * units::kDegPerSqrtH * p_.gyro.arw_deg_per_sqrt_h;
    const Vector3 accel_noise = std::sqrt(kDt_s) * units::kMPerSPerSqrtH * p_.accel.vrw_m_per_s_per_sqrt_h;
    sample.dtheta_b += -sample.dtheta_b.cwiseProduct(of(StateBlock::GyroScale)) - kDt_s * of(StateBlock::GyroBias) +
                       gyro_noise.cwiseProduct(normals());
    sample.dv_b += -sample.dv_b.cwiseProduct(of(StateBlock::AccelScale)) - kDt_s * of(StateBlock::AccelBias) +
                   accel_noise.cwiseProduct(normals());
    filter_.add(sample);
  }

  NavigationParameters p_;
  StateLayout layout_;
  random::Stream draws_;
  std::uint64_t drawn_ = 0;
  StateVector e_;
  Circling truth_;
  NavigationFilter filter_;
};

/// Over 100 runs the mean of chi-square of n degrees of freedom has a standard deviation of sqrt(2 n/100); 99.9 % of
/// honest filters are within 3.29 of them. `nees_of_run` takes the run's seed.
inline void expect_honest_over_100_runs(int states, double (*nees_of_run)(std::uint64_t)) {
  constexpr int kRuns = 100;
  double sum = 0.0;
  for (int run = 0; run < kRuns; ++run) sum += nees_of_run(static_cast<std::uint64_t>(run) + 1);
  std::printf("mean NEES of %d states over %d runs: %.3f\n", states, kRuns, sum / kRuns);
  EXPECT_NEAR(sum / kRuns, states, 3.29 * std::sqrt(2.0 * states / kRuns));
}

}  // namespace inslab::navigation::circling
