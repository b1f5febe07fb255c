#pragma once

#include "inslab/nav/vectors.hpp"

namespace inslab::nav {

/// The angular rate, in the axes that turn, of an attitude q_0 * exp(Phi(t)): omega = J(Phi) Phi', rad/s. `Phi` in rad,
/// shorter than 2 pi. Source: J. Bortz, IEEE AES-7 (1971) 61, solved for the rate.
Vector3 rate_from_rotation_vector(const Vector3& Phi, const Vector3& Phi_rate);

/// The inverse: Phi' = J(Phi)^-1 omega, Bortz's equation. `Phi` shorter than 2 pi.
Vector3 rotation_vector_rate(const Vector3& Phi, const Vector3& omega);

}  // namespace inslab::nav
