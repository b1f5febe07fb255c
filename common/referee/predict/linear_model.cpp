#include "inslab/referee/predict/linear_model.hpp"

#include <stdexcept>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::predict {
namespace {

/// Twelve powers: of a step of 100 s at rest, in which g dt / R dt is 0.015, to the last bit.
void integrate(LinearStep& step, Vertical vertical) {
  constexpr int kPowers = 12;
  if (vertical == Vertical::Held) {
    for (const int state : {2, 5}) {
      step.F.row(state).setZero();
      step.F.col(state).setZero();
    }
  }
  nav::Matrix9 term = nav::Matrix9::Identity();
  step.Phi = nav::Matrix9::Identity();
  step.Phi_u = step.dt_s * nav::Matrix9::Identity();
  for (int k = 1; k <= kPowers; ++k) {
    term = (step.dt_s / k) * step.F.lazyProduct(term).eval();
    step.Phi += term;
    step.Phi_u += step.dt_s / (k + 1) * term;
  }
}

}  // namespace

LinearStep resting_step(const nav::Geodetic& place, const nav::Gravity& gravity, Vertical vertical, double dt_s) {
  LinearStep step;
  step.dt_s = dt_s;
  step.position = place;
  step.f_n = -gravity.g_n(place);
  step.F = nav::error_dynamics(place, step.v_n, step.f_n, gravity);
  integrate(step, vertical);
  return step;
}

LinearMotion::LinearMotion(const nav::Gravity& gravity, Vertical vertical, double step_s)
    : gravity_(gravity), vertical_(vertical), step_s_(step_s) {
  if (!(step_s > 0.0)) throw std::invalid_argument("a step of the linear model must be longer than 0 s");
}

std::optional<LinearStep> LinearMotion::advance(const ImuTruth& truth) {
  const double dt_s = time::to_seconds(truth.interval_ns);
  if (!(dt_s > 0.0)) return std::nullopt;
  // The attitude in the middle of the interval.
  const nav::Matrix3 C_nb =
      nav::matrix_from_quaternion(truth.q_nb) * (nav::Matrix3::Identity() - 0.5 * nav::skew(truth.dtheta_b));
  time_s_ += dt_s;
  C_nb_sum_ += C_nb * dt_s;
  dv_n_ += C_nb * truth.dv_b;
  // Half a sample of tolerance: sums of dt round.
  if (time_s_ + 0.5 * dt_s < step_s_) return std::nullopt;
  LinearStep step;
  step.end_s = time::to_seconds(truth.header.sim_time_ns);
  step.dt_s = time_s_;
  step.position = {truth.latitude_rad, truth.longitude_rad, truth.height_m};
  step.v_n = truth.v_n;
  step.f_n = dv_n_ / time_s_;
  step.C_nb = C_nb_sum_ / time_s_;
  step.F = nav::error_dynamics(step.position, step.v_n, step.f_n, gravity_);
  integrate(step, vertical_);
  time_s_ = 0.0;
  C_nb_sum_.setZero();
  dv_n_.setZero();
  return step;
}

}  // namespace inslab::predict
