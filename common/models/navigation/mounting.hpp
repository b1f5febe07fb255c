#pragma once

#include "inslab/data/profiles/installation_profile.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::navigation {

/// C_vs of a mounted sensor: v_v = C_vs v_s.
inline nav::Matrix3 axes_in_vehicle(const InstallationProfile& place) {
  const Vector3 rpy_rad = units::kDeg * place.mounting_rpy_deg;
  return nav::matrix_from_rpy({rpy_rad.x(), rpy_rad.y(), rpy_rad.z()});
}

/// The angles of one sensor's axes in those of another, deg.
inline Vector3 rpy_deg_of(const nav::Matrix3& C) {
  const nav::RollPitchYaw rpy = nav::rpy_from_matrix(C);
  return Vector3(rpy.roll_rad, rpy.pitch_rad, rpy.yaw_rad) / units::kDeg;
}

}  // namespace inslab::navigation
