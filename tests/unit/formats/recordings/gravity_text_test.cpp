#include "inslab/formats/recordings/gravity_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/units/units.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::recordings {
namespace gravity_text_test {

using ::testing::HasSubstr;

class GravityText : public test::TemporaryFolder {
 protected:
  nav::GravityGrid grid(const std::string& text) const {
    put(path("grid.txt"), text);
    return read_gravity_grid(path("grid.txt"));
  }
  std::string refusal(const std::string& text) const {
    try {
      grid(text);
    } catch (const files::ReadError& error) {
      return error.what();
    }
    return "no error";
  }
};

constexpr const char* kThreeByThree =
    "# a comment\n"
    "46.0 7.2 1 2 3\n46.0 7.0 4 5 6\n46.0 7.1 7 8 9\n"
    "45.9 7.0 -1 -2 -3\n45.9 7.1 0 0 50\n45.9 7.2 0 0 0\n"
    "46.1 7.0 0 0 0\n\n46.1 7.1 0 0 0\n46.1 7.2 11 12 13\n";

TEST_F(GravityText, IsReadInAnyOrderOfItsKnots) {
  const nav::GravityGrid read = grid(kThreeByThree);
  const auto at = [&read](double latitude_deg, double longitude_deg) -> nav::Vector3 {
    return read.disturbance_n({latitude_deg * units::kDeg, longitude_deg * units::kDeg, 0.0}) / units::kMGal;
  };
  EXPECT_LT((at(46.0, 7.2) - nav::Vector3(1.0, 2.0, 3.0)).norm(), 1e-9);
  EXPECT_LT((at(45.9, 7.0) - nav::Vector3(-1.0, -2.0, -3.0)).norm(), 1e-9);
  EXPECT_LT((at(45.9, 7.1) - nav::Vector3(0.0, 0.0, 50.0)).norm(), 1e-9);
  EXPECT_LT((at(46.1, 7.2) - nav::Vector3(11.0, 12.0, 13.0)).norm(), 1e-9);
}

TEST_F(GravityText, TellsWhatIsWrongByItsLine) {
  const std::string good = kThreeByThree;
  EXPECT_THAT(refusal(good + "46.0 7.1 0 0 0\n"), HasSubstr("grid.txt: line 12: is the knot of line 4 once more"));
  EXPECT_THAT(refusal(good + "46.05 7.13 0 0 0\n"), HasSubstr("no regular grid"));
  EXPECT_THAT(refusal(good + "46.0 7.1 0 0\n"), HasSubstr("line 12: has 4 fields; expected 5"));
  EXPECT_THAT(refusal(good + "95.0 7.1 0 0 0\n"), HasSubstr("line 12: expected a latitude of at most 89.9"));
  EXPECT_THAT(refusal(good + "46.0 7.1 0 0 9780\n"),
              HasSubstr("line 12: expected disturbances (north, east, down) within "
                        "1000 mGal"));
  EXPECT_THAT(refusal("46 7 0 0 0\n46 8 0 0 0\n46 9 0 0 0\n"), HasSubstr("has fewer than 3 latitudes"));
  EXPECT_THAT(refusal("# nothing\n"), HasSubstr("has no knots; expected lines of latitude deg, longitude deg"));
  std::string lacking = good;
  lacking.erase(lacking.find("45.9 7.1"), std::string("45.9 7.1 0 0 50\n").size());
  EXPECT_THAT(refusal(lacking), HasSubstr("lacks the knot at latitude 45.900000, longitude 7.100000"));
}

}  // namespace gravity_text_test
}  // namespace inslab::recordings
