#include "inslab/models/satellites/stray_records.hpp"

#include <gmock/gmock.h>

#include "inslab/models/satellites/glonass_orbit.hpp"
#include "inslab/models/satellites/nominal_constellation.hpp"
#include "inslab/models/satellites/reference_time.hpp"

namespace inslab::satellites {
namespace stray_records_test {

using ::testing::IsEmpty;

const time::GpsTime kStart{2401, 0};

/// Five messages each of three satellites, two hours apart, in a file's order: by time.
std::vector<KeplerianEphemeris> five_messages() {
  const auto all = nominal_constellation(1, kStart).keplerian;
  std::vector<KeplerianEphemeris> records;
  for (int i = 0; i < 5; ++i) {
    for (std::size_t satellite : {0U, 24U, 60U}) {
      records.push_back(re_referenced(all[satellite], all[satellite].toe + std::chrono::hours(2 * i)));
    }
  }
  return records;
}

TEST(StrayRecords, NeighboursThatAgreeAreNone) { EXPECT_THAT(stray_records(five_messages()), IsEmpty()); }

// At a radius of 26 560 km an arc of 1 km is 3.8e-5 rad.
TEST(StrayRecords, OneThatIsMoreThanAKilometreOffIsFound) {
  for (const std::size_t bad : {0U, 3U, 6U, 12U}) {
    auto records = five_messages();
    records[bad].m0_rad += 3.3e-5;
    EXPECT_THAT(stray_records(records), IsEmpty()) << bad;
    records[bad].m0_rad += 1.2e-5;
    const auto found = stray_records(records);
    ASSERT_EQ(found.size(), 1u) << bad;
    EXPECT_EQ(found[0].index, bad);
    EXPECT_NEAR(found[0].off_m, 4.5e-5 * 26.56e6, 20.0);
  }
}

TEST(StrayRecords, OneWithoutNeighboursIsNone) {
  auto records = five_messages();
  records.resize(3);
  EXPECT_THAT(stray_records(records), IsEmpty());
}

TEST(StrayRecords, OfTwoAloneNobodyKnowsWhich) {
  auto records = five_messages();
  records.resize(6);
  records[0].m0_rad += 4.5e-5;
  EXPECT_EQ(stray_records(records).size(), 2u);
}

TEST(StrayRecords, GlonassAlike) {
  const auto first = nominal_constellation(1, kStart).glonass[5];
  GlonassOrbit orbit(first);
  std::vector<GlonassEphemeris> records;
  for (int i = 0; i < 4; ++i) records.push_back(re_referenced(orbit, first.tb + std::chrono::minutes(30 * i)));
  EXPECT_THAT(stray_records(records), IsEmpty());
  records[2].r_e_m.x() += 3000.0;
  const auto found = stray_records(records);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].index, 2u);
}

}  // namespace stray_records_test
}  // namespace inslab::satellites
