#pragma once

#include "inslab/nav/vectors.hpp"

namespace inslab::satellites {

using nav::Matrix3;
using nav::Vector3;

/// A satellite's antenna and its clock at an instant of GPS time.
struct SatelliteState {
  Vector3 r_e_m = Vector3::Zero();
  Vector3 v_e_m_per_s = Vector3::Zero();  ///< as seen from the turning Earth
  Vector3 a_e_m_per_s2 = Vector3::Zero();
  double clock_s = 0.0;        ///< the satellite's clock minus GPS time, relativity included
  double drift_s_per_s = 0.0;  ///< its derivative
};

}  // namespace inslab::satellites
