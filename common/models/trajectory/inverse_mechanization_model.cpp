#include "inslab/models/trajectory/inverse_mechanization_model.hpp"

#include <stdexcept>
#include <utility>

namespace inslab::trajectory {

InverseMechanizationModel::InverseMechanizationModel(std::shared_ptr<const TrajectoryFile> file,
                                                     const nav::Gravity& gravity, const Options& options,
                                                     const time::Grid& grid, const time::GpsTime& start)
    : states_(std::move(file)),
      grid_(grid),
      start_(start),
      position_feedback_per_s_(options.position_feedback_per_s),
      file_position_(states_.at(time::Nanoseconds(0)).position),
      strapdown_(states_.at(time::Nanoseconds(0)), gravity, options.strapdown),
      end_(grid_.at_or_before(states_.end())),
      next_(find_next()) {}

/// The interval that begins at the simulated state, or an empty one where the file ends.
nav::ImuIncrements InverseMechanizationModel::find_next() {
  const time::Nanoseconds t = grid_.after(now_);
  if (t > end_) return {};
  const nav::NavState file = states_.at(t);
  const nav::Vector3 behind_m = nav::ned_from(strapdown_.position(), file_position_);
  file_position_ = file.position;
  return strapdown_.increments_to(file.v_n + position_feedback_per_s_ * behind_m, file.q_nb,
                                  time::to_seconds(t - now_));
}

TruthState InverseMechanizationModel::advance() {
  const time::Nanoseconds t = grid_.after(now_);
  if (t > end_) states_.at(t);  // says what is missing
  strapdown_.advance(next_);
  interval_ = next_;
  ++sample_;
  span_ = t - now_;
  now_ = t;
  try {
    nav::check_domain(strapdown_.position());
  } catch (const std::domain_error& error) {
    throw std::domain_error("at " + std::to_string(time::to_seconds(t)) +
                            " s of the trajectory's file: " + error.what());
  }
  next_ = find_next();
  return current();
}

TruthState InverseMechanizationModel::current() const {
  TruthState truth;
  truth.header.sequence_number = sample_;
  truth.header.sim_time_ns = now_.count();
  const time::GpsTime gps = start_ + now_;
  truth.header.gps_week = gps.week;
  truth.header.gps_time_of_week_ns = gps.time_of_week_ns;
  const nav::NavState state = strapdown_.state();
  truth.latitude_rad = state.position.latitude_rad;
  truth.longitude_rad = state.position.longitude_rad;
  truth.height_m = state.position.height_m;
  truth.v_n = state.v_n;
  truth.q_nv = state.q_nb;
  truth.dtheta_v = interval_.dtheta_b;
  truth.dv_v = interval_.dv_b;
  truth.interval_ns = span_.count();
  const double around_s = interval_.dt_s + next_.dt_s;
  truth.omega_iv_v = (interval_.dtheta_b + next_.dtheta_b) / around_s;
  truth.f_v = (interval_.dv_b + next_.dv_b) / around_s;
  return truth;
}

}  // namespace inslab::trajectory
