#include "inslab/referee/verify/deviation.hpp"

#include <algorithm>
#include <cmath>

#include "inslab/nav/attitude.hpp"

namespace inslab::verify {

void Deviation::add(const nav::NavState& found, const nav::NavState& expected) {
  const double position_m = nav::ned_from(expected.position, found.position).norm();
  const std::uint64_t third = std::min<std::uint64_t>(2, 3 * added_ / instants_);
  squares_m2_[third] += position_m * position_m;
  ++counts_[third];
  ++added_;
  largest_.position_max_m = std::max(largest_.position_max_m, position_m);
  largest_.velocity_max_m_per_s = std::max(largest_.velocity_max_m_per_s, (found.v_n - expected.v_n).norm());
  largest_.attitude_max_rad = std::max(largest_.attitude_max_rad, nav::angle_between(found.q_nb, expected.q_nb));
}

DeviationFigures Deviation::figures() const {
  const auto rms = [](double squares, std::uint64_t count) {
    return count == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(count));
  };
  DeviationFigures figures = largest_;
  figures.position_rms_m = rms(squares_m2_[0] + squares_m2_[1] + squares_m2_[2], added_);
  figures.position_middle_third_rms_m = rms(squares_m2_[1], counts_[1]);
  figures.position_last_third_rms_m = rms(squares_m2_[2], counts_[2]);
  return figures;
}

}  // namespace inslab::verify
