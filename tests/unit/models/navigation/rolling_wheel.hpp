#pragma once

#include <cstdint>

#include "tests/unit/models/navigation/circling.hpp"

/// A wheel of the vehicle on a circle, and what a filter is told of it.
namespace inslab::navigation::circling {

inline constexpr int kSteps = 20;  ///< IMU intervals in one of an odometer: 10 Hz
inline constexpr double kInterval_s = kSteps * kDt_s;
inline constexpr std::int64_t kInterval_ns = kSteps * kDt_ns;

inline NavigationParameters told_of_a_wheel() {
  NavigationParameters p;
  p.states.wheel_scale = p.states.wheel_axis = true;
  p.odometer.number = 0;
  p.odometer.sigma_m_per_s = 0.03;
  p.odometer.noise_m_per_sqrt_m = 0.0;
  p.rolling_constraint.lateral_sigma_m_per_s = p.rolling_constraint.vertical_sigma_m_per_s = 0.05;
  return p;
}

inline WheelTravel travel(double distance_m, std::int64_t end_ns, std::uint32_t number = 0) {
  WheelTravel sample;
  sample.header.sim_time_ns = end_ns;
  sample.sensor_number = number;
  sample.interval_ns = kInterval_ns;
  sample.distance_m = distance_m;
  return sample;
}

/// Adds up the true way of a contact over the intervals of an odometer, by the rule of the trapezium.
class Wheel {
 public:
  explicit Wheel(const Vector3& arm_b_m = Vector3::Zero()) : arm_b_m_(arm_b_m) {}

  void begin(const Circling& truth) { v_b_ = truth.velocity_b(arm_b_m_); }
  void advance(const Circling& truth) {
    const Vector3 v_b = truth.velocity_b(arm_b_m_);
    way_b_m_ += 0.5 * kDt_s * (v_b_ + v_b);
    v_b_ = v_b;
  }
  Vector3 take() {
    const Vector3 way_b_m = way_b_m_;
    way_b_m_.setZero();
    return way_b_m;
  }

 private:
  Vector3 arm_b_m_;
  Vector3 v_b_ = Vector3::Zero();
  Vector3 way_b_m_ = Vector3::Zero();
};

}  // namespace inslab::navigation::circling
