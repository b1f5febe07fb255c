#include "inslab/sim/navigation_files.hpp"

#include <gmock/gmock.h>

#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::sim {
namespace navigation_files_test {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;

class NavigationFilesRead : public test::TemporaryFolder {
 protected:
  /// A file with one record three times, of which the second has its satellite 0.01 rad further on.
  std::string with_a_stray_record() const {
    const std::string text = contents(INSLAB_SOURCE_DIR "/tests/data/gnss/gps_2.rnx");
    const std::size_t begin = text.find(" 2 10  7  1");
    const std::string record = text.substr(begin);
    std::string stray = record;
    stray.replace(stray.find("0.165772167412D+01"), 18, "0.166772167412D+01");
    put(path("three.10n"), text.substr(0, begin) + record + stray + record);
    return path("three.10n");
  }
};

TEST_F(NavigationFilesRead, AStrayRecordIsRefusedByFileAndLine) {
  const std::string file = with_a_stray_record();
  const NavigationFiles read = load_navigation_files({file});
  EXPECT_EQ(read.keplerian.size(), 2u);
  EXPECT_EQ(read.ionosphere.size(), 1u);
  // 26 560 km times 0.01, near apogee or perigee by a hundredth more or less.
  EXPECT_THAT(read.refused, ElementsAre(HasSubstr(file + ": line 15: G02 is 26")));
  EXPECT_THAT(read.refused, ElementsAre(EndsWith(" km from where its neighbours put it")));
}

TEST_F(NavigationFilesRead, SeveralFilesAreOneSky) {
  const std::string folder = INSLAB_SOURCE_DIR "/tests/data/gnss/";
  const NavigationFiles read =
      load_navigation_files({folder + "mixed_305.rnx", folder + "gps_2.rnx", folder + "glonass_210.rnx"});
  EXPECT_EQ(read.keplerian.size(), 7u);
  EXPECT_EQ(read.glonass.size(), 3u);
  EXPECT_EQ(read.ionosphere.size(), 2u);  // the first of GPS, and BeiDou's
  EXPECT_EQ(read.ionosphere[0].alpha[0], 2.4214e-08);
  EXPECT_TRUE(read.refused.empty());
}

// IGS's file of 2010-07-01 has one record of PRN 1, at line 937, that is on the other side of the Earth.
TEST_F(NavigationFilesRead, RecordOfAnArchiveThatIsOnTheOtherSideOfTheEarth) {
  const std::string file = INSLAB_SOURCE_DIR "/../shared/data/gnss/brdc1820.10n";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  EXPECT_THAT(load_navigation_files({file}).refused, ElementsAre(HasSubstr("brdc1820.10n: line 937: G01 is ")));
}

}  // namespace navigation_files_test
}  // namespace inslab::sim
