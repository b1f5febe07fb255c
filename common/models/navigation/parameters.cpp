#include "inslab/models/navigation/parameters.hpp"

#include <cmath>

#include "inslab/data/catalog/profile_rules.hpp"

namespace inslab::navigation {

std::optional<Violation> violation(const NavigationParameters& p) {
  const std::pair<const char*, const Vector3&> arms[] = {
      {"lever_arm_b_m", p.lever_arm_b_m},
      {"barometer.lever_arm_b_m", p.barometer.lever_arm_b_m},
      {"odometer.lever_arm_b_m", p.odometer.lever_arm_b_m},
      {"other_odometer.lever_arm_b_m", p.other_odometer.lever_arm_b_m},
      {"heading.baseline_b_m", p.heading.baseline_b_m}};
  for (const auto& [name, arm_b_m] : arms) {
    if (arm_b_m.norm() <= catalog::kMaxLeverArmM) continue;
    return Violation{Rule::LeverArmLength, name,
                     "is " + std::to_string(arm_b_m.norm()) + " m long; a lever arm has at most 1000 m"};
  }
  if (p.initial.attitude == InitialAttitude::Given && !(std::abs(p.initial.rpy_deg.y()) <= 90.0)) {
    return Violation{Rule::InitialPitch, "initial.rpy_deg",
                     "has a pitch of " + std::to_string(p.initial.rpy_deg.y()) + " deg; expected -90 to 90"};
  }
  if (!p.zero_velocity.use) return std::nullopt;
  const ZeroVelocity& rest = p.zero_velocity;
  const std::pair<const char*, double> thresholds[] = {{"force_spread_m_per_s2", rest.force_spread_m_per_s2},
                                                       {"rate_spread_deg_per_s", rest.rate_spread_deg_per_s},
                                                       {"mean_rate_deg_per_s", rest.mean_rate_deg_per_s},
                                                       {"speed_m_per_s", rest.speed_m_per_s}};
  for (const auto& [name, threshold] : thresholds) {
    if (threshold > 0.0) continue;
    return Violation{Rule::RestThresholds, std::string("zero_velocity.") + name,
                     "is 0, which no IMU at rest keeps; expected above 0, or zero_velocity.use false"};
  }
  return std::nullopt;
}

}  // namespace inslab::navigation
