#pragma once

#include <array>
#include <optional>
#include <vector>

#include "random/stream.hpp"
#include "samples/fault_profile.hpp"
#include "samples/gnss_error_profile.hpp"
#include "samples/installation_profile.hpp"
#include "samples/truth_state.hpp"
#include "time/rate.hpp"

namespace inslab::gnss {

/// A stretch of sim time without fixes: start_s <= t < start_s + duration_s.
struct Outage {
  double start_s = 0.0;
  double duration_s = 0.0;
};

/// One GNSS receiver that reports position and velocity of its antenna.
///
/// Epoch k is at k periods of sim time, k >= 1. The antenna's true state comes from samples/sensor_site.hpp; position
/// errors (white, in NED metres at the antenna) are applied exactly through ECEF, velocity errors added in the
/// antenna's NED. Errors of epoch k depend on (seed, sensor number, k) and the active profile alone: an outage, a swap
/// or a restart changes no other epoch's draws. Source: thesis 3.4; (3-47)..(3-51) to first order.
class GnssModel {
 public:
  struct Setup {
    std::uint64_t seed = 0;
    std::uint32_t sensor_number = 0;
    time::Rate truth_rate;
    time::Rate gnss_rate;
    GnssErrorProfile errors;
    InstallationProfile installation;
    std::vector<Outage> outages;
  };

  /// Throws std::invalid_argument when a profile breaks a rule of samples/profile_rules.hpp, when an outage is negative
  /// or not finite, or when the GNSS period is not a multiple of the truth's.
  explicit GnssModel(const Setup& setup);

  /// Swaps a profile from the next epoch on. Throws std::invalid_argument when it breaks a rule, and then changes
  /// nothing.
  void apply(const GnssErrorProfile& profile);
  void apply(const InstallationProfile& profile);
  void apply(const FaultProfile& profile);

  /// The fix of the epoch at `truth`'s time; nothing between epochs, at t = 0 and in outages. Fixes are numbered from 0
  /// without gaps.
  std::optional<GnssFix> observe(const TruthState& truth);

 private:
  struct OutageSpan {
    std::int64_t start_ns;
    std::int64_t end_ns;
  };

  bool in_outage(std::int64_t time_ns) const;
  static Vector3 draw(std::array<random::NormalCursor, 3>& numbers, const Vector3& sigma, std::uint64_t epoch);

  std::uint32_t sensor_number_;
  std::int64_t period_ns_;
  GnssErrorProfile errors_;
  InstallationProfile installation_;
  FaultProfile fault_;
  std::vector<OutageSpan> outages_;
  std::array<random::NormalCursor, 3> position_noise_;
  std::array<random::NormalCursor, 3> velocity_noise_;
  std::uint64_t fixes_ = 0;
};

}  // namespace inslab::gnss
