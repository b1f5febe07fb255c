#include "inslab/nav/world_magnetic_model.hpp"

#include <cmath>

#include "inslab/nav/wgs84.hpp"

namespace inslab::nav {
namespace {

constexpr double kReferenceRadiusM = 6371200.0;  ///< of the geomagnetic series, WMM (6)

/// One row of WMM.COF: g, h in nT (Schmidt's quasi-normalization) and their change in nT a year.
struct Row {
  double g;
  double h;
  double g_per_year;
  double h_per_year;
};

constexpr std::array<Row, 90> kRows{{
    // degree, orders
    // clang-format off
    {-29351.8, 0.0, 12.0, 0.0}, {-1410.8, 4545.4, 9.7, -21.5},  // 1, 0 to 1
    {-2556.6, 0.0, -11.6, 0.0}, {2951.1, -3133.6, -5.2, -27.7}, {1649.3, -815.1, -8.0, -12.1},  // 2, 0 to 2
    {1361.0, 0.0, -1.3, 0.0}, {-2404.1, -56.6, -4.2, 4.0}, {1243.8, 237.5, 0.4, -0.3},  // 3, 0 to 2
    {453.6, -549.5, -15.6, -4.1},  // 3, 3 to 3
    {895.0, 0.0, -1.6, 0.0}, {799.5, 278.6, -2.4, -1.1}, {55.7, -133.9, -6.0, 4.1},  // 4, 0 to 2
    {-281.1, 212.0, 5.6, 1.6}, {12.1, -375.6, -7.0, -4.4},  // 4, 3 to 4
    {-233.2, 0.0, 0.6, 0.0}, {368.9, 45.4, 1.4, -0.5}, {187.2, 220.2, 0.0, 2.2},  // 5, 0 to 2
    {-138.7, -122.9, 0.6, 0.4}, {-142.0, 43.0, 2.2, 1.7}, {20.9, 106.1, 0.9, 1.9},  // 5, 3 to 5
    {64.4, 0.0, -0.2, 0.0}, {63.8, -18.4, -0.4, 0.3}, {76.9, 16.8, 0.9, -1.6},  // 6, 0 to 2
    {-115.7, 48.8, 1.2, -0.4}, {-40.9, -59.8, -0.9, 0.9}, {14.9, 10.9, 0.3, 0.7},  // 6, 3 to 5
    {-60.7, 72.7, 0.9, 0.9},  // 6, 6 to 6
    {79.5, 0.0, 0.0, 0.0}, {-77.0, -48.9, -0.1, 0.6}, {-8.8, -14.4, -0.1, 0.5},  // 7, 0 to 2
    {59.3, -1.0, 0.5, -0.8}, {15.8, 23.4, -0.1, 0.0}, {2.5, -7.4, -0.8, -1.0},  // 7, 3 to 5
    {-11.1, -25.1, -0.8, 0.6}, {14.2, -2.3, 0.8, -0.2},  // 7, 6 to 7
    {23.2, 0.0, -0.1, 0.0}, {10.8, 7.1, 0.2, -0.2}, {-17.5, -12.6, 0.0, 0.5},  // 8, 0 to 2
    {2.0, 11.4, 0.5, -0.4}, {-21.7, -9.7, -0.1, 0.4}, {16.9, 12.7, 0.3, -0.5},  // 8, 3 to 5
    {15.0, 0.7, 0.2, -0.6}, {-16.8, -5.2, 0.0, 0.3}, {0.9, 3.9, 0.2, 0.2},  // 8, 6 to 8
    {4.6, 0.0, 0.0, 0.0}, {7.8, -24.8, -0.1, -0.3}, {3.0, 12.2, 0.1, 0.3},  // 9, 0 to 2
    {-0.2, 8.3, 0.3, -0.3}, {-2.5, -3.3, -0.3, 0.3}, {-13.1, -5.2, 0.0, 0.2},  // 9, 3 to 5
    {2.4, 7.2, 0.3, -0.1}, {8.6, -0.6, -0.1, -0.2}, {-8.7, 0.8, 0.1, 0.4},  // 9, 6 to 8
    {-12.9, 10.0, -0.1, 0.1},  // 9, 9 to 9
    {-1.3, 0.0, 0.1, 0.0}, {-6.4, 3.3, 0.0, 0.0}, {0.2, 0.0, 0.1, 0.0},  // 10, 0 to 2
    {2.0, 2.4, 0.1, -0.2}, {-1.0, 5.3, 0.0, 0.1}, {-0.6, -9.1, -0.3, -0.1},  // 10, 3 to 5
    {-0.9, 0.4, 0.0, 0.1}, {1.5, -4.2, -0.1, 0.0}, {0.9, -3.8, -0.1, -0.1},  // 10, 6 to 8
    {-2.7, 0.9, 0.0, 0.2}, {-3.9, -9.1, 0.0, 0.0},  // 10, 9 to 10
    {2.9, 0.0, 0.0, 0.0}, {-1.5, 0.0, 0.0, 0.0}, {-2.5, 2.9, 0.0, 0.1},  // 11, 0 to 2
    {2.4, -0.6, 0.0, 0.0}, {-0.6, 0.2, 0.0, 0.1}, {-0.1, 0.5, -0.1, 0.0},  // 11, 3 to 5
    {-0.6, -0.3, 0.0, 0.0}, {-0.1, -1.2, 0.0, 0.1}, {1.1, -1.7, -0.1, 0.0},  // 11, 6 to 8
    {-1.0, -2.9, -0.1, 0.0}, {-0.2, -1.8, -0.1, 0.0}, {2.6, -2.3, -0.1, 0.0},  // 11, 9 to 11
    {-2.0, 0.0, 0.0, 0.0}, {-0.2, -1.3, 0.0, 0.0}, {0.3, 0.7, 0.0, 0.0},  // 12, 0 to 2
    {1.2, 1.0, 0.0, -0.1}, {-1.3, -1.4, 0.0, 0.1}, {0.6, 0.0, 0.0, 0.0},  // 12, 3 to 5
    {0.6, 0.6, 0.1, 0.0}, {0.5, -0.1, 0.0, 0.0}, {-0.1, 0.8, 0.0, 0.0},  // 12, 6 to 8
    {-0.4, 0.1, 0.0, 0.0}, {-0.2, -1.0, -0.1, 0.0}, {-1.3, 0.1, 0.0, 0.0},  // 12, 9 to 11
    {-0.7, 0.2, -0.1, -0.1},  // 12, 12 to 12
    // clang-format on
}};

/// The factor of P(n-2, m) in the recursion of Legendre functions in Gauss's normalization.
double recursion_factor(int n, int m) {
  return static_cast<double>((n - 1) * (n - 1) - m * m) / static_cast<double>((2 * n - 1) * (2 * n - 3));
}

}  // namespace

WorldMagneticModel::WorldMagneticModel(double decimal_year) : WorldMagneticModel(1.0, decimal_year - kFirstYear) {}

WorldMagneticModel WorldMagneticModel::secular_change() { return {0.0, 1.0}; }

WorldMagneticModel::WorldMagneticModel(double share_of_field, double years_of_change) {
  double of_order_0 = 1.0;  // Schmidt's over Gauss's, for m = 0
  std::size_t index = 1;    // the monopole stays 0
  for (int n = 1; n <= kDegree; ++n) {
    of_order_0 *= static_cast<double>(2 * n - 1) / n;
    double factor = of_order_0;
    for (int m = 0; m <= n; ++m, ++index) {
      if (m > 0) factor *= std::sqrt(static_cast<double>((n - m + 1) * (m == 1 ? 2 : 1)) / (n + m));
      const Row& row = kRows[index - 1];
      terms_[index] = {factor * (share_of_field * row.g + years_of_change * row.g_per_year),
                       factor * (share_of_field * row.h + years_of_change * row.h_per_year)};
    }
  }
}

Vector3 WorldMagneticModel::B_n_nt(const Geodetic& position) const {
  // Geocentric radius and latitude, WMM (7), (8); primes of the report mark what refers to them.
  const double sin_latitude = std::sin(position.latitude_rad);
  const double cos_latitude = std::cos(position.latitude_rad);
  const double N_m = wgs84::transverse_radius_from_sine_m(sin_latitude);
  const double p_m = (N_m + position.height_m) * cos_latitude;
  const double z_m = (N_m * (1.0 - wgs84::e2) + position.height_m) * sin_latitude;
  const double r_m = std::hypot(p_m, z_m);
  const double cos_colatitude = z_m / r_m;
  const double sin_colatitude = p_m / r_m;

  // By order and then by degree: P(n, m) and its derivative by the colatitude need the two degrees before. For m > 0
  // `over_sine` is P(n, m) / sin(colatitude), which stays finite at a pole.
  const double ratio = kReferenceRadiusM / r_m;
  const double sin_longitude = std::sin(position.longitude_rad);
  const double cos_longitude = std::cos(position.longitude_rad);
  double cos_m = 1.0, sin_m = 0.0;   // of m times the longitude
  double sectoral = 1.0;             // P(m, m)
  double sectoral_over_sine = 0.0;   // P(m, m) / sin
  double sectoral_derivative = 0.0;  // of P(m, m)
  double ratio_m = ratio * ratio;    // (a / r)^(m + 2)
  double north = 0.0, east = 0.0, down = 0.0;
  for (int m = 0; m <= kDegree; ++m) {
    double P = sectoral, over_sine = sectoral_over_sine, derivative = sectoral_derivative;
    double P_before = 0.0, over_sine_before = 0.0, derivative_before = 0.0;
    double ratio_n = ratio_m;
    for (int n = m; n <= kDegree; ++n) {
      const Term& term = terms_[static_cast<std::size_t>(n * (n + 1) / 2 + m)];
      const double along = term.g * cos_m + term.h * sin_m;
      north += ratio_n * along * derivative;                                // WMM (10)
      east += ratio_n * m * (term.g * sin_m - term.h * cos_m) * over_sine;  // WMM (11)
      down -= ratio_n * (n + 1) * along * P;                                // WMM (12)
      const double K = recursion_factor(n + 1, m);
      const double P_next = cos_colatitude * P - K * P_before;
      const double over_sine_next = cos_colatitude * over_sine - K * over_sine_before;
      const double derivative_next = cos_colatitude * derivative - sin_colatitude * P - K * derivative_before;
      P_before = P, over_sine_before = over_sine, derivative_before = derivative;
      P = P_next, over_sine = over_sine_next, derivative = derivative_next;
      ratio_n *= ratio;
    }
    sectoral_derivative = sin_colatitude * sectoral_derivative + cos_colatitude * sectoral;
    sectoral_over_sine = m == 0 ? 1.0 : sin_colatitude * sectoral_over_sine;
    sectoral *= sin_colatitude;
    ratio_m *= ratio;
    const double cos_next = cos_m * cos_longitude - sin_m * sin_longitude;
    sin_m = sin_m * cos_longitude + cos_m * sin_longitude;
    cos_m = cos_next;
  }

  // From the geocentric vertical to the ellipsoid's, WMM (17).
  const double sin_psi = cos_colatitude * cos_latitude - sin_colatitude * sin_latitude;  // geocentric less geodetic
  const double cos_psi = sin_colatitude * cos_latitude + cos_colatitude * sin_latitude;
  return {north * cos_psi - down * sin_psi, east, north * sin_psi + down * cos_psi};
}

double declination_rad(const Vector3& B_n) { return std::atan2(B_n.y(), B_n.x()); }

double inclination_rad(const Vector3& B_n) { return std::atan2(B_n.z(), std::hypot(B_n.x(), B_n.y())); }

}  // namespace inslab::nav
