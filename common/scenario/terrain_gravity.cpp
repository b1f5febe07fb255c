#include "inslab/scenario/terrain_gravity.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "inslab/foundation/units/units.hpp"
#include "inslab/noise/random/stream.hpp"

namespace inslab::scenario {

namespace {

constexpr std::size_t kWaves = 256;
constexpr double kCellsPerCorrelation = 400.0;
constexpr std::array<double, 3> kTerrains_arcsec{2.0, 6.0, 15.0};  // by GravityTerrain

/// |k| D whose distribution has the density proportional to kappa^3 (1 + kappa^2)^(-7/2): the inverse of
/// 1 - 5/2 s^3 + 3/2 s^5 with s = (1 + kappa^2)^(-1/2), which falls from 1 at s = 0 to 0 at s = 1.
double kappa_of(double share) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double s = 0.5 * (low + high);
    (1.0 - s * s * s * (2.5 - 1.5 * s * s) > share ? low : high) = s;
  }
  const double s = 0.5 * (low + high);
  return std::sqrt(1.0 - s * s) / s;
}

double rms_rad(const GravityVariation& variation) {
  return units::kArcsec *
         variation.deflection_rms_arcsec.value_or(kTerrains_arcsec.at(static_cast<std::size_t>(variation.terrain)));
}

}  // namespace

nav::GravityField gravity_field(const GravityVariation& variation, const nav::Geodetic& origin, std::uint64_t seed) {
  const double deflection_rad =
      2.0 * rms_rad(variation) / std::sqrt(static_cast<double>(kWaves));  // of each wave, along its k
  const random::Stream lengths(seed, "gravity/length"), directions(seed, "gravity/direction"),
      phases(seed, "gravity/phase");
  std::vector<nav::GravityField::Wave> waves;
  for (std::uint64_t i = 0; i < kWaves; ++i) {
    const double k_rad_per_m = kappa_of(lengths.uniform(i)) / variation.correlation_m;
    if (!(k_rad_per_m > 0.0)) continue;  // a share of exactly 0: a wave without length carries nothing
    const double direction_rad = 2.0 * units::kPi * directions.uniform(i);
    waves.push_back({k_rad_per_m * std::cos(direction_rad), k_rad_per_m * std::sin(direction_rad), deflection_rad,
                     2.0 * units::kPi * phases.uniform(i)});
  }
  return nav::GravityField(origin, variation.correlation_m / kCellsPerCorrelation, std::move(waves));
}

nav::Gravity::Disturbance constant_disturbance(const GravityOptions& options) {
  return {options.disturbance_mgal, options.deflection_north_arcsec, options.deflection_east_arcsec};
}

nav::Gravity uniform_gravity(const GravityOptions& options) {
  return nav::Gravity(options.model, constant_disturbance(options));
}

std::optional<nav::GravityAlongWay> gravity_along_way(const GravityOptions& options, const nav::GravityGrid* grid) {
  nav::Vector3 variance =
      (units::kG * units::kArcsec * nav::Vector3(options.deflection_north_arcsec, options.deflection_east_arcsec, 0.0))
          .cwiseAbs2();
  variance.z() = std::pow(units::kMGal * options.disturbance_mgal, 2);
  double slope_squared = 0.0;  // of all axes, 1/s^4
  const auto add = [&](const nav::GravityAlongWay& part) {
    variance += part.sigma_n.cwiseAbs2();
    if (part.correlation_m > 0.0) slope_squared += part.sigma_n.squaredNorm() / std::pow(part.correlation_m, 2);
  };
  if (options.variation) {
    const double sigma_m_per_s2 = units::kG * rms_rad(*options.variation);
    add({sigma_m_per_s2 * nav::Vector3(1.0, 1.0, std::sqrt(2.0)), options.variation->correlation_m / std::sqrt(2.0)});
  }
  if (grid != nullptr) add(grid->along_way());
  if (variance.sum() == 0.0) return std::nullopt;
  return nav::GravityAlongWay{variance.cwiseSqrt(),
                              slope_squared > 0.0 ? std::sqrt(variance.sum() / slope_squared) : 0.0};
}

}  // namespace inslab::scenario
