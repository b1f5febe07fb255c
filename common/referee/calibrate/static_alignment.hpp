#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "inslab/nav/alignment.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/referee/calibrate/yaw_uncertainty.hpp"

/// Static coarse alignment of a whole recording: the lab report.
namespace inslab::calibrate {

/// Spread of many solutions of one attitude.
struct Spread {
  std::uint64_t count = 0;
  nav::Vector3 mean_rad = nav::Vector3::Zero();   ///< roll, pitch, yaw
  nav::Vector3 sigma_rad = nav::Vector3::Zero();  ///< standard deviations about the mean
};

struct AlignmentResult {
  std::uint64_t samples = 0;
  std::optional<nav::RollPitchYaw> whole;           ///< of the middle of the whole span; without its tilt's trend
  std::string refusal;                              ///< why there is none
  Spread epochs;                                    ///< one solution a sample
  Spread seconds;                                   ///< one solution a whole second
  std::vector<nav::RollPitchYaw> each_second;       ///< those solutions
  std::optional<TiltTrend> tilt;                    ///< of ten seconds and more
  double yaw_with_tilt_rad = 0.0;                   ///< of the whole span with its tilt's trend left in
  nav::Vector3 tilt_rate_n = nav::Vector3::Zero();  ///< the trend in n, rad/s
  std::optional<YawUncertainty> yaw;                ///< of the whole span
};

/// Takes the increments of an IMU at rest one after the other; memory grows with the seconds only.
///
/// The limits on rate and force are for the whole span: single samples are noisier than any of them.
class StaticAlignment {
 public:
  /// `dt_s` of each sample; `gravity_m_per_s2` at the site; `gyro_bias_rad_per_s`: standard deviation, if it is known.
  /// Throws std::invalid_argument when dt_s is not positive.
  StaticAlignment(double dt_s, double latitude_rad, double gravity_m_per_s2, const nav::AlignmentLimits& limits,
                  std::optional<double> gyro_bias_rad_per_s = std::nullopt);

  void add(const nav::Vector3& dtheta_b, const nav::Vector3& dv_b);

  AlignmentResult result() const;

 private:
  /// Sums of angles less a reference, so that yaw near north does not jump.
  struct Sums {
    std::uint64_t count = 0;
    nav::Vector3 sum = nav::Vector3::Zero();
    nav::Vector3 squares = nav::Vector3::Zero();
  };

  std::optional<nav::RollPitchYaw> solve(const nav::Vector3& dtheta_b, const nav::Vector3& dv_b, double span_s) const;
  void add_to(Sums& sums, const nav::RollPitchYaw& rpy) const;
  Spread spread_of(const Sums& sums) const;
  void end_second();
  void align_whole(nav::StaticMeans means, AlignmentResult& result) const;

  double dt_s_;
  double latitude_rad_;
  double gravity_m_per_s2_;
  nav::AlignmentLimits limits_;
  std::optional<double> gyro_bias_rad_per_s_;
  std::uint64_t samples_per_second_;

  std::uint64_t samples_ = 0;
  nav::Vector3 dtheta_sum_ = nav::Vector3::Zero();
  nav::Vector3 dv_sum_ = nav::Vector3::Zero();
  nav::Vector3 f_first_ = nav::Vector3::Zero();
  nav::Vector3 f_squares_ = nav::Vector3::Zero();  ///< of differences from the first
  nav::Vector3 f_sum_ = nav::Vector3::Zero();      ///< the same
  nav::Vector3 second_dtheta_ = nav::Vector3::Zero();
  nav::Vector3 second_dv_ = nav::Vector3::Zero();
  std::vector<nav::RollPitchYaw> waiting_;  ///< solutions of samples before there is a reference
  std::optional<nav::Vector3> reference_rad_;
  Sums epochs_;
  Sums seconds_;
  std::vector<nav::RollPitchYaw> each_second_;
  std::vector<SecondMeans> seconds_means_;
};

}  // namespace inslab::calibrate
