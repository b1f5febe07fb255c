#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>

#include "inslab/data/broadcast/message_field.hpp"
#include "inslab/formats/rinex/rinex_navigation.hpp"

namespace inslab::rinex {
namespace real_navigation_test {

using broadcast::Sign;

const std::string kFolder = INSLAB_SOURCE_DIR "/../shared/data/gnss/";

struct RealFile {
  const char* path;
  std::size_t keplerian, glonass, others, empty;
};

// Counted with grep, by the letters that records begin with; two of BeiDou's are all zeros.
constexpr std::array<RealFile, 5> kFiles{{
    {"brdc1820.10n", 421, 0, 0, 0},
    {"07590920.05n", 162, 0, 0, 0},
    {"brdm2000.13p", 327 + 774 + 478 + 96 - 2, 1477, 3413, 2},
    {"ESBC00DNK_R_20201770000_01D_MN.rnx", 357 + 1602 + 257 + 15, 510, 2130, 0},
    {"simulators/BRDC_20230080000/BRDM00DLR_S_20230081000_01D_MN.rnx", 44 + 26 + 32 + 4, 26, 15 + 4, 0},
}};

TEST(RealNavigation, FilesHaveAsManyRecordsAsTheirTextsBegin) {
  for (const RealFile& real : kFiles) {
    if (!std::filesystem::exists(kFolder + real.path)) GTEST_SKIP() << real.path << " is not beside the sources";
    const NavigationFile file = read_navigation(kFolder + real.path);
    EXPECT_EQ(file.keplerian.size(), real.keplerian) << real.path;
    EXPECT_EQ(file.glonass.size(), real.glonass) << real.path;
    EXPECT_EQ(file.other_records, real.others) << real.path;
    EXPECT_EQ(file.empty_records, real.empty) << real.path;
  }
}

/// Of one field in all messages of one system: what divides all numbers that were broadcast.
struct Seen {
  std::int64_t divisor = 0;
  double furthest = 0.0;  ///< of a number from a whole one, beside what 13 digits of RINEX leave open
};

template <class Message>
void look_at(const broadcast::MessageField<Message>& field, const broadcast::Coding& coding, Sign sign,
             const Message& message, Seen& seen) {
  if (coding.bits == 0) return;
  const double counted = field.value(message) / field.air_unit / coding.lsb;
  const std::int64_t number = broadcast::broadcast_number(field, coding, sign, field.value(message));
  seen.divisor = std::gcd(seen.divisor, number);
  const double off = std::abs(counted - static_cast<double>(number));
  seen.furthest = std::max(seen.furthest, off - 1e-12 * std::abs(counted));
}

// What satellites have broadcast lies on whole numbers of the least bits, and on no coarser grid: the tables have the
// scale factors of the ICDs. The RINEX of 13 digits leaves half a unit in the last of them.
TEST(RealNavigation, BroadcastNumbersLieOnTheBitsOfTheTables) {
  const std::string path = kFolder + "brdm2000.13p", later = kFolder + kFiles[3].path;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not beside the sources";
  std::map<std::string, Seen> seen;
  for (const std::string& name : {path, later}) {
    const NavigationFile file = read_navigation(name);
    for (const auto& [e, line] : file.keplerian) {
      // In 2013 Galileo's were test satellites, and QZSS was one with broken records.
      if (name == path && e.satellite.system != GnssSystem::Gps) continue;
      for (const auto& field : broadcast::keplerian_fields()) {
        const std::string key = letter_of(e.satellite.system) + (" " + std::string(field.name));
        look_at(field, coding_of(field, e.message), Sign::TwosComplement, e, seen[key]);
      }
    }
    for (const auto& [e, line] : file.glonass) {
      for (const auto& field : broadcast::glonass_fields()) {
        look_at(field, coding_of(field), Sign::Magnitude, e, seen["R " + std::string(field.name)]);
      }
    }
  }
  int judged = 0;
  for (const auto& [name, numbers] : seen) {
    EXPECT_LT(numbers.furthest, 1e-6) << name;
    if (numbers.divisor == 0) continue;  // never broadcast but 0, as af2 mostly
    EXPECT_EQ(numbers.divisor, 1) << name;
    ++judged;
  }
  EXPECT_GT(judged, 80);
}

}  // namespace real_navigation_test
}  // namespace inslab::rinex
