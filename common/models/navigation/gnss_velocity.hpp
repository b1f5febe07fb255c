#pragma once

#include <vector>

#include "inslab/data/samples/gnss_fix.hpp"
#include "inslab/models/navigation/measurement.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::navigation {

/// A fix's velocity of the antenna, v_n + C_nb (omega_ib x l_b) - omega_ie x C_nb l_b. A sigma of 0 means that there is
/// none.
struct GnssVelocity {
  using Sample = GnssFix;
  static constexpr std::string_view name = "gnss_velocity";

  static bool usable(const GnssFix& fix) {
    return fix.v_n.allFinite() && fix.velocity_sigma_ned_m_per_s.allFinite() &&
           fix.velocity_sigma_ned_m_per_s.minCoeff() >= 0.0;
  }

  static void add_to(std::vector<Measurement>& measurements, const GnssFix& fix, const Situation& at,
                     const NavigationParameters& p) {
    const nav::Vector3 variances = fix.velocity_sigma_ned_m_per_s.cwiseAbs2();
    if (variances.minCoeff() <= 0.0) return;
    const nav::Vector3 arm_n = at.C_nb * p.lever_arm_b_m;
    const nav::Vector3 omega_ie_n = nav::omega_ie_n(at.position.latitude_rad);
    const nav::Vector3 turning_n = at.C_nb * at.omega_ib_b.cross(p.lever_arm_b_m);
    const nav::Matrix3 by_rate = at.C_nb * nav::skew(p.lever_arm_b_m);
    Measurement& m = measurements.emplace_back();
    m.name = name;
    m.says = Measurement::Says::Velocity;
    m.gate = p.innovation_test.limit;
    m.innovation = at.v_n + turning_n - omega_ie_n.cross(arm_n) - fix.v_n;
    m.R = variances;
    m.by(StateBlock::Velocity, nav::Matrix3::Identity());
    m.by(StateBlock::Attitude, nav::skew(turning_n) - nav::skew(omega_ie_n) * nav::skew(arm_n));
    m.by(StateBlock::GyroBias, by_rate * at.rate_by_measured.asDiagonal());
    m.by(StateBlock::GyroScale, by_rate * at.omega_ib_b.cwiseProduct(at.rate_by_measured).asDiagonal());
  }
};

}  // namespace inslab::navigation
