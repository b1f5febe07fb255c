#pragma once

#include <vector>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/data/samples/gnss_fix.hpp"
#include "inslab/models/navigation/measurement.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::navigation {

/// A fix's position of the antenna, r_n + C_nb l_b.
struct GnssPosition {
  using Sample = GnssFix;
  static constexpr std::string_view name = "gnss_position";

  static bool usable(const GnssFix& fix) {
    return fix.fix_type != FixType::None && fix.position_sigma_ned_m.allFinite() &&
           fix.position_sigma_ned_m.minCoeff() > 0.0 && nav::in_domain(geodetic_of(fix));
  }

  static void add_to(std::vector<Measurement>& measurements, const GnssFix& fix, const Situation& at,
                     const NavigationParameters& p) {
    const nav::Vector3 arm_n = at.C_nb * p.lever_arm_b_m;
    Measurement& m = measurements.emplace_back();
    m.name = name;
    m.says = Measurement::Says::Position;
    m.gate = p.innovation_test.limit;
    m.innovation = nav::ned_from(geodetic_of(fix), nav::displaced(at.position, arm_n));
    m.R = fix.position_sigma_ned_m.cwiseAbs2();
    m.by(StateBlock::Position, nav::Matrix3::Identity());
    m.by(StateBlock::Attitude, nav::skew(arm_n));
  }
};

}  // namespace inslab::navigation
