#pragma once

#include "inslab/nav/strapdown.hpp"

namespace inslab::nav {

using Matrix9 = Eigen::Matrix<double, 9, 9>;

/// The phi-angle error model of the mechanization in n: x' = F x with x = (delta r_n, delta v_n, phi), each error the
/// estimate less the truth.
///
/// delta r_n in m along north, east, down: ((M+h) delta lat, (N+h) cos(lat) delta lon, -delta h). delta v_n in m/s in
/// n. phi in rad: the computed C_nb is (I - [phi x]) C_nb. Source: the lecture (23)-(25), (30)-(32), (48)-(50), with
/// gravity's gradients and those of M and N, which it leaves out: docs/navigation.md. Exact to first order for the
/// models `somigliana` and `series`; the north component of `normal` is left out.
///
/// `f_n` is the specific force in n, m/s^2.
Matrix9 error_dynamics(const Geodetic& position, const Vector3& v_n, const Vector3& f_n, const Gravity& gravity);

}  // namespace inslab::nav
