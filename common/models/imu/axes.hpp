#pragma once

#include <array>
#include <string>

namespace inslab::imu {

/// One process for each axis of a triad: `make(axis, root)` with axis 0 to 2 and the root of the axis's stream names,
/// such as "imu0/gyro.x/".
template <class Make>
auto per_axis(const std::string& triad, const Make& make) {
  return std::array{make(0, triad + ".x/"), make(1, triad + ".y/"), make(2, triad + ".z/")};
}

}  // namespace inslab::imu
