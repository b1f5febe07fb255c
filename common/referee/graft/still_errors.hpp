#pragma once

#include <string>
#include <variant>

#include "inslab/nav/alignment.hpp"
#include "inslab/nav/geodesy.hpp"
#include "inslab/referee/graft/imu_series.hpp"

namespace inslab::graft {

/// Where an IMU stood still, and what is known of how.
struct StillSite {
  nav::Geodetic position;
  nav::AlignmentLimits limits;
  bool feels_the_earth_turn = true;  ///< false: the gyros are too coarse to find north, and yaw is taken for 0
};

struct StillErrors {
  RecordedErrors errors;
  nav::Matrix3 C_nb = nav::Matrix3::Identity();  ///< by whole-span alignment
};

/// The errors of an IMU at rest: eps_k = [dtheta_k - C_bn omega_ie_n dt; dv_k + C_bn g_n dt], with C_nb from the means
/// of the whole span. With an attitude that comes from the means themselves three things are in it and not in the
/// errors: the mean of the gyros along the Earth's rate is left (its size alone is seen), the gyros' mean east and the
/// accelerometers' means level became attitude. Or why there is no alignment, in words.
std::variant<StillErrors, std::string> still_errors(const RecordedErrors& measured, const StillSite& site);

}  // namespace inslab::graft
