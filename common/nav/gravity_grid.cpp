#include "inslab/nav/gravity_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "inslab/nav/wgs84.hpp"

namespace inslab::nav {

namespace {

/// Weights of the four knots around a place that is `s` of a step, 0 to 1, beyond the second of them.
std::array<double, 4> cubic_weights(double s) {
  const double s2 = s * s, s3 = s2 * s;
  return {0.5 * (-s3 + 2.0 * s2 - s), 0.5 * (3.0 * s3 - 5.0 * s2 + 2.0), 0.5 * (-3.0 * s3 + 4.0 * s2 + s),
          0.5 * (s3 - s2)};
}

/// The step of an axis in which a place lies, and how far into it.
struct Step {
  std::size_t first;  ///< its first knot
  double share;
};

Step step_of(double steps, std::size_t knots) {
  const double held = std::clamp(steps, 0.0, static_cast<double>(knots - 1));
  const std::size_t first = std::min(static_cast<std::size_t>(held), knots - 2);
  return {first, held - static_cast<double>(first)};
}

bool is_axis(const GravityGrid::Axis& axis) { return axis.step_rad > 0.0 && axis.knots >= 3; }

}  // namespace

GravityGrid::GravityGrid(const Axis& latitude, const Axis& longitude, const std::vector<Vector3>& disturbance_n)
    : latitude_(latitude), longitude_(longitude), row_(longitude.knots + 2) {
  if (!is_axis(latitude) || !is_axis(longitude) || disturbance_n.size() != latitude.knots * longitude.knots) {
    throw std::invalid_argument("a grid of gravity has at least 3 knots along both axes, and one value a knot");
  }
  with_border_.resize((latitude.knots + 2) * row_);
  const auto at = [this](std::size_t row, std::size_t column) -> Vector3& { return with_border_[row * row_ + column]; };
  for (std::size_t i = 0; i < latitude.knots; ++i) {
    for (std::size_t j = 0; j < longitude.knots; ++j) at(i + 1, j + 1) = disturbance_n[i * longitude.knots + j];
  }
  // The parabola through the three knots inside.
  const auto beyond = [](const Vector3& first, const Vector3& second, const Vector3& third) -> Vector3 {
    return 3.0 * first - 3.0 * second + third;
  };
  const std::size_t columns = longitude.knots, rows = latitude.knots;
  for (std::size_t i = 1; i <= rows; ++i) {
    at(i, 0) = beyond(at(i, 1), at(i, 2), at(i, 3));
    at(i, columns + 1) = beyond(at(i, columns), at(i, columns - 1), at(i, columns - 2));
  }
  for (std::size_t j = 0; j < row_; ++j) {
    at(0, j) = beyond(at(1, j), at(2, j), at(3, j));
    at(rows + 1, j) = beyond(at(rows, j), at(rows - 1, j), at(rows - 2, j));
  }
}

GravityAlongWay GravityGrid::along_way() const {
  const auto at = [this](std::size_t row, std::size_t column) { return with_border_[row * row_ + column]; };
  Vector3 squares = Vector3::Zero();
  double north_squares = 0.0, east_squares = 0.0;  // of slopes, 1/s^4
  for (std::size_t i = 1; i <= latitude_.knots; ++i) {
    const double latitude_rad = latitude_.first_rad + static_cast<double>(i - 1) * latitude_.step_rad;
    const double sine = std::sin(latitude_rad);
    const double north_m = latitude_.step_rad * wgs84::meridian_radius_from_sine_m(sine);
    const double east_m = longitude_.step_rad * wgs84::transverse_radius_from_sine_m(sine) * std::cos(latitude_rad);
    for (std::size_t j = 1; j <= longitude_.knots; ++j) {
      squares += at(i, j).cwiseAbs2();
      if (i < latitude_.knots) north_squares += (at(i + 1, j) - at(i, j)).squaredNorm() / (north_m * north_m);
      if (j < longitude_.knots) east_squares += (at(i, j + 1) - at(i, j)).squaredNorm() / (east_m * east_m);
    }
  }
  const auto rows = static_cast<double>(latitude_.knots), columns = static_cast<double>(longitude_.knots);
  squares /= rows * columns;
  const double slope_squared =
      0.5 * (north_squares / ((rows - 1.0) * columns) + east_squares / (rows * (columns - 1.0)));
  return {squares.cwiseSqrt(), slope_squared > 0.0 ? std::sqrt(squares.sum() / slope_squared) : 0.0};
}

double GravityGrid::steps_of_latitude(double latitude_rad) const {
  return (latitude_rad - latitude_.first_rad) / latitude_.step_rad;
}

double GravityGrid::steps_of_longitude(double longitude_rad) const {
  const double middle_rad = 0.5 * (longitude_.first_rad + longitude_.last_rad());
  return (wrapped_to_pi(longitude_rad - middle_rad) + middle_rad - longitude_.first_rad) / longitude_.step_rad;
}

bool GravityGrid::contains(const Geodetic& position) const {
  constexpr double kRounding = 1e-9;  // of a step
  const auto is_within = [](double steps, const Axis& axis) {
    return steps >= -kRounding && steps <= static_cast<double>(axis.knots - 1) + kRounding;
  };
  return is_within(steps_of_latitude(position.latitude_rad), latitude_) &&
         is_within(steps_of_longitude(position.longitude_rad), longitude_);
}

Vector3 GravityGrid::disturbance_n(const Geodetic& position) const {
  const Step row = step_of(steps_of_latitude(position.latitude_rad), latitude_.knots);
  const Step column = step_of(steps_of_longitude(position.longitude_rad), longitude_.knots);
  const std::array<double, 4> by_row = cubic_weights(row.share), by_column = cubic_weights(column.share);
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < by_row.size(); ++i) {
    const std::size_t first = (row.first + i) * row_ + column.first;
    Vector3 along = Vector3::Zero();
    for (std::size_t j = 0; j < by_column.size(); ++j) along += by_column[j] * with_border_[first + j];
    sum += by_row[i] * along;
  }
  return sum;
}

}  // namespace inslab::nav
