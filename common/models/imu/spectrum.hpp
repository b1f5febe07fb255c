#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "inslab/data/profiles/vibration_profile.hpp"
#include "inslab/foundation/units/units.hpp"

namespace inslab::imu {

/// One-sided power spectral density of three axes, (m/s^2)^2/Hz or (rad/s)^2/Hz: between two corners a straight line of
/// the logarithms, or of the densities themselves where one of them is 0; outside the corners 0.
class Spectrum {
 public:
  explicit Spectrum(const std::vector<LinearRandomPoint>& table) {
    for (const auto& point : table) corners_.push_back({point.frequency_hz, point.density_m2_per_s3});
  }
  explicit Spectrum(const std::vector<AngularRandomPoint>& table) {
    for (const auto& point : table) {
      corners_.push_back({point.frequency_hz, point.density_deg2_per_s * (units::kDeg * units::kDeg)});
    }
  }

  bool empty() const { return corners_.empty(); }
  double lowest_hz() const { return corners_.front().frequency_hz; }
  double highest_hz() const { return corners_.back().frequency_hz; }
  std::size_t corners() const { return corners_.size(); }
  double corner_hz(std::size_t i) const { return corners_[i].frequency_hz; }

  double density(int axis, double frequency_hz) const {
    if (empty() || frequency_hz < lowest_hz() || frequency_hz > highest_hz()) return 0.0;
    const auto above = std::find_if(corners_.begin() + 1, corners_.end() - 1, [frequency_hz](const Corner& corner) {
      return frequency_hz <= corner.frequency_hz;
    });
    const Corner& a = *(above - 1);
    const Corner& b = *above;
    const double from = a.density[axis], to = b.density[axis];
    if (from == 0.0 || to == 0.0) {
      return from + (to - from) * (frequency_hz - a.frequency_hz) / (b.frequency_hz - a.frequency_hz);
    }
    const double part = std::log(frequency_hz / a.frequency_hz) / std::log(b.frequency_hz / a.frequency_hz);
    return from * std::pow(to / from, part);
  }

 private:
  struct Corner {
    double frequency_hz;
    Vector3 density;
  };
  std::vector<Corner> corners_;
};

}  // namespace inslab::imu
