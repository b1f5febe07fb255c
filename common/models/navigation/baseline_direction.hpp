#pragma once

#include <cmath>
#include <vector>

#include "inslab/data/samples/baseline_heading.hpp"
#include "inslab/models/navigation/measurement.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/direction.hpp"

namespace inslab::navigation {

/// Heading and pitch of the vector between two antennas,
///
///   b_n = C_nb b_b + d,
///
/// d the error of the receiver that lasts, such as multipath. The computed C_nb is (I - [phi x]) C_nb, so
/// db_n = b_n x phi + dd; heading and pitch follow by nav::by_components(). Two rows under one gate: a wrong fix is
/// refused.
struct BaselineDirection {
  using Sample = BaselineHeading;
  static constexpr std::string_view name = "baseline_direction";

  static bool usable(const BaselineHeading& sample) {
    return std::isfinite(sample.heading_rad) && std::isfinite(sample.pitch_rad);
  }

  static void add_to(std::vector<Measurement>& measurements, const BaselineHeading& sample, const Situation& at,
                     const NavigationParameters& p) {
    const HeadingBelief& belief = p.heading;
    const nav::Vector3 turned_n = at.C_nb * belief.baseline_b_m;
    const nav::Vector3 b_n = turned_n + at.estimates[StateBlock::BaselineDrift];
    if (sample.fix_type != belief.fix_type || b_n.head<2>().isZero(0.0)) return;
    const nav::Direction predicted = nav::direction_of(b_n);
    const Eigen::Matrix<double, 2, 3> D = nav::by_components(b_n);
    Measurement& m = measurements.emplace_back();
    m.name = name;
    m.gate = p.innovation_test.limit;
    m.innovation = Eigen::Vector2d(nav::wrapped_to_pi(predicted.heading_rad - sample.heading_rad),
                                   predicted.pitch_rad - sample.pitch_rad);
    m.R = D.cwiseAbs2() * belief.relative_sigma_ned_m.cwiseAbs2();
    m.by(StateBlock::Attitude, D * nav::skew(turned_n));
    m.by(StateBlock::BaselineDrift, D);
  }
};

}  // namespace inslab::navigation
