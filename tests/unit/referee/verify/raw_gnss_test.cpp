#include <gtest/gtest.h>

#include <filesystem>

#include "inslab/foundation/files/file_error.hpp"
#include "inslab/models/satellites/kepler_orbit.hpp"
#include "inslab/referee/verify/raw_gnss_block.hpp"
#include "tests/unit/referee/verify/rows_held.hpp"

/// `inslab verify raw_gnss` with the data beside the sources, and that faults of satellites are seen.
namespace inslab::verify {
namespace raw_gnss_test {

const std::string kFolder = INSLAB_SOURCE_DIR "/../shared/data/gnss";

class RawGnss : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << kFolder << " is not there";
  }

  static int failed_rows(const Table& table) {
    int failed = 0;
    for (const Row& row : table.rows) failed += row.held ? 0 : 1;
    return failed;
  }
};

TEST_F(RawGnss, BroadcastOrbitsAreWherePreciseOnesAre) {
  const Table table = raw_gnss_orbits(kFolder);
  EXPECT_EQ(table.rows.size(), 8U);
  EXPECT_TRUE(every_row_held(table));
}

TEST_F(RawGnss, RangesAreThoseOfASimulator) {
  const Table table = raw_gnss_ranges(kFolder);
  EXPECT_EQ(table.rows.size(), 8U);
  EXPECT_TRUE(every_row_held(table));
}

// The Earth's rate of another system, from the beginning of the week on, and the plane of geostationary satellites.
TEST_F(RawGnss, AnotherSystemsEarthIsSeen) {
  RawGnssSubjects faulty = product_satellites();
  faulty.state = [](const KeplerianEphemeris& e, const time::GpsTime& gps) {
    KeplerianEphemeris other = e;
    other.satellite.number = 20;
    other.satellite.system = e.satellite.system == GnssSystem::BeiDou ? GnssSystem::Galileo : GnssSystem::BeiDou;
    return satellites::kepler_state(other, gps);
  };
  EXPECT_EQ(failed_rows(raw_gnss_ranges(kFolder, faulty)), 8);
}

TEST_F(RawGnss, ALateClockAndAFirstOrderSagnacAreSeen) {
  RawGnssSubjects faulty = product_satellites();
  faulty.sight = [](const satellites::Departure& departure, const satellites::AntennaState& antenna) {
    satellites::Sight sight = satellites::sight(departure, antenna);
    sight.light_time_s += 2e-12;  // 0.6 mm
    sight.light_time_rate *= 1.0 + 1e-6;
    return sight;
  };
  EXPECT_EQ(failed_rows(raw_gnss_ranges(kFolder, faulty)), 8);
}

TEST_F(RawGnss, AnOrbitThatIsThreeMillisecondsLateIsSeen) {
  RawGnssSubjects faulty = product_satellites();
  faulty.state = [](const KeplerianEphemeris& e, const time::GpsTime& gps) {
    return satellites::kepler_state(e, gps + -std::chrono::milliseconds(3));
  };
  EXPECT_GE(failed_rows(raw_gnss_orbits(kFolder, faulty)), 5);  // GLONASS has a state of its own
}

TEST(RawGnssWithoutData, AFolderThatIsNoneIsRefused) { EXPECT_THROW(raw_gnss_tables("/nowhere"), files::ReadError); }

TEST(RawGnssWithoutData, SaysWhatIsLeftOut) {
  std::vector<std::size_t> left_out;
  for (const Table& table : raw_gnss_tables("")) {
    EXPECT_TRUE(table.rows.empty());
    EXPECT_FALSE(table.judged);
    left_out.push_back(table.left_out.size());
  }
  EXPECT_EQ(left_out, (std::vector<std::size_t>{2, 1}));  // orbits of two years, ranges of a simulator
}

}  // namespace raw_gnss_test
}  // namespace inslab::verify
