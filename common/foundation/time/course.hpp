#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::time {

/// A quantity over sim time: straight lines between its corners, constant before the first and after the last.
/// `Value` is added, subtracted and multiplied by a number.
template <class Value>
class Course {
 public:
  struct Corner {
    double at_s;
    Value value;
  };

  /// Corners in order of time; without any the quantity is `otherwise`.
  explicit Course(std::vector<Corner> corners, Value otherwise)
      : corners_(std::move(corners)), otherwise_(std::move(otherwise)) {}

  Value at(std::int64_t sim_time_ns) const {
    if (corners_.empty()) return otherwise_;
    const double time_s = to_seconds(sim_time_ns);
    const auto next = std::upper_bound(corners_.begin(), corners_.end(), time_s,
                                       [](double t, const Corner& corner) { return t < corner.at_s; });
    if (next == corners_.begin()) return corners_.front().value;
    const Corner& last = *(next - 1);
    if (next == corners_.end()) return last.value;
    const double part = (time_s - last.at_s) / (next->at_s - last.at_s);
    return last.value + part * (next->value - last.value);
  }

 private:
  std::vector<Corner> corners_;
  Value otherwise_;
};

}  // namespace inslab::time
