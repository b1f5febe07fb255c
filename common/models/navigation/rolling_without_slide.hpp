#pragma once

#include <algorithm>
#include <vector>

#include "inslab/models/navigation/wheel_motion.hpp"

namespace inslab::navigation {

/// A wheel neither slides aside nor leaves the road: v_o,y = v_o,z = 0 over the interval of the first odometer's sample
/// (P. Groves (2013), 15.4.1), whatever that odometer shows. One wheel says it for all: those of an axle slide
/// together. Under a force by which it slips it slides too, and the body leans on its springs.
struct RollingWithoutSlide {
  using Sample = WheelTravel;
  static constexpr std::string_view name = "rolling_without_slide";

  static bool usable(const WheelTravel& sample) { return sample.interval_ns > 0; }

  static void add_to(std::vector<Measurement>& measurements, const WheelTravel& sample, const Situation& at,
                     const NavigationParameters& p) {
    const RollingConstraint& constraint = p.rolling_constraint;
    if (!constraint.use || sample.sensor_number != p.odometer.number) return;
    const auto motion = WheelMotion::of(p.odometer, sample, at);
    if (!motion) return;
    const double alike = std::max(1.0, constraint.lasts_s / time::to_seconds(sample.interval_ns));
    Measurement& m = measurements.emplace_back();
    m.name = name;
    m.gate = p.innovation_test.limit;
    m.innovation = motion->v_o().tail<2>();
    m.R = alike *
          nav::Vector3(0.0, constraint.lateral_sigma_m_per_s, constraint.vertical_sigma_m_per_s).cwiseAbs2().tail<2>();
    m.R.array() += motion->slip_variance();
    motion->add_to(m, Eigen::Matrix3d::Identity().bottomRows<2>());
  }
};

}  // namespace inslab::navigation
