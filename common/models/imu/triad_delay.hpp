#pragma once

#include <cstdint>
#include <vector>

#include "inslab/models/imu/motion_stretch.hpp"

namespace inslab::imu {

/// Stage 2b: a triad that is late against the other one, as by the filters and the order of conversion within a set.
/// What it puts out for (from, to] is what it felt over (from - delay, to - delay]: the integral of the true motion
/// over the shifted window, exactly, of stretches cut where the window begins and ends.
///
/// Before the first stretch that it was given the triad is taken to have felt what it began with: at the scenario's
/// start, when a delay is swapped in, and after a relocation. A delay that is swapped for another makes the window
/// jump.
class TriadDelay {
 public:
  /// The longest delay, to which the profile's limits hold.
  static constexpr std::int64_t kLongestNs = 5000000;

  bool is_off() const { return delay_ns_ == 0; }
  std::int64_t delay_ns() const { return delay_ns_; }

  /// Takes another delay between two intervals, 0 to kLongestNs.
  void retune(std::int64_t delay_ns) {
    delay_ns_ = delay_ns;
    if (is_off()) forget();
  }
  /// The sensor is somewhere else from the next stretch on.
  void forget() { felt_.clear(); }

  /// The next stretch of the motion, which begins where the one before ended.
  void add(const MotionStretch& stretch) { felt_.push_back(stretch); }

  /// What is felt late of (from_ns, to_ns], in order, to `visit(stretch)`; the motion up to `to_ns` has been added.
  template <class Visit>
  void late(std::int64_t from_ns, std::int64_t to_ns, const Visit& visit) {
    const std::int64_t begin_ns = from_ns - delay_ns_, end_ns = to_ns - delay_ns_;
    const MotionStretch& first = felt_.front();
    if (begin_ns < first.from_ns) {
      const Vector3 before = first.course.at(-1.0);
      visit(MotionStretch{begin_ns, std::min(end_ns, first.from_ns), {before, Vector3::Zero(), Vector3::Zero()}});
    }
    for (const MotionStretch& stretch : felt_) {
      if (stretch.to_ns > begin_ns && stretch.from_ns < end_ns) visit(stretch.part(begin_ns, end_ns));
    }
    // Kept as far back as the longest delay that may be swapped in.
    const auto is_needed = [to_ns](const MotionStretch& stretch) { return stretch.to_ns > to_ns - kLongestNs; };
    felt_.erase(felt_.begin(), std::find_if(felt_.begin(), felt_.end() - 1, is_needed));
  }

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.felt_);
  }

 private:
  std::int64_t delay_ns_ = 0;
  std::vector<MotionStretch> felt_;
};

}  // namespace inslab::imu
