#pragma once

#include "inslab/nav/strapdown.hpp"

namespace inslab::verify {

/// Root mean squares and largest values of what separates two courses of states.
struct DeviationFigures {
  double position_rms_m = 0.0;
  double position_max_m = 0.0;
  double velocity_max_m_per_s = 0.0;
  double attitude_max_rad = 0.0;
  double position_middle_third_rms_m = 0.0;
  double position_last_third_rms_m = 0.0;

  /// Whether the position's error has stopped growing: its RMS over the last third is at most 1.5 times that over the
  /// middle third.
  bool settled() const { return position_last_third_rms_m <= 1.5 * position_middle_third_rms_m; }
};

/// Gathers them, instant after instant, in constant memory.
class Deviation {
 public:
  /// `instants` will be added; they make the thirds.
  explicit Deviation(std::uint64_t instants) : instants_(instants) {}

  void add(const nav::NavState& found, const nav::NavState& expected);
  DeviationFigures figures() const;

 private:
  std::uint64_t instants_;
  std::uint64_t added_ = 0;
  double squares_m2_[3] = {0.0, 0.0, 0.0};  ///< of the position's error, by thirds
  std::uint64_t counts_[3] = {0, 0, 0};
  DeviationFigures largest_;
};

}  // namespace inslab::verify
