#pragma once

#include <array>
#include <cstdint>

#include "inslab/foundation/fields/field.hpp"
#include "inslab/nav/world_magnetic_model.hpp"

namespace inslab::magnetometer {

/// The World Magnetic Model along a way, quick: exact in the middle of a cell of 0.01 deg by 0.01 deg by 1 km of
/// height, in straight lines from there to its walls, within 0.1 nT of the model. A place has one value, whichever way
/// led there.
class EarthField {
 public:
  explicit EarthField(double decimal_year) : model_(decimal_year) {}

  /// North, east, down at `position`, nT.
  Vector3 B_n_nt(const nav::Geodetic& position) const;

 private:
  using Cell = std::array<std::int64_t, 3>;

  void enter(const Cell& cell) const;

  nav::WorldMagneticModel model_;
  // A cache: what the cell says follows from its number.
  mutable Cell cell_{INT64_MIN, 0, 0};
  mutable Vector3 middle_nt_ = Vector3::Zero();
  mutable Matrix3 change_nt_ = Matrix3::Zero();  ///< over a whole cell; columns: latitude, longitude, height
};

}  // namespace inslab::magnetometer
