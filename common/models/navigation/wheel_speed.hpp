#pragma once

#include <cmath>
#include <vector>

#include "inslab/models/navigation/wheel_motion.hpp"

namespace inslab::navigation {

/// The mean speed that an odometer shows of an interval, (1 + s) v_o,x; where the direction is not known, its size.
///
/// Whether a sample is used is asked of the filter's own speed: to ask the shown one would prefer those that err
/// upwards. A wheel that slips by more than its force lets it is left to the
/// innovation test.
struct WheelSpeed {
  using Sample = WheelTravel;
  static constexpr std::string_view name = "wheel_speed";
  /// The filter's speed must be so much above what the odometer hears.
  static constexpr double kSurelyHeard = 1.5;
  /// Slower, and the filter may be wrong about a direction that the odometer does not know.
  static constexpr double kSurelyForwards_m_per_s = 0.5;

  static bool usable(const WheelTravel& sample) { return std::isfinite(sample.distance_m) && sample.interval_ns > 0; }

  static void add_to(std::vector<Measurement>& measurements, const WheelTravel& sample, const Situation& at,
                     const NavigationParameters& p) {
    if (sample.sensor_number == p.odometer.number) add(measurements, sample, at, p, p.odometer, StateBlock::WheelScale);
    if (sample.sensor_number == p.other_odometer.number) {
      add(measurements, sample, at, p, p.other_odometer, StateBlock::OtherWheelScale);
    }
  }

 private:
  static bool shows(const WheelTravel& sample, double speed_m_per_s, double dt_s, const OdometerBelief& wheel) {
    const double dead = wheel.dead_below_m_per_s;
    if (std::abs(speed_m_per_s) < kSurelyHeard * dead) return false;
    if (!sample.direction_known && std::abs(speed_m_per_s) < kSurelyForwards_m_per_s) return false;
    // Less than a wheel shows that is heard at all.
    return dead == 0.0 || std::abs(sample.distance_m) + wheel.count_m >= dead * dt_s;
  }

  static void add(std::vector<Measurement>& measurements, const WheelTravel& sample, const Situation& at,
                  const NavigationParameters& p, const OdometerBelief& wheel, StateBlock scale) {
    const auto motion = WheelMotion::of(wheel, sample, at);
    if (!motion) return;
    const double dt_s = time::to_seconds(sample.interval_ns);
    const double by_scale = 1.0 + at.estimates[scale].head<2>().sum();
    const double rolled_m_per_s = motion->v_o().x();
    if (!shows(sample, rolled_m_per_s, dt_s, wheel)) return;
    const double sign = !sample.direction_known && rolled_m_per_s < 0.0 ? -1.0 : 1.0;
    const double road_m2 = std::pow(wheel.noise_m_per_sqrt_m, 2) * std::abs(rolled_m_per_s) * dt_s;
    // Both ends of the interval are wrong by a part of a count that is uniform over it.
    const double counts_m2 = wheel.count_m * wheel.count_m / 6.0;

    Measurement& m = measurements.emplace_back();
    m.name = name;
    m.gate = p.innovation_test.limit;
    m.innovation.resize(1);
    m.innovation[0] = sign * by_scale * rolled_m_per_s - sample.distance_m / dt_s;
    m.R.resize(1);
    m.R[0] = wheel.sigma_m_per_s * wheel.sigma_m_per_s + (road_m2 + counts_m2) / (dt_s * dt_s);
    m.R[0] += motion->slip_variance();
    motion->add_to(m, sign * by_scale * Eigen::RowVector3d::UnitX());
    m.by(scale, sign * rolled_m_per_s * Eigen::RowVector2d::Ones());
  }
};

}  // namespace inslab::navigation
