#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/wgs84.hpp"
#include "inslab/scenario/terrain_gravity.hpp"

namespace inslab::scenario {
namespace gravity_statistics_test {

constexpr nav::Geodetic kOrigin{30.0 * units::kDeg, 114.0 * units::kDeg, 0.0};
constexpr int kFields = 400;
constexpr int kPlaces = 40;
constexpr double kRms_arcsec = 6.0;

/// Mean of products over the fields, with its standard error.
class Product {
 public:
  void add(double value) {
    sum_ += value;
    squares_ += value * value;
  }
  double mean() const { return sum_ / kFields; }
  double standard_error() const { return std::sqrt((squares_ / kFields - mean() * mean()) / (kFields - 1)); }

 private:
  double sum_ = 0.0;
  double squares_ = 0.0;
};

struct Expected {
  Product along, across, anomaly, along_with_across, along_with_anomaly;
};
struct Sums {
  double along = 0.0, across = 0.0, anomaly = 0.0, along_with_across = 0.0, along_with_anomaly = 0.0;
};

/// Jordan 1972, and its derivatives, of the place and one u = s/D to the north of it.
TEST(GravityField, OfFourHundredSeedsHasTheCorrelationsOfTheThirdOrderModel) {
  const GravityVariation variation{GravityTerrain::Mountains, kRms_arcsec, 30e3};
  const double m_per_rad = nav::wgs84::meridian_radius_from_sine_m(std::sin(kOrigin.latitude_rad));
  constexpr std::array<double, 7> kDistances{0.0, 0.2, 0.5, 1.0, 1.618034, 2.5, 5.0};
  std::array<Expected, kDistances.size()> found;
  for (int seed = 1; seed <= kFields; ++seed) {
    const nav::GravityField field = gravity_field(variation, kOrigin, static_cast<std::uint64_t>(seed));
    // Many places of a field, far apart, say more of it than one.
    std::array<Sums, kDistances.size()> sums{};
    for (int i = 0; i < kPlaces; ++i) {
      nav::Geodetic place = kOrigin;
      place.longitude_rad += 4.0 * i * variation.correlation_m / m_per_rad;
      const Vector3 here = field.exact_n(place);
      for (std::size_t k = 0; k < kDistances.size(); ++k) {
        nav::Geodetic north = place;
        north.latitude_rad += kDistances[k] * variation.correlation_m / m_per_rad;
        const Vector3 there = field.exact_n(north);
        sums[k].along += here.x() * there.x() / kPlaces;
        sums[k].across += here.y() * there.y() / kPlaces;
        sums[k].anomaly += here.z() * there.z() / kPlaces;
        sums[k].along_with_across += here.x() * there.y() / kPlaces;
        sums[k].along_with_anomaly += (here.x() * there.z() + here.z() * there.x()) / kPlaces;
      }
    }
    for (std::size_t k = 0; k < kDistances.size(); ++k) {
      found[k].along.add(sums[k].along);
      found[k].across.add(sums[k].across);
      found[k].anomaly.add(sums[k].anomaly);
      found[k].along_with_across.add(sums[k].along_with_across);
      found[k].along_with_anomaly.add(sums[k].along_with_anomaly);
    }
  }
  const double variance = std::pow(kRms_arcsec * units::kArcsec * units::kG, 2);
  for (std::size_t i = 0; i < kDistances.size(); ++i) {
    const double u = kDistances[i], fall = std::exp(-u);
    const auto near = [u](const Product& product, double expected, const char* what) {
      EXPECT_NEAR(product.mean(), expected, 4.0 * product.standard_error()) << what << " at u = " << u;
    };
    near(found[i].along, variance * (1.0 + u - u * u) * fall, "deflection along the track");
    near(found[i].across, variance * (1.0 + u) * fall, "deflection across the track");
    near(found[i].anomaly, 2.0 * variance * (1.0 + u - 0.5 * u * u) * fall, "anomaly");
    near(found[i].along_with_across, 0.0, "along with across");
    near(found[i].along_with_anomaly, 0.0, "the even part of along with the anomaly");
    EXPECT_LT(found[i].across.standard_error(), 0.02 * variance) << "what another distribution of |k| would change";
  }
}

TEST(GravityField, FallsWithHeightAsItsLongWavesDo) {
  const GravityVariation variation;
  Product low, high;
  for (int seed = 1; seed <= kFields; ++seed) {
    const nav::GravityField field = gravity_field(variation, kOrigin, static_cast<std::uint64_t>(seed));
    nav::Geodetic up = kOrigin;
    up.height_m = variation.correlation_m;
    low.add(std::pow(field.exact_n(kOrigin).z(), 2));
    high.add(std::pow(field.exact_n(up).z(), 2));
  }
  // The integral of 15/2 kappa^3 (1 + kappa^2)^(-7/2) exp(-2 kappa), by Simpson's rule.
  constexpr int kSteps = 20000;
  constexpr double kEnd = 40.0;
  double share = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double kappa = kEnd * i / kSteps;
    const double weight = (i == 0 || i == kSteps ? 1.0 : i % 2 == 0 ? 2.0 : 4.0) * kEnd / kSteps / 3.0;
    share += weight * 7.5 * std::pow(kappa, 3) * std::pow(1.0 + kappa * kappa, -3.5) * std::exp(-2.0 * kappa);
  }
  const double variance = 2.0 * std::pow(6.0 * units::kArcsec * units::kG, 2);
  EXPECT_NEAR(low.mean(), variance, 4.0 * low.standard_error());
  EXPECT_NEAR(high.mean(), share * variance, 4.0 * high.standard_error());
  EXPECT_LT(share, 0.3);
}

}  // namespace gravity_statistics_test
}  // namespace inslab::scenario
