#include "inslab/models/magnetometer/earth_field.hpp"

#include <gtest/gtest.h>

#include <random>

#include "inslab/foundation/units/units.hpp"

namespace inslab::magnetometer {
namespace earth_field_test {

TEST(EarthField, IsTheModelToATenthOfANanotesla) {
  const EarthField field(2026.9);
  const nav::WorldMagneticModel model(2026.9);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> latitude(-89.9, 89.9), longitude(-180.0, 180.0), height(-1000.0, 100000.0);
  double worst_nt = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const nav::Geodetic at{latitude(random) * units::kDeg, longitude(random) * units::kDeg, height(random)};
    worst_nt = std::max(worst_nt, (field.B_n_nt(at) - model.B_n_nt(at)).norm());
  }
  EXPECT_LT(worst_nt, 0.1);
  EXPECT_GT(worst_nt, 0.001) << "nothing is interpolated";
}

TEST(EarthField, APlaceHasOneValueWhicheverWayLedThere) {
  const nav::Geodetic here{0.8, 0.3, 1234.0};
  const EarthField from_north(2025.5), from_south(2025.5);
  for (int i = 300; i >= 0; --i) {
    from_north.B_n_nt({here.latitude_rad + i * 1e-5, here.longitude_rad, here.height_m});
    from_south.B_n_nt({here.latitude_rad - i * 1e-5, here.longitude_rad + i * 1e-5, here.height_m - i});
  }
  EXPECT_EQ(from_north.B_n_nt(here), from_south.B_n_nt(here));
}

}  // namespace earth_field_test
}  // namespace inslab::magnetometer
