#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "inslab/foundation/fields/field.hpp"

namespace inslab::navigation {

/// What the filter believes of an odometer on a wheel that is not steered.
struct OdometerBelief {
  std::optional<std::uint32_t> number;  ///< of its stream; without one the filter takes none. The scenario says it.
  Vector3 lever_arm_b_m = Vector3::Zero();
  Vector3 mounting_rpy_deg = Vector3::Zero();
  double axis_sigma_deg = 0.5;
  double scale_factor_sigma_ppm = 10000.0;
  double scale_factor_drift_sigma_ppm = 500.0;
  double scale_factor_drift_correlation_time_s = 1800.0;
  double sigma_m_per_s = 0.02;
  double noise_m_per_sqrt_m = 0.004;
  double count_m = 0.0;
  double dead_below_m_per_s = 0.0;
  double longitudinal_slip_threshold_m_per_s2 = 0.0;
  double longitudinal_slip_s2_per_m = 0.0;
  double lateral_slip_threshold_m_per_s2 = 0.0;
  double lateral_slip_s2_per_m = 0.0;
  double slip_lasts_s = 10.0;

  /// Standard deviation of the slip under a specific force of these components in the wheel's axes: by which part of
  /// its way the wheel turns too much or too little, and by which it slides aside. All of what the tyre's curve has, as
  /// a filter does not know which way.
  double slip_sigma(double force_along_m_per_s2, double force_across_m_per_s2) const {
    const double along = std::abs(force_along_m_per_s2) - longitudinal_slip_threshold_m_per_s2;
    const double across = std::abs(force_across_m_per_s2) - lateral_slip_threshold_m_per_s2;
    return std::min(1.0,
                    longitudinal_slip_s2_per_m * std::max(0.0, along) + lateral_slip_s2_per_m * std::max(0.0, across));
  }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("lever_arm_b_m", "from the IMU's centre to where the wheel touches the road, in the IMU's axes")
              .in(-1000.0, 1000.0),
          self.lever_arm_b_m);
    visit(Field("mounting_rpy_deg", "roll, pitch, yaw of the wheel in the IMU's axes; it rolls along its x")
              .in(-360.0, 360.0),
          self.mounting_rpy_deg);
    visit(Field("axis_sigma_deg", "states.wheel_axis: of the wheel's pitch and yaw; constants").in(0.0, 45.0),
          self.axis_sigma_deg);
    visit(Field("scale_factor_sigma_ppm", "states.wheel_scale: standard deviation of the constant").in(0.0, 5e5),
          self.scale_factor_sigma_ppm);
    visit(Field("scale_factor_drift_sigma_ppm",
                "states.wheel_scale: of what drifts beside it, steady-state and initial standard deviation")
              .in(0.0, 1e5),
          self.scale_factor_drift_sigma_ppm);
    visit(Field("scale_factor_drift_correlation_time_s", "0: a constant").in(0.0, 1e7),
          self.scale_factor_drift_correlation_time_s);
    visit(Field("sigma_m_per_s", "white noise of a sample's mean speed, besides the two below").in(1e-4, 1e2),
          self.sigma_m_per_s);
    visit(Field("noise_m_per_sqrt_m", "of the road: standard deviation over 1 m, growing with the root").in(0.0, 1.0),
          self.noise_m_per_sqrt_m);
    visit(Field("count_m", "way of one count; 0: none").in(0.0, 20.0), self.count_m);
    visit(Field("dead_below_m_per_s", "slower than this it counts nothing").in(0.0, 10.0), self.dead_below_m_per_s);
    visit(Field("longitudinal_slip_threshold_m_per_s2", "force along the wheel, over the mass, from which it may slip")
              .in(0.0, 100.0),
          self.longitudinal_slip_threshold_m_per_s2);
    visit(Field("longitudinal_slip_s2_per_m",
                "standard deviation of the slip for each m/s^2 beyond, of the speed that is shown and of "
                "rolling_constraint; 0: none")
              .in(0.0, 10.0),
          self.longitudinal_slip_s2_per_m);
    visit(Field("lateral_slip_threshold_m_per_s2", "force across the wheel, over the mass, from which it may slip")
              .in(0.0, 100.0),
          self.lateral_slip_threshold_m_per_s2);
    visit(Field("lateral_slip_s2_per_m", "as longitudinal_slip_s2_per_m").in(0.0, 10.0), self.lateral_slip_s2_per_m);
    visit(Field("slip_lasts_s", "so long a slip errs alike: samples in it count as one of them").in(0.0, 1e3),
          self.slip_lasts_s);
  }
};

/// That wheels which are not steered neither slide aside nor leave the road: of the first odometer's contact.
struct RollingConstraint {
  bool use = true;
  double lateral_sigma_m_per_s = 0.1;
  double vertical_sigma_m_per_s = 0.1;
  double lasts_s = 0.1;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("use", "with each sample of the first odometer"), self.use);
    visit(Field("lateral_sigma_m_per_s", "of the contact's velocity across the wheel, taken to be 0").in(1e-4, 1e2),
          self.lateral_sigma_m_per_s);
    visit(Field("vertical_sigma_m_per_s", "the same away from the road").in(1e-4, 1e2), self.vertical_sigma_m_per_s);
    visit(Field("lasts_s", "so long a slide errs alike: samples in it count as one of them").in(0.0, 1e3),
          self.lasts_s);
  }
};

}  // namespace inslab::navigation
