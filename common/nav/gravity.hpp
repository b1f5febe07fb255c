#pragma once

#include <cstdint>
#include <memory>

#include "inslab/nav/geodesy.hpp"
#include "inslab/nav/gravity_field.hpp"
#include "inslab/nav/gravity_grid.hpp"

namespace inslab::nav {

enum class GravityModel : std::uint32_t {
  Somigliana,  ///< WGS-84 closed form on the ellipsoid, second order in height
  Normal,      ///< the exact normal field of the WGS-84 ellipsoid
  Series,      ///< GRS80 series to the fourth power of sin(latitude), linear and quadratic in height
};

/// Gravity (gravitation and centrifugal acceleration together) over the ellipsoid, with an optional constant
/// disturbance and optional ones that vary with place. It keeps the powers of the place it was last asked about: one
/// object is not for two threads at once.
class Gravity {
 public:
  /// Departure of the Earth from the model, the same everywhere.
  struct Disturbance {
    double down_mgal = 0.0;                ///< added to the magnitude; 1 mGal = 1e-5 m/s^2
    double deflection_north_arcsec = 0.0;  ///< xi: the plumb line's zenith lies north of the ellipsoid's normal
    double deflection_east_arcsec = 0.0;   ///< eta: the plumb line's zenith lies east of the ellipsoid's normal
  };

  explicit Gravity(GravityModel model = GravityModel::Somigliana) : Gravity(model, Disturbance{}) {}
  /// `field` and `grid`: what varies with place; they add up.
  Gravity(GravityModel model, const Disturbance& disturbance, std::shared_ptr<const GravityField> field = nullptr,
          std::shared_ptr<const GravityGrid> grid = nullptr);

  /// Normal gravity along the ellipsoid's normal, down, in m/s^2, without the disturbance.
  ///
  /// Somigliana: NIMA TR8350.2 (4-1) with (4-3) for height; 1e-6 m/s^2 (0.1 mGal) from the exact normal field at
  /// 10 km, 2e-4 at 100 km. Normal: the exact field itself. Series: H. Moritz, Geodetic Reference System
  /// 1980, with the linear and quadratic height terms in numbers.
  double normal_m_per_s2(double sin_latitude, double height_m) const;

  /// Gravity in n, m/s^2: (-g xi, -g eta, g) with g the normal gravity plus the disturbance; first order in the angles.
  /// Only the model `normal` knows that the plumb line bends with height: it adds a north component.
  Vector3 g_n(const Geodetic& position) const;

  /// The same for who has the sine of the latitude at hand and not the place: `place()` is asked for the whole position
  /// only where gravity varies with it.
  template <class Place>
  Vector3 g_n(double sin_latitude, double height_m, Place place) const {
    const Vector3 uniform = uniform_g_n(sin_latitude, height_m);
    return field_ || grid_ ? Vector3(uniform + varying_n(place())) : uniform;
  }

  /// Whether the Earth departs from the model at all.
  bool is_disturbed() const;

  /// Gravitation in e, m/s^2: G = g + omega_ie x (omega_ie x r), what a test mass in free fall feels in i.
  Vector3 gravitation_e(const Geodetic& position) const;

 private:
  Vector3 uniform_g_n(double sin_latitude, double height_m) const;
  Vector3 varying_n(const Geodetic& position) const;

  GravityModel model_;
  double disturbance_m_per_s2_;
  double deflection_north_rad_;
  double deflection_east_rad_;
  std::shared_ptr<const GravityField> field_;
  std::shared_ptr<const GravityGrid> grid_;
  mutable GravityField::Cell cell_;  // a cache, not a state
};

}  // namespace inslab::nav
