#include "inslab/models/atmosphere/niell.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "inslab/foundation/units/units.hpp"

namespace inslab::atmosphere {

namespace {

/// Of the continued fraction in sin E.
struct Coefficients {
  double a, b, c;
};

/// Coefficients at latitudes 15, 30, 45, 60 and 75 deg.
using ByLatitude = std::array<Coefficients, 5>;

constexpr ByLatitude kDryMean{{{1.2769934e-3, 2.9153695e-3, 62.610505e-3},
                               {1.2683230e-3, 2.9152299e-3, 62.837393e-3},
                               {1.2465397e-3, 2.9288445e-3, 63.721774e-3},
                               {1.2196049e-3, 2.9022565e-3, 63.824265e-3},
                               {1.2045996e-3, 2.9024912e-3, 64.258455e-3}}};
constexpr ByLatitude kDrySwing{{{0.0, 0.0, 0.0},
                                {1.2709626e-5, 2.1414979e-5, 9.0128400e-5},
                                {2.6523662e-5, 3.0160779e-5, 4.3497037e-5},
                                {3.4000452e-5, 7.2562722e-5, 84.795348e-5},
                                {4.1202191e-5, 11.723375e-5, 170.37206e-5}}};
constexpr ByLatitude kWet{{{5.8021897e-4, 1.4275268e-3, 4.3472961e-2},
                           {5.6794847e-4, 1.5138625e-3, 4.6729510e-2},
                           {5.8118019e-4, 1.4572752e-3, 4.3908931e-2},
                           {5.9727542e-4, 1.5007428e-3, 4.4626982e-2},
                           {6.1641693e-4, 1.7599082e-3, 5.4736038e-2}}};
constexpr Coefficients kOfHeight{2.53e-5, 5.49e-3, 1.14e-3};

Coefficients between(const ByLatitude& table, double latitude_deg) {
  const double at = std::clamp((latitude_deg - 15.0) / 15.0, 0.0, 4.0);
  const auto below = std::min<std::size_t>(static_cast<std::size_t>(at), 3);
  const double part = at - static_cast<double>(below);
  const Coefficients &low = table[below], &high = table[below + 1];
  return {low.a + part * (high.a - low.a), low.b + part * (high.b - low.b), low.c + part * (high.c - low.c)};
}

/// Marini's fraction, 1 at the zenith.
double fraction(double sine, const Coefficients& k) {
  return (1.0 + k.a / (1.0 + k.b / (1.0 + k.c))) / (sine + k.a / (sine + k.b / (sine + k.c)));
}

}  // namespace

Mapping niell_mapping(const nav::Geodetic& antenna, double elevation_rad, double day_of_year) {
  constexpr double kColdest_day = 28.0, kYear_days = 365.25;
  const double sine = std::sin(elevation_rad);
  const double latitude_deg = std::abs(antenna.latitude_rad) * units::kDegPerRad;
  const double half_year = antenna.latitude_rad < 0.0 ? 0.5 : 0.0;
  const double season = std::cos(2.0 * units::kPi * ((day_of_year - kColdest_day) / kYear_days + half_year));
  const Coefficients mean = between(kDryMean, latitude_deg), swing = between(kDrySwing, latitude_deg);
  const Coefficients dry{mean.a - swing.a * season, mean.b - swing.b * season, mean.c - swing.c * season};
  const double of_height = (1.0 / sine - fraction(sine, kOfHeight)) * antenna.height_m / 1000.0;
  return {fraction(sine, dry) + of_height, fraction(sine, between(kWet, latitude_deg))};
}

}  // namespace inslab::atmosphere
