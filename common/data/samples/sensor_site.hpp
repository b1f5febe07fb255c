#pragma once

#include <cmath>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/data/samples/truth_state.hpp"
#include "inslab/nav/geodesy.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab {
inline namespace samples {

/// Where a sensor on the vehicle is and how it moves, in its own NED: the vehicle's own turns by up to the arm over the
/// Earth's radius.
struct SensorSite {
  nav::Geodetic position;
  Vector3 v_n = Vector3::Zero();       ///< m/s, NED at the sensor, relative to the Earth
  Matrix3 C_sn = Matrix3::Identity();  ///< takes the vehicle's NED to the sensor's
  double sin_latitude = 0.0;           ///< of the sensor's latitude
  double sin_vehicle_latitude = 0.0;
  Vector3 omega_ie_n = Vector3::Zero();  ///< rad/s, rate of the Earth in the vehicle's NED
};

/// C_sn of two places from the sines and cosines of their latitudes and the longitude of the second less the first's.
inline Matrix3 C_between_ned(double sin_from, double cos_from, double sin_to, double cos_to, double dlongitude_rad) {
  const double sin_d = std::sin(dlongitude_rad);
  const double cos_d = std::cos(dlongitude_rad);
  Matrix3 C;
  C << sin_to * sin_from * cos_d + cos_to * cos_from, -sin_to * sin_d,
      sin_to * cos_from * cos_d - cos_to * sin_from,  //
      sin_from * sin_d, cos_d, cos_from * sin_d,      //
      cos_to * sin_from * cos_d - sin_to * cos_from, -cos_to * sin_d, cos_to * cos_from * cos_d + sin_to * sin_from;
  return C;
}

/// The site of a sensor at `lever_arm_v_m` (m, from the vehicle's reference point, v axes): the position exactly
/// through ECEF, the velocity v_n + C_nv (omega_ev_v x l), with omega_ev = omega_iv - omega_ie, turned into the
/// sensor's own NED. Thesis (3-45), (3-46), with its -1 and omega_ie put right.
inline SensorSite sensor_site(const TruthState& truth, const Vector3& lever_arm_v_m) {
  const nav::Geodetic vehicle = geodetic_of(truth);
  const double sin_vehicle = std::sin(vehicle.latitude_rad);
  const double cos_vehicle = std::cos(vehicle.latitude_rad);
  const Vector3 omega_ie_n(nav::wgs84::omega_e_rad_per_s * cos_vehicle, 0.0,
                           -nav::wgs84::omega_e_rad_per_s * sin_vehicle);
  if (lever_arm_v_m.isZero(0.0)) {
    return {vehicle, truth.v_n, Matrix3::Identity(), sin_vehicle, sin_vehicle, omega_ie_n};
  }
  const Matrix3 C_nv = truth.q_nv.toRotationMatrix();
  const nav::Geodetic change = nav::geodetic_change(vehicle, C_nv * lever_arm_v_m);
  SensorSite site;
  site.position = {vehicle.latitude_rad + change.latitude_rad,
                   nav::wrapped_to_pi(vehicle.longitude_rad + change.longitude_rad),
                   vehicle.height_m + change.height_m};
  site.sin_latitude = std::sin(site.position.latitude_rad);
  site.sin_vehicle_latitude = sin_vehicle;
  site.omega_ie_n = omega_ie_n;
  site.C_sn = C_between_ned(sin_vehicle, cos_vehicle, site.sin_latitude, std::cos(site.position.latitude_rad),
                            change.longitude_rad);
  const Vector3 omega_ev_v = truth.omega_iv_v - C_nv.transpose() * omega_ie_n;
  site.v_n = site.C_sn * (truth.v_n + C_nv * omega_ev_v.cross(lever_arm_v_m));
  return site;
}

}  // namespace samples
}  // namespace inslab
