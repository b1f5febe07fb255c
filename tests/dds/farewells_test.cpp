#include "inslab/bus/dds/farewells.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace inslab::dds {
namespace farewells_test {

using std::chrono::seconds;
using testing::Eq;
using testing::Optional;

const Farewells::GuidPrefix kMember{1};
const Farewells::GuidPrefix kAnother{2};
const Farewells::Time kNow{seconds(1000)};

TEST(Farewells, OfWhoIsNotHeardAfterwardsAreHisOwn) {
  Farewells farewells;
  EXPECT_TRUE(farewells.came(kMember, "10.0.0.1:7411", kNow));
  EXPECT_THAT(farewells.belied_by(kMember, kNow + seconds(2)), Eq(std::nullopt)) << "what was on its way still comes";
  EXPECT_THAT(farewells.belied_by(kAnother, kNow + seconds(10)), Eq(std::nullopt));
}

TEST(Farewells, OfWhoSpeaksOnWereForged) {
  Farewells farewells;
  EXPECT_TRUE(farewells.came(kMember, "10.0.0.66:1", kNow));
  EXPECT_TRUE(farewells.came(kMember, "10.0.0.67:1", kNow + seconds(4))) << "again and again";
  EXPECT_THAT(farewells.belied_by(kMember, kNow + seconds(5)), Optional(Eq("10.0.0.66:1")));
  EXPECT_THAT(farewells.belied_by(kMember, kNow + seconds(5)), Eq(std::nullopt)) << "once";
}

TEST(Farewells, AreNotKeptWithoutBound) {
  Farewells farewells;
  Farewells::GuidPrefix who{};
  for (int i = 0; i < 1024; ++i) {
    who[0] = static_cast<std::uint8_t>(i);
    who[1] = static_cast<std::uint8_t>(i >> 8);
    ASSERT_TRUE(farewells.came(who, "", kNow));
  }
  const Farewells::GuidPrefix one_more{0, 0, 1};
  EXPECT_FALSE(farewells.came(one_more, "", kNow + seconds(1)));
  EXPECT_TRUE(farewells.came(one_more, "", kNow + seconds(61))) << "the others are gone by now";
}

}  // namespace farewells_test
}  // namespace inslab::dds
