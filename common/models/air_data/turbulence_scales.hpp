#pragma once

#include "inslab/data/profiles/wind_field.hpp"

namespace inslab::air_data {

/// Lengths and standard deviations of turbulence, along the mean wind, to its right, down.
struct TurbulenceScales {
  Vector3 length_m = Vector3::Constant(1.0);
  Vector3 sigma_m_per_s = Vector3::Zero();
};

/// Those of MIL-F-8785C, Flying qualities of piloted airplanes (1980), h in feet above the ground:
///
///   below 1000 ft   L_w = h, L_u = L_v = h / (0.177 + 0.000823 h)^1.2, sigma_w = 0.1 W_20,
///                   sigma_u = sigma_v = sigma_w / (0.177 + 0.000823 h)^0.4      3.7.3.4, figures 10 and 11
///   above 2000 ft   L_u = L_v = L_w = 1750 ft, sigma_u = sigma_v = sigma_w      3.7.2.1, figure 7
///
/// and straight lines between them. Below 10 ft they are those of 10 ft. The wind W_20 at 20 ft is 15, 30 and 45 kt for
/// light, moderate and severe; figure 7 is read at probabilities of 1e-2, 1e-3 and 1e-5. Figure 7 counts heights
/// above the sea; here they are above the ground.
TurbulenceScales turbulence_scales(Turbulence turbulence, double height_above_ground_m);

}  // namespace inslab::air_data
