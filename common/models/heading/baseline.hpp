#pragma once

#include "inslab/data/profiles/installation_profile.hpp"
#include "inslab/data/samples/sensor_site.hpp"

namespace inslab::heading {

/// The true vector from the first antenna to the second, m, in the NED of the first, whose site is given:
/// C_sn C_nv (second arm - first arm).
inline Vector3 baseline_s_m(const TruthState& truth, const SensorSite& first_antenna,
                            const InstallationProfile& installation) {
  const Vector3 baseline_v_m = installation.second_lever_arm_v_m - installation.lever_arm_v_m;
  return first_antenna.C_sn * (truth.q_nv * baseline_v_m);
}

}  // namespace inslab::heading
