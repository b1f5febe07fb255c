#include "inslab/referee/predict/closed_forms.hpp"

#include <cmath>

#include "inslab/nav/wgs84.hpp"

namespace inslab::predict {
namespace {

/// (68) with an angle and a gyro error that tilt towards the channel's axis.
double schuler(double g_m_per_s2, double R_m, double t_s, double position_m, double velocity_m_per_s, double tilt_rad,
               double accel_m_per_s2, double gyro_rad_per_s) {
  const double w = std::sqrt(g_m_per_s2 / R_m), s = std::sin(w * t_s) / w, half = std::sin(0.5 * w * t_s);
  const double c = 2.0 * half * half;
  return position_m + s * velocity_m_per_s + R_m * c * tilt_rad + c / (w * w) * accel_m_per_s2 +
         R_m * (s - t_s) * gyro_rad_per_s;
}

}  // namespace

ClosedFormsAtRest::ClosedFormsAtRest(const nav::Geodetic& place, const nav::Gravity& gravity)
    : north_radius_m_(nav::wgs84::meridian_radius_m(place.latitude_rad) + place.height_m),
      east_radius_m_(nav::wgs84::transverse_radius_m(place.latitude_rad) + place.height_m),
      mean_radius_m_(std::sqrt((north_radius_m_ - place.height_m) * (east_radius_m_ - place.height_m)) +
                     place.height_m),
      g_m_per_s2_(gravity.g_n(place).z()),
      omega_north_rad_per_s_(nav::wgs84::omega_e_rad_per_s * std::cos(place.latitude_rad)) {}

ClosedForms ClosedFormsAtRest::at(const ConstantErrors& e, double t_s) const {
  ClosedForms closed;
  closed.north_m = schuler(g_m_per_s2_, north_radius_m_, t_s, e.position_n.x(), e.velocity_n.x(), e.phi_n.y(),
                           e.accel_n.x(), e.gyro_n.y());
  closed.east_m = schuler(g_m_per_s2_, east_radius_m_, t_s, e.position_n.y(), e.velocity_n.y(), -e.phi_n.x(),
                          e.accel_n.y(), -e.gyro_n.x());
  const double h_m = -e.position_n.z(), v_D = e.velocity_n.z();
  const double upwards_m_per_s2 = 2.0 * omega_north_rad_per_s_ * e.velocity_n.y() - e.accel_n.z();
  const double k = std::sqrt(2.0 * g_m_per_s2_ / mean_radius_m_), half = std::sinh(0.5 * k * t_s);
  closed.height_m =
      h_m * std::cosh(k * t_s) - v_D / k * std::sinh(k * t_s) + upwards_m_per_s2 / (k * k) * 2.0 * half * half;
  closed.height_short_m = h_m - v_D * t_s + 0.5 * upwards_m_per_s2 * t_s * t_s;
  return closed;
}

}  // namespace inslab::predict
