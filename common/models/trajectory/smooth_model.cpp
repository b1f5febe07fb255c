#include "inslab/models/trajectory/smooth_model.hpp"

#include <stdexcept>
#include <utility>

#include "inslab/models/trajectory/smooth_truth.hpp"

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
  TruthState truth = truth_of(vehicle_, interval_);
  truth.header.sequence_number = sample_;
  const time::GpsTime gps = start_ + vehicle_.now();
  truth.header.gps_week = gps.week;
  truth.header.gps_time_of_week_ns = gps.time_of_week_ns;
  return truth;
}

}  // namespace inslab::trajectory
