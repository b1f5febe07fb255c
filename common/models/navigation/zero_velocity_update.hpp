#pragma once

#include <cmath>
#include <vector>

#include "inslab/data/samples/stream_header.hpp"
#include "inslab/models/navigation/measurement.hpp"

namespace inslab::navigation {

/// Somebody who knows, such as a wheel's sensor or a brake, says that the IMU stood still at this time.
struct Standstill {
  StreamHeader header;
  std::int64_t available_sim_time_ns = 0;
  double sigma_m_per_s = 0.02;  ///< of each axis of the velocity that is taken to be 0
};

/// The velocity of the IMU is 0: said by a Standstill, or found by the detector of rest (InertialFilter).
struct ZeroVelocityUpdate {
  using Sample = Standstill;
  static constexpr std::string_view name = "zero_velocity";

  static bool usable(const Standstill& standstill) {
    return std::isfinite(standstill.sigma_m_per_s) && standstill.sigma_m_per_s > 0.0;
  }

  static Measurement of(const nav::Vector3& v_n, double variance) {
    Measurement m;
    m.name = name;
    m.innovation = v_n;
    m.R = nav::Vector3::Constant(variance);
    m.by(StateBlock::Velocity, nav::Matrix3::Identity());
    return m;
  }

  static void add_to(std::vector<Measurement>& measurements, const Standstill& standstill, const Situation& at,
                     const NavigationParameters& p) {
    measurements.push_back(of(at.v_n, standstill.sigma_m_per_s * standstill.sigma_m_per_s));
    measurements.back().gate = p.innovation_test.limit;
  }
};

}  // namespace inslab::navigation
