#pragma once

#include <optional>
#include <vector>

#include "inslab/data/profiles/fault_profile.hpp"
#include "inslab/data/profiles/gnss_error_profile.hpp"
#include "inslab/data/profiles/installation_profile.hpp"
#include "inslab/data/samples/sensor_site.hpp"
#include "inslab/foundation/time/rate.hpp"
#include "inslab/models/gnss/constellation.hpp"
#include "inslab/models/gnss/outage_schedule.hpp"
#include "inslab/models/gnss/pulse_generator.hpp"
#include "inslab/models/gnss/recorded_fixes.hpp"
#include "inslab/models/gnss/solution_ladder.hpp"
#include "inslab/models/timing/sensor_clock.hpp"
#include "inslab/noise/random/vector_noise.hpp"

namespace inslab::gnss {

/// One GNSS receiver that reports position and velocity of its antenna.
///
/// Epoch k is at instant k of its rate, k >= 1. The antenna's true state comes from data/samples/sensor_site.hpp;
/// position errors in NED metres at the antenna are applied exactly through ECEF, velocity errors added in the
/// antenna's NED. Their draws depend on (seed, sensor number, k) alone: an outage, a swap or another kind of solution
/// changes no other epoch's. There is no fix in an outage, with fewer than four satellites of the profile's model above
/// its mask, on a rung of the ladder without one, and where a recording that the profile names has none. A recording's
/// errors are added to the others, its claims to theirs, and its fix type is the fix's. Its pulse per second, when the
/// profile has one, is in pulse_generator.hpp. Source: thesis 3.4;
/// (3-47)..(3-51) to first order.
class GnssModel {
 public:
  struct Setup {
    std::uint64_t seed = 0;
    std::uint32_t sensor_number = 0;
    time::Rate gnss_rate;
    GnssErrorProfile errors;
    InstallationProfile installation;
    std::vector<Outage> outages;
    std::vector<OutageArea> outage_areas;
    time::Nanoseconds end{0};         ///< sim time of the last sample: recordings must reach to there
    FixRecordingFinder recordings{};  ///< of errors that a profile may name; empty: there are none
  };

  /// Throws std::invalid_argument when a profile breaks a rule of data/catalog/profile_rules.hpp or names a recording
  /// that is not there or too short, and as OutageSchedule does.
  explicit GnssModel(const Setup& setup);

  /// Swaps a profile from the next epoch on. Throws std::invalid_argument when it breaks a rule, and then changes
  /// nothing.
  void apply(const GnssErrorProfile& profile);
  void apply(const InstallationProfile& profile);
  void apply(const FaultProfile& profile);

  /// The fix of the epoch at `truth`'s time; nothing between epochs, at t = 0 and without a solution. Truth samples
  /// come in order, and every epoch's among them. Fixes are numbered from 0 without gaps.
  std::optional<GnssFix> observe(const TruthState& truth);

  /// The pulse that has risen since the truth sample before; asked for before observe() of the same sample, each once.
  /// Its number is left 0.
  std::optional<Pulse> pulse(const TruthState& truth);

  /// What a model of the same setup needs to go on from here (data/state/state_stream.hpp).
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.errors_, self.installation_, self.fault_);
    if constexpr (!std::is_const_v<Self>) {
      self.ladder_.retune(self.errors_, Continuity::Reset);
      self.recorded_ = RecordedFixes(self.errors_.recorded_error, self.recording_run_);
      self.clock_.use(self.errors_.time_tag);
      self.take_fault();
      self.pulses_.use(self.errors_.pps);
    }
    visit(self.ladder_, self.position_noise_, self.velocity_noise_, self.clock_, self.rung_, self.epoch_, self.fixes_,
          self.pulses_);
    if constexpr (!std::is_const_v<Self>) self.take_errors_of(self.rung_);
  }

 private:
  /// Satellites and DOPs: stated by the profile, or from its constellation.
  Geometry geometry(const TruthState& truth, const SensorSite& antenna) const;
  const SolutionErrors& errors_on(std::size_t rung) const;
  FixType fix_type_on(std::size_t rung) const;
  void take_errors_of(std::size_t rung);
  void take_fault();
  GnssRevisions revisions() const;
  std::optional<GnssFix> fix_of_epoch(const TruthState& truth);
  Vector3 drift_ned_m(std::int64_t time_ns) const;

  std::uint32_t sensor_number_;
  time::Rate rate_;
  GnssErrorProfile errors_;
  InstallationProfile installation_;
  FaultProfile fault_;
  OutageSchedule outages_;
  SolutionLadder ladder_;
  random::VectorNoise position_noise_;
  random::VectorNoise velocity_noise_;
  random::VectorNoise position_burst_;  ///< of a fault
  RecordedFixes::Run recording_run_;
  RecordedFixes recorded_;
  timing::SensorClock clock_;
  PulseGenerator pulses_;
  std::size_t rung_ = 0;     ///< whose errors the noise has
  std::uint64_t epoch_ = 0;  ///< the last one
  std::uint64_t fixes_ = 0;
};

}  // namespace inslab::gnss
