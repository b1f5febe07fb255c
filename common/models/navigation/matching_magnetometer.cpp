#include "inslab/models/navigation/matching_magnetometer.hpp"

#include "inslab/models/navigation/mounting.hpp"

namespace inslab::navigation {

void match(const MagnetometerErrorProfile& magnetometer, const InstallationProfile& place,
           const InstallationProfile& imu_place, NavigationParameters& p) {
  MagnetometerBelief& belief = p.magnetometer;
  Vector3 currents_nt = Vector3::Zero();
  for (const CurrentField& current : magnetometer.currents) {
    currents_nt = currents_nt.cwiseMax(current.B_b_nt.cwiseAbs());
  }
  // A count is uniform over its width: a variance of a twelfth of its square.
  belief.white_sigma_nt =
      (magnetometer.white_sigma_nt.cwiseAbs2() + magnetometer.quantization_nt.cwiseAbs2() / 12.0).cwiseSqrt();
  belief.white_sigma_nt = belief.white_sigma_nt.cwiseMax(1.0);  // nT: an ideal one is believed to less than that
  belief.hard_iron_sigma_nt =
      (magnetometer.hard_iron_nt.cwiseAbs2() + magnetometer.gm_sigma_nt.cwiseAbs2() + currents_nt.cwiseAbs2())
          .cwiseSqrt();
  belief.hard_iron_correlation_time_s = magnetometer.gm_correlation_time_s;
  belief.soft_iron_sigma = magnetometer.soft_iron.cwiseAbs();
  belief.earth_field_sigma_ned_nt.setZero();
  belief.mounting_rpy_deg = rpy_deg_of(axes_in_vehicle(imu_place).transpose() * axes_in_vehicle(place));
  p.states.hard_iron = !belief.hard_iron_sigma_nt.isZero(0.0);
  p.states.soft_iron = !belief.soft_iron_sigma.isZero(0.0);
  p.states.earth_field = false;
}

}  // namespace inslab::navigation
