#include "inslab/models/navigation/matching_heading.hpp"

#include "inslab/models/navigation/mounting.hpp"

namespace inslab::navigation {

void match(const HeadingErrorProfile& heading, const InstallationProfile& place, const InstallationProfile& imu_place,
           NavigationParameters& p) {
  HeadingBelief& belief = p.heading;
  belief.fix_type = heading.fix_type;
  belief.baseline_b_m = axes_in_vehicle(imu_place).transpose() * (place.second_lever_arm_v_m - place.lever_arm_v_m);
  belief.relative_sigma_ned_m = heading.relative_sigma_ned_m.cwiseMax(1e-4);  // an ideal one is believed to no less
  belief.relative_drift_sigma_ned_m = heading.relative_gm_sigma_ned_m;
  belief.relative_drift_correlation_time_s = heading.relative_gm_correlation_time_s;
  p.states.baseline_drift = !heading.relative_gm_sigma_ned_m.isZero(0.0);
}

}  // namespace inslab::navigation
