#pragma once

#include "inslab/foundation/fields/field.hpp"

namespace inslab::imu {

/// What an IMU puts out for one interval: integrals of angular rate and specific force in the moving b axes.
struct Increments {
  Vector3 dtheta = Vector3::Zero();  ///< rad
  Vector3 dv = Vector3::Zero();      ///< m/s

  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.dtheta, self.dv);
  }

  Increments& operator+=(const Increments& other) {
    dtheta += other.dtheta;
    dv += other.dv;
    return *this;
  }
};

}  // namespace inslab::imu
