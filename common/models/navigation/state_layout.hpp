#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string_view>

#include "inslab/models/navigation/parameters.hpp"

namespace inslab::navigation {

/// What the filter's state is made of, in its order: blocks of errors, each the estimate less the truth. The first
/// three are always there; of the others the parameters choose (`states`). A new one is a line here and in kBlocks, a
/// key of EstimatedErrors, and what it does by itself in processes.cpp.
enum class StateBlock : std::uint8_t {
  Position,    ///< m, north east down
  Velocity,    ///< m/s, n
  Attitude,    ///< phi, rad, n: the computed C_nb is (I - [phi x]) C_nb
  GyroBias,    ///< rad/s, b
  AccelBias,   ///< m/s^2, b
  GyroScale,   ///< 1, b
  AccelScale,  ///< 1, b
  HardIron,    ///< nT, along the magnetometer's axes
  SoftIronX,   ///< 1, the first row of what the magnetometer's response is besides the identity
  SoftIronY,
  SoftIronZ,
  EarthField,     ///< nT, n: of the World Magnetic Model
  PressureBias,   ///< m of pressure altitude: constant, the weather's drift, the sensor's
  PressureSlope,  ///< 1: of heights, and the share of the dynamic pressure that the port shows
  WheelScale,     ///< 1, of an odometer: constant and drift
  OtherWheelScale,
  WheelAxis,      ///< rad, pitch and yaw of the wheel against what the filter is told
  BaselineDrift,  ///< m, n: of the second antenna of a two-antenna heading relative to the first
  Gravity,        ///< m/s^2, n: what is added to the model's, of nav/gravity_along_way.hpp the x
  GravityChange,  ///< m/s^2, n: the h of it
};

struct BlockFacts {
  std::string_view name;
  Eigen::Index size;  ///< errors
};
inline constexpr std::array<BlockFacts, 20> kBlocks{{{"position", 3},
                                                     {"velocity", 3},
                                                     {"attitude", 3},
                                                     {"gyro_bias", 3},
                                                     {"accel_bias", 3},
                                                     {"gyro_scale_factor", 3},
                                                     {"accel_scale_factor", 3},
                                                     {"hard_iron", 3},
                                                     {"soft_iron_x", 3},
                                                     {"soft_iron_y", 3},
                                                     {"soft_iron_z", 3},
                                                     {"earth_field", 3},
                                                     {"pressure_bias", 3},
                                                     {"pressure_slope", 2},
                                                     {"wheel_scale", 2},
                                                     {"other_wheel_scale", 2},
                                                     {"wheel_axis", 2},
                                                     {"baseline_drift", 3},
                                                     {"gravity", 3},
                                                     {"gravity_change", 3}}};
inline constexpr std::array kSoftIron{StateBlock::SoftIronX, StateBlock::SoftIronY, StateBlock::SoftIronZ};
inline constexpr std::size_t kFirstChosenBlock = 3;
inline constexpr Eigen::Index kLargestBlock = 3;

inline constexpr Eigen::Index size_of(StateBlock block) { return kBlocks[static_cast<std::size_t>(block)].size; }

namespace detail {
constexpr Eigen::Index size_of_blocks(std::size_t from, std::size_t to) {
  Eigen::Index size = 0;
  for (std::size_t i = from; i < to; ++i) size += kBlocks[i].size;
  return size;
}
}  // namespace detail

/// Of the blocks that are always there, which stand first: at 0, 3 and 6.
inline constexpr Eigen::Index kNavStates = detail::size_of_blocks(0, kFirstChosenBlock);
inline constexpr Eigen::Index kPosition = 0, kVelocity = 3, kAttitude = 6;
/// Of the others, if all are chosen. No state is larger, so none of these allocates.
inline constexpr Eigen::Index kMaxChosenStates = detail::size_of_blocks(kFirstChosenBlock, kBlocks.size());
inline constexpr Eigen::Index kMaxStates = kNavStates + kMaxChosenStates;

using StateVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxStates, 1>;
using StateMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxStates, kMaxStates>;

/// Which blocks there are, and where each begins: those that the parameters leave out take no place.
class StateLayout {
 public:
  explicit StateLayout(const EstimatedErrors& chosen) {
    const bool is_there[] = {true,
                             true,
                             true,
                             chosen.gyro_bias,
                             chosen.accel_bias,
                             chosen.gyro_scale_factor,
                             chosen.accel_scale_factor,
                             chosen.hard_iron,
                             chosen.soft_iron,
                             chosen.soft_iron,
                             chosen.soft_iron,
                             chosen.earth_field,
                             chosen.pressure_bias,
                             chosen.pressure_slope,
                             chosen.wheel_scale,
                             chosen.other_wheel_scale,
                             chosen.wheel_axis,
                             chosen.baseline_drift,
                             chosen.gravity_disturbance,
                             chosen.gravity_disturbance};
    static_assert(std::size(is_there) == kBlocks.size());
    for (std::size_t i = 0; i < kBlocks.size(); ++i) {
      first_[i] = is_there[i] ? size_ : kAbsent;
      if (is_there[i]) size_ += kBlocks[i].size;
    }
  }

  Eigen::Index size() const { return size_; }
  /// Of the blocks behind position, velocity and attitude.
  Eigen::Index chosen_size() const { return size_ - kNavStates; }
  bool has(StateBlock block) const { return first_[static_cast<std::size_t>(block)] != kAbsent; }
  /// Only of a block that is there.
  Eigen::Index first(StateBlock block) const { return first_[static_cast<std::size_t>(block)]; }

  /// Calls `use(block)` for each chosen block behind the nine, in order.
  template <class Use>
  void for_each_chosen(const Use& use) const {
    for (std::size_t i = kFirstChosenBlock; i < kBlocks.size(); ++i) {
      if (first_[i] != kAbsent) use(static_cast<StateBlock>(i));
    }
  }

 private:
  static constexpr Eigen::Index kAbsent = -1;

  std::array<Eigen::Index, kBlocks.size()> first_{};
  Eigen::Index size_ = 0;
};

/// Estimates of the errors behind position, velocity and attitude; 0 where a block is left out.
class Estimates {
 public:
  Estimates() { values_.fill(Vector3::Zero()); }

  /// The first size_of(block) numbers are the block's.
  Vector3& operator[](StateBlock block) { return values_[static_cast<std::size_t>(block) - kFirstChosenBlock]; }
  const Vector3& operator[](StateBlock block) const {
    return values_[static_cast<std::size_t>(block) - kFirstChosenBlock];
  }

 private:
  std::array<Vector3, kBlocks.size() - kFirstChosenBlock> values_;
};

}  // namespace inslab::navigation
