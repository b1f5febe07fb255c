#pragma once

#include "inslab/nav/gravity.hpp"
#include "inslab/referee/predict/error_source.hpp"

namespace inslab::predict {

/// What the closed forms give after a time, m.
struct ClosedForms {
  double north_m = 0.0;         ///< the lecture (68)
  double east_m = 0.0;          ///< (68) of the east channel (63)
  double height_m = 0.0;        ///< (72)
  double height_short_m = 0.0;  ///< (73): a few minutes
};

/// The closed forms of the lecture for an IMU at rest at any latitude: each channel alone, without the Earth's rotation
/// but for 2 omega_N delta v_E of the height.
///
/// R is M + h for north, N + h for east, sqrt(M N) + h for the height. The terms of delta v_D have a minus, which the
/// lecture prints as a plus: delta h' = -delta v_D.
class ClosedFormsAtRest {
 public:
  ClosedFormsAtRest(const nav::Geodetic& place, const nav::Gravity& gravity);

  ClosedForms at(const ConstantErrors& errors, double t_s) const;

 private:
  double north_radius_m_;
  double east_radius_m_;
  double mean_radius_m_;
  double g_m_per_s2_;
  double omega_north_rad_per_s_;
};

}  // namespace inslab::predict
