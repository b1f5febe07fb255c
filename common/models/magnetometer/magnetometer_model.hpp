#pragma once

#include <cstdint>
#include <optional>

#include "inslab/data/profiles/fault_profile.hpp"
#include "inslab/data/profiles/installation_profile.hpp"
#include "inslab/data/profiles/magnetometer_error_profile.hpp"
#include "inslab/data/samples/magnetic_field.hpp"
#include "inslab/data/samples/truth_state.hpp"
#include "inslab/foundation/time/course.hpp"
#include "inslab/foundation/time/rate.hpp"
#include "inslab/models/faults/axis_faults.hpp"
#include "inslab/models/magnetometer/sensed_field.hpp"
#include "inslab/models/timing/sensor_clock.hpp"
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
  struct Setup {
    std::uint64_t seed = 0;
    std::uint32_t sensor_number = 0;
    time::Rate rate;
    MagnetometerErrorProfile errors;
    InstallationProfile installation;
  };

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
    visit(self.errors_, self.installation_, self.fault_);
    if constexpr (!std::is_const_v<Self>) self.take_profiles();
    visit(self.noise_, self.axes_, self.clock_, self.instant_, self.samples_);
  }

 private:
  void take_profiles();

  std::uint32_t sensor_number_;
  time::Rate rate_;
  SensedField field_;
  MagnetometerErrorProfile errors_;
  InstallationProfile installation_;
  FaultProfile fault_;
  Matrix3 response_ = Matrix3::Identity();  ///< I + soft iron
  time::Course<Vector3> currents_nt_{{}, Vector3::Zero()};
  random::VectorNoise noise_;
  random::VectorNoise burst_;  ///< of a fault: white alone
  faults::AxisFaults axes_;
  timing::SensorClock clock_;
  std::uint64_t instant_ = 0;  ///< the last one
  std::uint64_t samples_ = 0;
};

}  // namespace inslab::magnetometer
