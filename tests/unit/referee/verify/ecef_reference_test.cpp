// The truth against the independent reference of `inslab verify trajectory`, over the first minutes of the tests' own
// tables, which differ from the catalogue that the command shows.

#include "inslab/referee/verify/ecef_reference.hpp"

#include <gtest/gtest.h>

#include "tests/unit/models/trajectory/tables.hpp"

namespace inslab::verify {
namespace ecef_reference_test {

namespace tables = trajectory::tables;

struct Case {
  const char* name;
  scenario::Trajectory table;
  double duration_s;
};

/// The table from its segment `first` on, at its start's speed: a short test sees the interesting part.
scenario::Trajectory from_segment(scenario::Trajectory table, std::ptrdiff_t first, double speed_m_per_s) {
  table.segments.erase(table.segments.begin(), table.segments.begin() + first);
  table.initial.speed_m_per_s = speed_m_per_s;
  return table;
}

/// A minute of an aircraft's bumps and turns from another place.
scenario::Trajectory aircraft_at(double latitude_deg, double longitude_deg, double height_m, double yaw_deg) {
  scenario::Trajectory table = from_segment(trajectory::tables::aircraft(), 7, 200.0);
  table.initial = {latitude_deg, longitude_deg, height_m, 200.0, 0.0, 0.0, yaw_deg};
  return table;
}

class EcefReference : public testing::TestWithParam<Case> {};

TEST_P(EcefReference, AgreesToAMicrometre) {
  scenario::Trajectory table = GetParam().table;
  table.gravity.model = nav::GravityModel::Somigliana;  // that of the reference
  const Differences rms = compare_with_ecef(table, GetParam().duration_s);
  ASSERT_EQ(rms.seconds, static_cast<std::size_t>(GetParam().duration_s));
  EXPECT_LE(rms.solvers_m, 1e-8L) << "the two reference solvers disagree";
  EXPECT_LE(rms.position_m, 1e-6L);
  EXPECT_LE(rms.velocity_m_per_s, 1e-8L);
  EXPECT_LE(rms.attitude_deg, 1e-9L);
  // The increments of a second: an attitude that is 1e-9 deg off turns 9.8 m/s by 1.7e-10 m/s, and Earth rate by
  // 1.3e-15 rad; each of 200 samples adds a rounding of 1e-19 rad.
  EXPECT_LE(rms.dv_m_per_s, 1.7e-10L);
  EXPECT_LE(rms.dtheta_rad, 1e-14L);
}

INSTANTIATE_TEST_SUITE_P(
    Tables, EcefReference,
    testing::Values(Case{"basic", from_segment(trajectory::tables::basic(), 1, 0.0), 90.0},
                    Case{"vehicle", from_segment(trajectory::tables::vehicle(), 1, 0.0), 90.0},
                    Case{"aircraft", from_segment(trajectory::tables::aircraft(), 6, 200.0), 110.0},
                    Case{"ship", trajectory::tables::ship(), 60.0}, Case{"rocket", trajectory::tables::rocket(), 60.0}),
    [](const auto& table) { return table.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Places, EcefReference,
    testing::Values(Case{"south_west", aircraft_at(-33.45, -70.66, 500.0, 0.0), 60.0},
                    Case{"across_the_equator", aircraft_at(0.005, 0.0, 500.0, 180.0), 60.0},
                    Case{"eastward_across_the_antimeridian", aircraft_at(-17.0, 179.99, 500.0, 90.0), 60.0},
                    Case{"westward_across_the_antimeridian", aircraft_at(52.0, -179.99, 500.0, -90.0), 60.0},
                    Case{"across_the_prime_meridian_from_below_360_deg", aircraft_at(51.5, 359.99, 500.0, 90.0), 60.0},
                    Case{"near_the_north_pole", aircraft_at(89.7, 10.0, 500.0, 60.0), 60.0},
                    Case{"near_the_south_pole", aircraft_at(-89.7, -160.0, 3000.0, 90.0), 60.0},
                    Case{"in_the_dead_sea", aircraft_at(31.5, 35.5, -900.0, 0.0), 60.0},
                    Case{"at_the_upper_edge", aircraft_at(45.0, 100.0, 99900.0, 45.0), 60.0}),
    [](const auto& place) { return place.param.name; });

}  // namespace ecef_reference_test
}  // namespace inslab::verify
