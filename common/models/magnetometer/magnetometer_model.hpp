#pragma once

#include <optional>

#include "inslab/data/samples/magnetic_field.hpp"
#include "inslab/foundation/time/course.hpp"
#include "inslab/models/faults/axis_faults.hpp"
#include "inslab/models/magnetometer/sensed_field.hpp"
#include "inslab/models/sensing/instrument.hpp"
#include "inslab/noise/random/vector_noise.hpp"

namespace inslab::magnetometer {

/// One magnetometer of three axes, strapped to the vehicle.
///
/// Sample k is at instant k of its rate, k >= 1, and shows that instant:
///
///   B_b = (I + soft iron) C_bn (Earth + bodies beside the way) + hard iron + currents + white + Gauss-Markov
///
/// then the jump and burst of a fault, full scale, counts, faults of single axes. The Earth is the World Magnetic Model
/// 2025 at the date of sim time 0 and the sensor's place. Draws depend on (seed, sensor number, k) alone. Source of the
/// terms: IEEE Std 2700-2017, clause 8; D. Gebre-Egziabher et al., Calibration of strapdown magnetometers in magnetic
/// field domain, J. Aerosp. Eng. 19(2) (2006), (1).
class MagnetometerModel {
 public:
  using Setup = sensing::Setup<catalog::Magnetometer>;

  /// Throws std::invalid_argument when a profile breaks a rule of data/catalog/profile_rules.hpp.
  explicit MagnetometerModel(const Setup& setup);

  /// Swaps a profile from the next sample on. Throws std::invalid_argument when it breaks a rule, and then changes
  /// nothing.
  void apply(const MagnetometerErrorProfile& profile);
  void apply(const InstallationProfile& profile);
  void apply(const FaultProfile& profile);

  /// The sample at `truth`'s time; nothing between the instants, at t = 0 and while a fault silences the sensor. Truth
  /// comes in order, and every instant's among it. Samples are numbered from 0 without gaps.
  std::optional<MagneticField> observe(const TruthState& truth);

  /// What a model of the same setup needs to go on from here (data/state/state_stream.hpp).
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.instrument_);
    if constexpr (!std::is_const_v<Self>) self.take_profiles();
    visit(self.noise_, self.axes_);
  }

 private:
  void take_profiles();

  sensing::Instrument<catalog::Magnetometer> instrument_;
  SensedField field_;
  Matrix3 response_ = Matrix3::Identity();  ///< I + soft iron
  time::Course<Vector3> currents_nt_{{}, Vector3::Zero()};
  random::VectorNoise noise_;
  random::VectorNoise burst_;  ///< of a fault: white alone
  faults::AxisFaults axes_;
};

}  // namespace inslab::magnetometer
