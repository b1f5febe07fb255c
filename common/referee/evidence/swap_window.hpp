#pragma once

#include <map>
#include <optional>

#include "inslab/data/samples/airflow_truth.hpp"
#include "inslab/data/samples/baseline_heading.hpp"
#include "inslab/data/samples/gnss_fix.hpp"
#include "inslab/data/samples/imu_truth.hpp"
#include "inslab/data/samples/magnetic_field.hpp"
#include "inslab/data/samples/truth_state.hpp"
#include "inslab/models/imu/bandwidth.hpp"
#include "inslab/models/magnetometer/sensed_field.hpp"
#include "inslab/referee/evidence/aiding_expectation.hpp"
#include "inslab/referee/evidence/log_summary.hpp"
#include "inslab/referee/evidence/noise_statistics.hpp"
#include "inslab/referee/evidence/residual_statistics.hpp"

namespace inslab::evidence {

/// The low-pass filters of one IMU, which go on from interval to interval as the model's do.
class SensorFilter {
 public:
  explicit SensorFilter(double dt_s) : gyro_({}, dt_s), accel_({}, dt_s) {}

  /// Takes the profile that the next interval is made under.
  void use(const ImuErrorProfile& profile);
  /// The sensor was moved before the next interval.
  void restart();

  /// What the filters make of an increment, rad | m/s. Each is told of every interval, in order.
  Vector3 gyro(const Vector3& dtheta) { return gyro_.is_off() ? dtheta : gyro_.filtered(dtheta); }
  Vector3 accel(const Vector3& dv) { return accel_.is_off() ? dv : accel_.filtered(dv); }

 private:
  imu::Bandwidth gyro_;
  imu::Bandwidth accel_;
};

/// What one magnetometer would show under the profiles in use without noise, hard iron and limits.
class MagneticExpectation {
 public:
  MagneticExpectation(const MagnetometerErrorProfile& errors, const InstallationProfile& installation);

  /// Along the sensor's axes, nT.
  Vector3 B_b_nt(const TruthState& vehicle) {
    return response_ * field_.B_b_nt(vehicle) + currents_nt_.at(vehicle.header.sim_time_ns);
  }

 private:
  magnetometer::SensedField field_;
  Matrix3 response_;
  time::Course<Vector3> currents_nt_;
};

/// A stretch of sim time under the same profiles of one sensor, and what its samples show.
struct SwapWindow {
  std::int64_t after_ns = 0;  ///< samples later than this
  std::int64_t until_ns = 0;  ///< and not later than this
  bool contains(std::int64_t t) const { return t > after_ns && t <= until_ns; }

  /// Notes the tag of sample `index` of a sensor beside the vehicle's truth of its time.
  void add_tag(std::uint64_t index, const StreamHeader& tagged, const StreamHeader& truth);

  /// ImuSample minus what the sensor's low-pass filter makes of the ImuTruth, as a rate.
  NoiseStatistics gyro_rad_per_s;
  NoiseStatistics accel_m_per_s2;
  ResidualStatistics gyro_residual_rad_per_s;  ///< the same, less what the motion and a drift explain
  ResidualStatistics accel_residual_m_per_s2;
  NoiseStatistics imu_arm_v_m;     ///< place of the IMU in the vehicle, from both truths
  NoiseStatistics position_ned_m;  ///< GnssFix minus the antenna's truth under the promised arm
  NoiseStatistics velocity_ned_m_per_s;
  NoiseStatistics antenna_arm_v_m;  ///< GnssFix minus the vehicle's truth, in the vehicle's axes
  NoiseStatistics magnetic_nt;      ///< MagneticField minus its MagneticExpectation
  NoiseStatistics pressure;         ///< AirPressure minus its PressureExpectation, Pa; the pressure altitude, m
  NoiseStatistics baseline_ned_m;   ///< BaselineHeading minus the true vector under the promised arms
  NoiseStatistics baseline_v_m;     ///< BaselineHeading in the vehicle's axes
  NoiseStatistics airflow;          ///< what left_of_airflow() leaves: Pa, Pa, deg
  NoiseStatistics time_tag;         ///< tag of a sample less that of the truth, s; the truth's sim time, s
  NoiseStatistics way_m;  ///< WheelTravel minus its WayExpectation in that one's direction; the expectation's size
};

/// The windows before and after an acknowledged swap.
struct SwapWindows {
  ProfileAck ack;
  const catalog::AnyProfile* profile = nullptr;
  SwapWindow before;
  SwapWindow after;
  std::optional<std::uint64_t> first_sequence_seen;  ///< of the first sample with the ack's revision
};

/// The windows of every applied swap, and the samples that go into them, in time linear in both.
class SwapWindowsOfLog {
 public:
  /// Cuts the windows: up to 20 s each way, not over another swap of the same sensor, without the fade of a vibration.
  explicit SwapWindowsOfLog(const LogSummary& summary);

  /// Puts one IMU interval, or one fix with the vehicle's truth at its time, into the windows it belongs to. Those of a
  /// sensor come in order of time.
  void add(const ImuSample& sample, const ImuTruth& imu_truth, const TruthState& vehicle);
  void add(const GnssFix& fix, const TruthState& vehicle);
  void add(const MagneticField& sample, const TruthState& vehicle);
  void add(const AirPressure& sample, const TruthState& vehicle);
  void add(const BaselineHeading& sample, const TruthState& vehicle);
  void add(const Airflow& sample, const AirflowTruth& perfect, const TruthState& vehicle);
  /// `way`: the truth of the sample's interval, from its beginning on.
  void add(const WheelTravel& sample, const std::vector<const TruthState*>& way);

  const std::vector<SwapWindows>& all() const { return all_; }

 private:
  using Sensor = std::pair<SensorKind, std::uint32_t>;
  /// What is known of a sensor while its samples pass.
  struct Passing {
    std::vector<std::size_t> windows;  ///< its own, in order of time
    std::size_t first_open = 0;        ///< those before it lie behind
    std::map<std::pair<ProfileKind, std::uint32_t>, std::size_t> by_revision;
    std::map<std::uint32_t, const ImuErrorProfile*> errors;  ///< by their numbers in the journal
    std::optional<SensorFilter> filter;
    std::optional<std::uint32_t> filter_revision;
    std::optional<MagneticExpectation> magnetic;
    std::pair<std::uint32_t, std::uint32_t> magnetic_revisions;  ///< of errors and installation
    PressureExpectation air;
    WayExpectation way;
  };

  template <class Use>
  void for_each_open(Passing& passing, std::int64_t sim_time_ns, const Use& use);
  /// Notes the first sample under each revision of a profile; `revisions` has a field of each kind's name.
  template <class Sample>
  void note_first(const Passing& passing, const Sample& sample);
  SensorFilter& filter_for(Passing& passing, const ImuSample& sample, const ImuTruth& imu_truth);

  const LogSummary& summary_;
  std::vector<SwapWindows> all_;
  std::map<Sensor, Passing> passing_;
};

}  // namespace inslab::evidence
