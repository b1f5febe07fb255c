#pragma once

#include "inslab/data/profiles/installation_profile.hpp"
#include "inslab/data/samples/truth_state.hpp"

namespace inslab::odometer {

/// What a wheel's contact point does over an interval of the truth.
struct Rolled {
  double along_m = 0.0;            ///< way along the wheel, below 0 backwards
  double force_along_m_s2 = 0.0;   ///< mean specific force of the vehicle along the wheel: what its tyres pass on
  double force_across_m_s2 = 0.0;  ///< the same across, to the right
  double dt_s = 0.0;
};

/// The contact point of a wheel, l from the vehicle's reference point, rolling along axis x of its mounting:
///
///   along = e . integral of (C_vn v_n + omega_ev x l)
///
/// P. Groves, Principles of GNSS, Inertial, and Multisensor Integrated Navigation Systems, 2nd ed. (2013), (6.32).
/// The integral of omega_iv is the truth's own and exact. That of C_vn v_n is Simpson's, with the velocity in the
/// middle from the way between both positions and the attitude there from both rates: the ways of all intervals add up
/// to the true one within 1e-3 (omega dt)^4 of its length.
class WheelContact {
 public:
  void use(const InstallationProfile& installation);

  /// The interval that ends at `end`, which begins at `start`.
  Rolled over(const TruthState& start, const TruthState& end) const;

 private:
  Vector3 contact_v_m_ = Vector3::Zero();
  Vector3 along_v_ = Vector3::UnitX();
  Vector3 across_v_ = Vector3::UnitY();
};

}  // namespace inslab::odometer
