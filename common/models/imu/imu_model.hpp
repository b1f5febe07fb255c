#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "inslab/data/profiles/fault_profile.hpp"
#include "inslab/data/samples/imu_truth.hpp"
#include "inslab/data/samples/truth_state.hpp"
#include "inslab/foundation/time/rate.hpp"
#include "inslab/models/imu/dropped_samples.hpp"
#include "inslab/models/imu/felt_motion.hpp"
#include "inslab/models/imu/g_sensitivity.hpp"
#include "inslab/models/imu/installation.hpp"
#include "inslab/models/imu/motion_response.hpp"
#include "inslab/models/imu/recorded_signal.hpp"
#include "inslab/models/imu/rectification.hpp"
#include "inslab/models/imu/sample_interval.hpp"
#include "inslab/models/imu/second_order_drift.hpp"
#include "inslab/models/imu/size_effect.hpp"
#include "inslab/models/imu/temperature.hpp"
#include "inslab/models/imu/thermal_bias.hpp"
#include "inslab/models/imu/triad_errors.hpp"
#include "inslab/models/imu/triad_limits.hpp"
#include "inslab/models/imu/vibration.hpp"
#include "inslab/models/timing/sensor_clock.hpp"
#include "inslab/nav/gravity.hpp"

namespace inslab::imu {

/// One IMU: from the vehicle's truth to what the IMU puts out, with the perfect IMU and the error budget beside it.
///
/// Same setup, profiles and truth: the same bits. A value type: a copy goes on as the original does.
class ImuModel {
 public:
  struct Setup {
    std::uint64_t seed = 0;
    std::uint32_t sensor_number = 0;
    time::Rate imu_rate;
    nav::Gravity gravity;
    ImuErrorProfile errors;
    VibrationProfile vibration;
    InstallationProfile installation;
    time::Nanoseconds end{0};      ///< sim time of the last sample: recordings must reach to there
    RecordingFinder recordings{};  ///< of errors that a profile may name; empty: there are none
  };
  struct Output {
    Output() {}  // spelt out, or std::optional would clear the kilobyte before the members set themselves
    ImuSample sample;
    ImuTruth truth;
  };

  /// Throws std::invalid_argument when a profile breaks a rule of data/catalog/profile_rules.hpp, or names a recording
  /// that is not there or too short.
  explicit ImuModel(const Setup& setup);

  /// Swaps a profile from the next interval of the IMU on, in the order of the calls; samples from there carry its
  /// journal number. Throws std::invalid_argument when it breaks a rule, and then changes nothing. What `continuity`
  /// does is in Bias::retune and TriadLimits::retune, what `fade_s` does in Vibration. A new installation relocates the
  /// IMU between two intervals: the next one begins at the new place, moving as it does there, and is marked as a
  /// discontinuity; so does a moving mount that begins or ends without a fade.
  void apply(const ImuErrorProfile& profile);
  void apply(const VibrationProfile& profile);
  void apply(const InstallationProfile& profile);
  void apply(const FaultProfile& profile);

  /// The IMU's interval that ends at `truth`; nothing at the first truth sample that lies on the IMU's grid (it only
  /// says where the first interval begins) and between two samples of a slower IMU. Sequence number and random draws
  /// follow from sim time. Throws std::invalid_argument when `truth` does not continue the one before, or leaves out an
  /// instant of the IMU; the model is then as it was.
  std::optional<Output> measure(const TruthState& truth);

  /// What a model of the same setup needs to go on from here (data/state/state_stream.hpp).
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.errors_, self.installation_profile_, self.fault_);
    if constexpr (!std::is_const_v<Self>) self.use_profiles();
    visit(self.vibration_, self.gyro_, self.accel_, self.gyro_thermal_, self.accel_thermal_, self.gyro_limits_,
          self.accel_limits_, self.previous_, self.perfect_, self.size_effect_dv_, self.gyro_motion_,
          self.accel_motion_, self.clock_, self.discontinuity_, self.revisions_, self.pending_);
    if constexpr (!std::is_const_v<Self>) self.find_start();
  }

 private:
  using Profile = std::variant<ImuErrorProfile, VibrationProfile, InstallationProfile, FaultProfile>;

  void use_profiles();
  void find_start();
  void tune(const ImuErrorProfile& profile, Continuity continuity, std::uint64_t k);
  void use_responses(const TriadParameters& gyro, const TriadParameters& accel, double accel_delay_s);
  void find_interval(std::int64_t from_ns);
  void begin_interval();
  void take(const ImuErrorProfile& profile, std::uint64_t k);
  void take(const VibrationProfile& profile, std::uint64_t k);
  void take(const InstallationProfile& profile, std::uint64_t k);
  void take(const FaultProfile& profile, std::uint64_t k);
  void relocated();
  Increments perfect_increments(const TruthState& truth, const Installation::Instant& end) const;
  void follow_motion(const TruthState& truth, const Installation::Instant& end, const Increments& perfect);
  void follow_mounted(const TruthState& truth, const Installation::Instant& end, const Increments& perfect);
  Increments felt_motion();
  struct Within {
    WithinInterval gyro;
    WithinInterval accel;
  };
  Within within_interval(const Increments& felt, double temperature_deg_c);
  std::optional<Output> end_interval(const TruthState& truth);
  void set_pose(const TruthState& truth, ImuTruth& perfect) const;
  void set_errors(const Increments& felt, const Increments& vibration, double temperature_deg_c, ImuTruth& perfect);
  void add_second_order(const Increments& felt, const Increments& vibration, ImuTruth& perfect);
  void add_thermal(double temperature_deg_c, ImuTruth& perfect);
  void set_output(Output& out, const Within* within);

  std::uint32_t sensor_number_;
  time::Rate rate_;
  nav::Gravity gravity_;

  ImuErrorProfile errors_;  ///< in use, as the two others
  InstallationProfile installation_profile_;
  FaultProfile fault_;
  Installation installation_;
  Vibration vibration_;
  Temperature temperature_;
  TriadErrors gyro_;
  TriadErrors accel_;
  GSensitivity g_sensitivity_;
  SecondOrderDrift second_order_drift_;
  ThermalBias gyro_thermal_;
  ThermalBias accel_thermal_;
  Rectification rectification_;
  SizeEffect size_effect_;
  TriadLimits gyro_limits_;
  TriadLimits accel_limits_;
  DroppedSamples drops_;
  RecordedSignal::Run recording_run_;
  RecordedSignal recorded_;
  timing::SensorClock clock_;
  std::int64_t latency_ns_;

  std::int64_t from_ns_ = 0;  ///< the interval that is open, or that begins at `previous_`
  std::int64_t to_ns_ = 0;
  SampleInterval interval_;
  std::optional<TruthState> previous_;
  Installation::Instant start_;               ///< at `previous_`, under the present installation
  Increments perfect_;                        ///< of the interval that is open
  Vector3 size_effect_dv_ = Vector3::Zero();  ///< of the same
  Vibration::Bandwidths bandwidths_;
  bool is_filtered_ = false;
  bool is_followed_ = false;  ///< filtered, late, or with a size effect
  FeltMotion gyro_motion_;    ///< over the interval that is open
  FeltMotion accel_motion_;
  bool discontinuity_ = false;
  ImuRevisions revisions_;
  std::vector<Profile> pending_;
};

}  // namespace inslab::imu
