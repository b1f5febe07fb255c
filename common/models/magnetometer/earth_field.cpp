#include "inslab/models/magnetometer/earth_field.hpp"

#include <cmath>

#include "inslab/foundation/units/units.hpp"

namespace inslab::magnetometer {
namespace {

constexpr double kCellRad = 0.01 * units::kDeg;
constexpr double kCellM = 1000.0;

/// A position in cells; whole numbers are the middles.
Vector3 in_cells(const nav::Geodetic& position) {
  return {position.latitude_rad / kCellRad, position.longitude_rad / kCellRad, position.height_m / kCellM};
}

nav::Geodetic at_cells(const Vector3& cells) {
  return {cells.x() * kCellRad, cells.y() * kCellRad, cells.z() * kCellM};
}

}  // namespace

Vector3 EarthField::B_n_nt(const nav::Geodetic& position) const {
  const Vector3 here = in_cells(position);
  const Cell cell{std::llround(here.x()), std::llround(here.y()), std::llround(here.z())};
  if (cell != cell_) enter(cell);
  const Vector3 middle(static_cast<double>(cell[0]), static_cast<double>(cell[1]), static_cast<double>(cell[2]));
  return middle_nt_ + change_nt_ * (here - middle);
}

void EarthField::enter(const Cell& cell) const {
  const Vector3 middle(static_cast<double>(cell[0]), static_cast<double>(cell[1]), static_cast<double>(cell[2]));
  middle_nt_ = model_.B_n_nt(at_cells(middle));
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 half = 0.5 * Vector3::Unit(axis);
    change_nt_.col(axis) = model_.B_n_nt(at_cells(middle + half)) - model_.B_n_nt(at_cells(middle - half));
  }
  cell_ = cell;
}

}  // namespace inslab::magnetometer
