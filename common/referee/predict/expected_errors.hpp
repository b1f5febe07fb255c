#pragma once

#include <optional>
#include <string>
#include <vector>

#include "inslab/data/catalog/any_profile.hpp"
#include "inslab/data/samples/gnss_fix.hpp"
#include "inslab/referee/predict/error_growth.hpp"

namespace inslab::predict {

/// The errors to expect of a navigation app over a run: those of the best linear filter that is told every profile.
///
/// Between fixes they grow as free inertial navigation does, with the terms of the IMU profile in use; fixes bound
/// them, each taken in at its own time of validity with the errors that the receiver's profile gives its kind of
/// solution. Where the antenna is, is known. IMU samples and fixes come in order of sim time.
class ExpectedErrors {
 public:
  struct Setup {
    nav::Gravity gravity;
    std::uint32_t imu_number = 0;
    std::optional<std::uint32_t> gnss_number;  ///< nothing: free inertial navigation
    PredictedError start;                      ///< what comes before its time is passed over
    Vertical vertical = Vertical::Free;
    double step_s = 0.2;
    std::optional<GravityErrors> gravity_errors = std::nullopt;  ///< nothing: gravity's departure is left out
  };

  /// `profiles`: those that the run begins with, then its journal, each for samples after its request's `apply_at_ns`.
  ExpectedErrors(const Setup& setup, std::vector<catalog::AnyProfile> profiles);

  void add(const ImuTruth& truth);
  void add(const GnssFix& fix);

  /// The start, and the end of every step and fix.
  const std::vector<PredictedError>& curve() const { return curve_; }

  /// What the profiles ask for that has no part in this, by name.
  std::vector<std::string> left_out() const;

 private:
  void use_profiles(std::int64_t sim_time_ns);
  Vector3 lever_arm_b_m() const;

  Setup setup_;
  SensorAddress imu_;
  std::optional<SensorAddress> gnss_;
  std::vector<catalog::AnyProfile> profiles_;  ///< by the time from which on they hold
  std::size_t next_ = 0;
  ImuErrorProfile errors_;
  GnssErrorProfile fix_errors_;
  InstallationProfile imu_place_;
  InstallationProfile antenna_place_;
  std::optional<ErrorGrowth> growth_;
  std::vector<PredictedError> curve_;
};

}  // namespace inslab::predict
