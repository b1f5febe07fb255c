#include "inslab/formats/recordings/gravity_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "inslab/foundation/files/number_line.hpp"
#include "inslab/foundation/units/units.hpp"

namespace inslab::recordings {

namespace {

constexpr std::size_t kMostKnots = 4'000'000;
constexpr double kMostMgal = 1000.0;
/// The share of a step by which knots may miss their places: coordinates are written with few decimals.
constexpr double kTolerance = 0.05;

struct Knot {
  std::uint64_t line;
  double latitude_deg, longitude_deg;
  nav::Vector3 disturbance_mgal;
};

/// Knots first_deg + i step_deg.
struct DegreeAxis {
  double first_deg;
  double step_deg;
  std::size_t knots;

  double at(std::size_t knot) const { return first_deg + static_cast<double>(knot) * step_deg; }
  nav::GravityGrid::Axis in_rad() const { return {first_deg * units::kDeg, step_deg * units::kDeg, knots}; }
};

std::string at_line(const std::string& path, std::uint64_t line) {
  return path + ": line " + std::to_string(line) + ": ";
}

std::vector<Knot> read_knots(const std::string& path) {
  files::TextLines lines(path);
  std::vector<Knot> knots;
  std::array<double, 5> n{};
  while (files::next_numbers(lines, n)) {
    const std::string place = at_line(path, lines.number());
    if (std::abs(n[0]) > nav::kMaxLatitudeDeg || n[1] < -180.0 || n[1] > 360.0) {
      throw files::ReadError(place + "expected a latitude of at most " + std::to_string(nav::kMaxLatitudeDeg) +
                             " deg either way and a longitude from -180 to 360 deg in the first two columns");
    }
    if (std::abs(n[2]) > kMostMgal || std::abs(n[3]) > kMostMgal || std::abs(n[4]) > kMostMgal) {
      throw files::ReadError(place +
                             "expected disturbances (north, east, down) within 1000 mGal in columns 3 to 5; "
                             "the Earth has none that is larger");
    }
    if (knots.size() == kMostKnots) {
      throw files::ReadError(place + "has more than " + std::to_string(kMostKnots) +
                             " knots; cut the grid to the area");
    }
    knots.push_back({lines.number(), n[0], n[1], {n[2], n[3], n[4]}});
  }
  return knots;
}

/// The axis on which these coordinates lie, in degrees still. The step is the smallest distance of two that differ.
DegreeAxis axis_of(std::vector<double> degrees, const std::string& path, const char* name) {
  std::sort(degrees.begin(), degrees.end());
  constexpr double kSame_deg = 1e-7;  // a centimetre
  double step_deg = 0.0;
  for (std::size_t i = 1; i < degrees.size(); ++i) {
    const double gap_deg = degrees[i] - degrees[i - 1];
    if (gap_deg > kSame_deg && (step_deg == 0.0 || gap_deg < step_deg)) step_deg = gap_deg;
  }
  const double length_deg = degrees.back() - degrees.front();
  const double steps = step_deg > 0.0 ? std::round(length_deg / step_deg) : 0.0;
  if (steps < 2.0) {
    throw files::ReadError(path + ": has fewer than 3 " + name + "s; expected a grid with at least 3 knots each way");
  }
  if (steps >= static_cast<double>(kMostKnots)) {
    throw files::ReadError(path + ": the " + name + "s are no regular grid: two are " + std::to_string(step_deg) +
                           " deg apart, all " + std::to_string(length_deg) + " deg");
  }
  return {degrees.front(), length_deg / steps, static_cast<std::size_t>(steps) + 1};
}

/// Which knot of the axis a coordinate is.
std::size_t index_on(const DegreeAxis& axis, double degrees, const std::string& place, const char* name) {
  const double steps = (degrees - axis.first_deg) / axis.step_deg;
  if (std::abs(steps - std::round(steps)) > kTolerance) {
    throw files::ReadError(place + "the " + name + " is " + std::to_string(degrees) +
                           " deg; expected one of a regular grid from " + std::to_string(axis.first_deg) +
                           " in steps of " + std::to_string(axis.step_deg) + " deg");
  }
  return static_cast<std::size_t>(std::llround(steps));
}

}  // namespace

nav::GravityGrid read_gravity_grid(const std::string& path) {
  const std::vector<Knot> knots = read_knots(path);
  if (knots.empty()) {
    throw files::ReadError(path +
                           ": has no knots; expected lines of latitude deg, longitude deg, and what is added to "
                           "gravity to the north, to the east and down, mGal");
  }
  std::vector<double> latitudes_deg, longitudes_deg;
  for (const Knot& knot : knots) {
    latitudes_deg.push_back(knot.latitude_deg);
    longitudes_deg.push_back(knot.longitude_deg);
  }
  const DegreeAxis latitude = axis_of(std::move(latitudes_deg), path, "latitude");
  const DegreeAxis longitude = axis_of(std::move(longitudes_deg), path, "longitude");
  if (latitude.knots > kMostKnots / longitude.knots || latitude.knots * longitude.knots > 2 * knots.size() + 16) {
    throw files::ReadError(path + ": its " + std::to_string(knots.size()) +
                           " knots are no regular grid, which would have " + std::to_string(latitude.knots) +
                           " latitudes and " + std::to_string(longitude.knots) + " longitudes");
  }
  std::vector<nav::Vector3> disturbance_n(latitude.knots * longitude.knots);
  std::vector<std::uint64_t> line_of(disturbance_n.size(), 0);
  for (const Knot& knot : knots) {
    const std::string place = at_line(path, knot.line);
    const std::size_t index = index_on(latitude, knot.latitude_deg, place, "latitude") * longitude.knots +
                              index_on(longitude, knot.longitude_deg, place, "longitude");
    if (line_of[index] != 0) {
      throw files::ReadError(place + "is the knot of line " + std::to_string(line_of[index]) + " once more");
    }
    line_of[index] = knot.line;
    disturbance_n[index] = units::kMGal * knot.disturbance_mgal;
  }
  const auto missing = std::find(line_of.begin(), line_of.end(), 0u);
  if (missing != line_of.end()) {
    const auto index = static_cast<std::size_t>(missing - line_of.begin());
    throw files::ReadError(path + ": lacks the knot at latitude " +
                           std::to_string(latitude.at(index / longitude.knots)) + ", longitude " +
                           std::to_string(longitude.at(index % longitude.knots)) + "; expected every knot of the grid");
  }
  return nav::GravityGrid(latitude.in_rad(), longitude.in_rad(), disturbance_n);
}

}  // namespace inslab::recordings
