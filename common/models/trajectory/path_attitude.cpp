#include "inslab/models/trajectory/path_attitude.hpp"

#include <algorithm>
#include <cmath>

#include "inslab/foundation/units/units.hpp"

namespace inslab::trajectory {

namespace {

constexpr double kG_m_per_s2 = 9.80665;

double horizontal(const nav::Vector3& v_n) { return std::hypot(v_n.x(), v_n.y()); }

}  // namespace

bool is_moving(const PathMotion& motion, const scenario::VehicleAttitude& options) {
  return horizontal(motion.v_n) >= options.standstill_speed_m_per_s;
}

double bank_of_turn_rad(const PathMotion& motion, double max_bank_rad) {
  const double speed = horizontal(motion.v_n);
  if (speed == 0.0) return 0.0;
  const double across_m_per_s2 = (motion.v_n.x() * motion.a_n.y() - motion.v_n.y() * motion.a_n.x()) / speed;
  return std::clamp(std::atan2(across_m_per_s2, kG_m_per_s2), -max_bank_rad, max_bank_rad);
}

std::vector<nav::RollPitchYaw> attitudes_along(const std::vector<PathMotion>& motions,
                                               const scenario::VehicleAttitude& options) {
  const auto moves = [&](const PathMotion& motion) { return is_moving(motion, options); };
  const auto heading = [](const PathMotion& motion) {
    return nav::RollPitchYaw{0.0, std::atan2(-motion.v_n.z(), horizontal(motion.v_n)),
                             std::atan2(motion.v_n.y(), motion.v_n.x())};
  };
  nav::RollPitchYaw held;
  const auto first = std::find_if(motions.begin(), motions.end(), moves);
  if (first != motions.end()) held = heading(*first);
  std::vector<nav::RollPitchYaw> attitudes;
  attitudes.reserve(motions.size());
  for (const PathMotion& motion : motions) {
    if (moves(motion)) held = heading(motion);
    attitudes.push_back(held);
    if (moves(motion)) attitudes.back().roll_rad = bank_of_turn_rad(motion, options.max_bank_deg * units::kDeg);
  }
  return attitudes;
}

}  // namespace inslab::trajectory
