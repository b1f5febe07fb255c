#include "inslab/formats/rinex/precise_orbits.hpp"

#include <gmock/gmock.h>

#include "inslab/foundation/files/file_error.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::rinex {
namespace precise_orbits_test {

using ::testing::HasSubstr;

class PreciseOrbits : public test::TemporaryFolder {
 protected:
  static constexpr const char* kFile = INSLAB_SOURCE_DIR "/tests/data/gnss/two_epochs.sp3";

  std::string refusal(const std::string& from, const std::string& to) const {
    std::string text = contents(kFile);
    put(path("damaged.sp3"), text.replace(text.find(from), from.size(), to));
    try {
      read_precise_orbits(path("damaged.sp3"));
    } catch (const files::ReadError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(PreciseOrbits, PositionsInMetresAndClocksInSeconds) {
  const std::vector<PreciseEpoch> epochs = read_precise_orbits(kFile);
  ASSERT_EQ(epochs.size(), 2u);
  EXPECT_EQ(epochs[0].gps, (time::GpsTime{2244, 36'000'000'000'000}));
  EXPECT_EQ(epochs[1].gps, (time::GpsTime{2244, 36'300'000'000'000}));
  ASSERT_EQ(epochs[0].states.size(), 2u);  // without NavIC
  const PreciseState& gps = epochs[0].states[0];
  EXPECT_EQ(name_of(gps.satellite), "G01");
  EXPECT_NEAR(gps.r_e_m->y(), 22372236.042, 1e-6);
  EXPECT_NEAR(*gps.clock_s, 227.083239e-6, 1e-18);
}

TEST_F(PreciseOrbits, WhatIsMissingIsNotThere) {
  const std::vector<PreciseEpoch> epochs = read_precise_orbits(kFile);
  EXPECT_TRUE(epochs[0].states[1].r_e_m);
  EXPECT_FALSE(epochs[0].states[1].clock_s);
  EXPECT_FALSE(epochs[1].states[0].r_e_m);
  EXPECT_TRUE(epochs[1].states[0].clock_s);
}

TEST_F(PreciseOrbits, DamageIsNamedByFileAndLine) {
  EXPECT_THAT(refusal("#dP2023", "#aP2023"), HasSubstr("damaged.sp3: line 1: is no header"));
  EXPECT_THAT(refusal("cc GPS", "cc UTC"), HasSubstr("line 5: has the time 'UTC'; expected GPS"));
  EXPECT_THAT(refusal("*  2023  1  8", "*  2023 13  8"), HasSubstr("line 7: is no epoch"));
  EXPECT_THAT(refusal("22372.236042", "22372.2x6042"), HasSubstr("line 8: has '22372.2x6042' in column 19"));
  EXPECT_THAT(refusal("EOF", ""), HasSubstr("is the last; expected EOF"));
}

}  // namespace precise_orbits_test
}  // namespace inslab::rinex
