#include "inslab/models/trajectory/smooth_model.hpp"

#include <stdexcept>
#include <utility>

namespace inslab::trajectory {

SmoothModel::SmoothModel(SmoothMotion motion, std::string name, const nav::Gravity& gravity, const time::Grid& grid,
                         const time::GpsTime& start)
    : motion_(std::move(motion)), name_(std::move(name)), grid_(grid), start_(start), vehicle_(motion_, gravity) {
  nav::check_domain(vehicle_.position());
}

TruthState SmoothModel::advance() {
  ++sample_;
  const time::Nanoseconds end = grid_.after(vehicle_.now());
  interval_ = end - vehicle_.now();
  try {
    vehicle_.advance(end);
    nav::check_domain(vehicle_.position());
  } catch (const std::exception& error) {
    throw std::domain_error("at " + std::to_string(time::to_seconds(end)) + " s, " + name_ + " " +
                            std::to_string(vehicle_.piece_index()) + ": " + error.what());
  }
  return current();
}

TruthState SmoothModel::current() const {
  TruthState truth;
  truth.header.sequence_number = sample_;
  truth.header.sim_time_ns = vehicle_.now().count();
  const time::GpsTime gps = start_ + vehicle_.now();
  truth.header.gps_week = gps.week;
  truth.header.gps_time_of_week_ns = gps.time_of_week_ns;
  truth.latitude_rad = vehicle_.position().latitude_rad;
  truth.longitude_rad = vehicle_.position().longitude_rad;
  truth.height_m = vehicle_.position().height_m;
  truth.v_n = vehicle_.v_n();
  truth.q_nv = vehicle_.q_nv();
  truth.omega_iv_v = vehicle_.omega_iv_v();
  truth.f_v = vehicle_.f_v();
  truth.dtheta_v = vehicle_.dtheta_v();
  truth.dv_v = vehicle_.dv_v();
  truth.interval_ns = interval_.count();
  truth.segment_index = vehicle_.piece_index();
  return truth;
}

}  // namespace inslab::trajectory
