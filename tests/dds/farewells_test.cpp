#include "inslab/bus/dds/farewells.hpp"

#include <gtest/gtest.h>

namespace inslab::dds {
namespace farewells_test {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Farewells::Time kNow{};
constexpr Farewells::GuidPrefix kLeaves{1}, kStays{2};

TEST(Farewells, OfAParticipantThatIsNotHeardAgainIsItsOwn) {
  Farewells farewells;
  EXPECT_FALSE(farewells.is_belied(kLeaves, kNow));
  ASSERT_TRUE(farewells.note(kLeaves, kNow));
  EXPECT_FALSE(farewells.is_belied(kStays, kNow + seconds(10)));
  EXPECT_FALSE(farewells.is_belied(kLeaves, kNow + milliseconds(2'900))) << "it had sent that before it left";
}

TEST(Farewells, OfAParticipantThatGoesOnIsFalseAndToldOnce) {
  Farewells farewells;
  for (int i = 0; i < 40; ++i) ASSERT_TRUE(farewells.note(kStays, kNow + i * milliseconds(100)));
  EXPECT_TRUE(farewells.is_belied(kStays, kNow + milliseconds(3'900)));
  EXPECT_FALSE(farewells.is_belied(kStays, kNow + seconds(5)));
}

TEST(Farewells, OfMoreThanLeaveWithinAMinuteAreNotRemembered) {
  Farewells farewells;
  const auto numbered = [](std::size_t i) {
    return Farewells::GuidPrefix{static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i >> 8)};
  };
  for (std::size_t i = 0; i < Farewells::kMost; ++i) ASSERT_TRUE(farewells.note(numbered(i), kNow)) << i;
  EXPECT_FALSE(farewells.note(numbered(Farewells::kMost), kNow + seconds(59)));
  EXPECT_TRUE(farewells.note(numbered(0), kNow + seconds(59)));
  EXPECT_TRUE(farewells.note(numbered(Farewells::kMost), kNow + seconds(61)));
}

}  // namespace farewells_test
}  // namespace inslab::dds
