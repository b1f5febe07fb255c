#pragma once

#include <cmath>
#include <cstdint>

#include "inslab/data/profiles/heading_error_profile.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/noise/random/stream.hpp"

namespace inslab::heading {

/// When carrier phases are fixed to wrong whole numbers, and by how much the baseline is then off.
///
/// While the receiver's best solution is right, a wrong fix begins in an interval of length dt with the probability
/// 1 - exp(-dt/mean), a Poisson process; it stays the same until it has lasted its time, or the solution is another
/// one. Its direction is uniform on the sphere. Both draws depend on (stream, k) alone.
class WrongFixes {
 public:
  WrongFixes(const random::Stream& root, double period_s)
      : period_s_(period_s), begins_(root.child("/begins")), directions_(root.child("/direction")) {}

  /// Takes another profile between two samples; a wrong fix that is on stays as it is.
  void retune(const HeadingErrorProfile& profile) {
    const double mean_s = profile.mean_time_between_wrong_fixes_s;
    probability_ = mean_s > 0.0 ? -std::expm1(-period_s_ / mean_s) : 0.0;
    lasts_ns_ = time::from_seconds(profile.wrong_fix_lasts_s).count();
    offset_m_ = profile.wrong_fix_offset_m;
  }
  /// The wrong fix that is on ends.
  void reset() { until_ns_ = 0; }
  void redraw(std::uint64_t) { reset(); }

  /// The offset of sample `k` at sim time `time_ns`, NED, m; 0 while the fix is right. Samples come in order, each
  /// once.
  Vector3 advance(std::uint64_t k, std::int64_t time_ns, bool is_best) {
    if (!is_best) until_ns_ = 0;
    if (time_ns < until_ns_) return offset_ned_m_;
    if (!is_best || probability_ == 0.0 || !(begins_.uniform(k) < probability_)) return Vector3::Zero();
    until_ns_ = time_ns + lasts_ns_;
    if (lasts_ns_ == 0) return Vector3::Zero();
    const double down = 2.0 * directions_.uniform(2 * k) - 1.0;
    const double azimuth_rad = 2.0 * units::kPi * directions_.uniform(2 * k + 1);
    const double level = std::sqrt(1.0 - down * down);
    offset_ned_m_ = offset_m_ * Vector3(level * std::cos(azimuth_rad), level * std::sin(azimuth_rad), down);
    return offset_ned_m_;
  }

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.until_ns_, self.offset_ned_m_);
  }

 private:
  double period_s_;
  random::Stream begins_;
  random::Stream directions_;
  double probability_ = 0.0;
  std::int64_t lasts_ns_ = 0;
  double offset_m_ = 0.0;
  std::int64_t until_ns_ = 0;  ///< the last one ends here
  Vector3 offset_ned_m_ = Vector3::Zero();
};

}  // namespace inslab::heading
