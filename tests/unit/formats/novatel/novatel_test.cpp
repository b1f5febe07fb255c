#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "inslab/formats/novatel/novatel_imu.hpp"
#include "inslab/foundation/units/units.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::novatel {
namespace novatel_test {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Real lines, quoted from the test data of novatel/novatel_edie (MIT licence), revision d4c37642.
constexpr const char* kLine1692 =
    "%RAWIMUSXA,1692,484620.664;00,11,1692,484620.664389000,00801503,43110635,-817242,-202184,-215194,-41188,-9895*"
    "a5db8c7b";
constexpr const char* kLine2209 =
    "%RAWIMUSXA,2209,491674.014;04,41,2209,491674.013699,ea59fe00,329308016,-2706935,4508389,196192,417138,-1000837*"
    "038422a7";

class NovatelReader : public test::TemporaryFolder {
 protected:
  std::vector<NovatelImuRecord> read(const std::string& text, const NovatelImuReader::Options& options = {}) {
    put(path("raw"), text);
    NovatelImuReader reader(path("raw"), options);
    std::vector<NovatelImuRecord> records;
    NovatelImuRecord record;
    while (reader.next(record)) records.push_back(record);
    bad_ = reader.bad_lines();
    others_ = reader.other_line_count();
    EXPECT_EQ(reader.record_count(), records.size());
    EXPECT_EQ(reader.bad_line_count(), bad_.size());
    return records;
  }
  std::string reason_for(const std::string& line, const NovatelImuReader::Options& options = {}) {
    EXPECT_THAT(read(line + "\n", options), IsEmpty());
    return bad_.size() == 1 ? bad_.front().reason : std::to_string(bad_.size()) + " bad lines";
  }

  std::vector<BadLine> bad_;
  std::uint64_t others_ = 0;
};

/// A line with the CRC that belongs to it.
std::string with_crc(const std::string& line) { return line + "*" + crc_text(novatel_crc(line.substr(1))); }

TEST_F(NovatelReader, TurnsCountsOfARealLineIntoForwardRightDown) {
  const auto records = read(std::string(kLine1692) + "\r\n");
  ASSERT_EQ(records.size(), 1U);
  EXPECT_EQ(records[0].time, (time::GpsTime{1692, 484'620'664'389'000}));
  EXPECT_EQ(records[0].line, 1U);
  EXPECT_EQ(records[0].imu_type, 11U);
  EXPECT_EQ(records[0].status, 0x00801503U);
  // HG1700_AG58: 2^-27 ft/s and 2^-33 rad a count; raw x, y, z are the third, minus the second and the first field.
  const double m_per_s = 0.3048 / 134217728.0;
  const nav::Vector3 accel_raw(-202184 * m_per_s, 817242 * m_per_s, 43110635 * m_per_s);
  EXPECT_LE((records[0].dv_b - nav::Vector3(accel_raw.y(), accel_raw.x(), -accel_raw.z())).norm(), 1e-15);
  const double rad = 1.0 / 8589934592.0;
  const nav::Vector3 gyro_raw(-9895 * rad, 41188 * rad, -215194 * rad);
  EXPECT_LE((records[0].dtheta_b - nav::Vector3(gyro_raw.y(), gyro_raw.x(), -gyro_raw.z())).norm(), 1e-18);
  // An upright unit at rest, 100 Hz: one gravity upwards.
  EXPECT_NEAR(records[0].dv_b.norm() * 100.0, 9.8, 0.05);
  EXPECT_LT(records[0].dv_b.z(), 0.0);
}

TEST_F(NovatelReader, LeavesAxesAsTheyAreWhenAskedTo) {
  NovatelImuReader::Options as_is;
  as_is.axes = NovatelAxes::ForwardRightDown;
  const auto turned = read(kLine2209);
  const auto records = read(kLine2209, as_is);
  ASSERT_EQ(records.size(), 1U);
  EXPECT_EQ(records[0].dv_b, nav::Vector3(turned[0].dv_b.y(), turned[0].dv_b.x(), -turned[0].dv_b.z()));
}

TEST_F(NovatelReader, CountsADamagedLineWithItsNumberAndNeverUsesIt) {
  std::string damaged = kLine1692;
  damaged.replace(damaged.size() - 8, 8, "ffffffff");
  std::string later = kLine2209;
  const auto records = read("#INSPVAA,COM1;other\n" + damaged + "\n" + later + "\n");
  ASSERT_EQ(records.size(), 1U);
  EXPECT_EQ(records[0].line, 3U);
  ASSERT_EQ(bad_.size(), 1U);
  EXPECT_EQ(bad_[0].line, 2U);
  EXPECT_EQ(bad_[0].reason, "has the CRC ffffffff; expected a5db8c7b");
  EXPECT_EQ(others_, 1U);
}

TEST_F(NovatelReader, FindsEveryFlippedBitOfALine) {
  const std::string line = kLine1692;
  for (std::size_t i = 1; i < line.rfind('*'); ++i) {
    for (int bit = 0; bit < 7; ++bit) {
      std::string flipped = line;
      flipped[i] = static_cast<char>(flipped[i] ^ (1 << bit));
      NovatelLine parts;
      EXPECT_TRUE(split_novatel(flipped, parts).has_value()) << flipped;
    }
  }
}

TEST_F(NovatelReader, TakesALineWithoutACrc) {
  const std::string line = kLine1692;
  EXPECT_EQ(read(line.substr(0, line.rfind('*'))).size(), 1U);
}

TEST_F(NovatelReader, SaysWhatIsWrongWithALine) {
  EXPECT_EQ(reason_for(with_crc("%RAWIMUSXA,1,2;00,99,1,2,00,1,2,3,4,5,6")),
            "is of the IMU type 99, which is not known");
  EXPECT_EQ(reason_for(with_crc("%RAWIMUSXA,1,2;00,11,1,2,00,1,2,3,4,5")), "has 10 fields; expected 11");
  EXPECT_EQ(reason_for(with_crc("%RAWIMUSXA,1,2;00,11,1,2,00,1,2,3,4,5,4294967296")),
            "has '4294967296' where a count of 32 bits is expected");
  EXPECT_EQ(reason_for(with_crc("%RAWIMUSXA,1,2;00,11,x,2,00,1,2,3,4,5,6")), "has no GPS week and seconds of week");
  EXPECT_EQ(reason_for(with_crc("%RAWIMUSXA,1,2;00,11,1,2,zz,1,2,3,4,5,6")),
            "has no status word of hexadecimal digits");
  EXPECT_EQ(reason_for(with_crc("%RAWIMUSXA,1;00,11,1,2,00,1,2,3,4,5,6")), "has 1 header fields; expected 2");
  EXPECT_EQ(reason_for("%RAWIMUSXA,1,2,00,11,1,2,00,1,2,3,4,5,6"), "has no ; between header and fields");
  EXPECT_EQ(reason_for("%RAWIMUSXA,1,2;00,11*xyz"), "ends in '*xyz'; expected * and a CRC");
  EXPECT_EQ(reason_for(with_crc("%RAWIMUSA,1,2;1,2,00,1,2,3,4,5,6")),
            "does not say the IMU type; expected to be told it");
}

TEST_F(NovatelReader, DoesNotGoBackInTime) {
  const auto records = read(std::string(kLine2209) + "\n" + kLine1692 + "\n");
  EXPECT_EQ(records.size(), 1U);
  ASSERT_EQ(bad_.size(), 1U);
  EXPECT_EQ(bad_[0].reason, "is not later than the sample before");
}

TEST_F(NovatelReader, ReadsAllFourMessages) {
  const std::string fields = "1692,484620.66,00801503,43110635,-817242,-202184,-215194,-41188,-9895";
  const std::string header = ",COM1,0,52.5,FINESTEERING,1692,484620.660,02000000,18bc,16649;";
  NovatelImuReader::Options told;
  told.imu_type = 11;
  for (const std::string& line :
       {"%RAWIMUSA,1692,484620.660;" + fields, "#RAWIMUA" + header + fields, "#RAWIMUXA" + header + "00,11," + fields,
        "%RAWIMUSXA,1692,484620.660;00,11," + fields}) {
    const auto records = read(with_crc(line), told);
    ASSERT_EQ(records.size(), 1U) << line << ": " << bad_.front().reason;
    EXPECT_EQ(records[0].imu_type, 11U);
  }
  told.imu_type = 32;
  EXPECT_EQ(reason_for(with_crc("#RAWIMUXA" + header + "00,11," + fields), told), "is of the IMU type 11; expected 32");
}

TEST_F(NovatelReader, ReadsTheRealLinesThatLieBesideTheProject) {
  const std::filesystem::path file =
      std::filesystem::path(INSLAB_SOURCE_DIR).parent_path() / "shared" / "data" / "novatel" / "edie_test_lines.txt";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  // Its lines are of different units and in no order of time: each is read by itself.
  files::TextLines lines(file.string());
  std::string_view line;
  std::size_t good = 0;
  std::size_t bad = 0;
  while (lines.next(line)) {
    NovatelLine parts;
    const auto problem = split_novatel(line, parts);
    ++(problem ? bad : good);
    if (problem) {
      EXPECT_EQ(*problem, "has the CRC ffffffff; expected a5db8c7b");
    }
  }
  EXPECT_EQ(bad, 1U);
  EXPECT_GT(good, 15U);
}

TEST(NovatelFormatter, WritesARealLineAgain) {
  // The counts of the second line at the top, with its time and type; status and info bits are 0 in what we write.
  const NovatelImuType& type = *find_novatel_imu_type(41);
  NovatelImuFormatter format(41, NovatelAxes::ForwardRightDown);
  const std::string line =
      format.line({2209, 491'674'013'699'000}, nav::Vector3(-1000837, -417138, 196192) * type.rad_per_count,
                  nav::Vector3(4508389, 2706935, 329308016) * type.m_per_s_per_count);
  EXPECT_EQ(
      line,
      with_crc("%RAWIMUSXA,2209,491674.014;00,41,2209,491674.013699000,00000000,329308016,-2706935,4508389,196192,"
               "417138,-1000837"));
}

TEST(NovatelFormatter, RefusesWhatItCannotHold) {
  EXPECT_THROW(NovatelImuFormatter(99, NovatelAxes::RightForwardUp), std::invalid_argument);
  NovatelImuFormatter format(26, NovatelAxes::RightForwardUp);
  EXPECT_THROW(format.line({}, nav::Vector3::Zero(), nav::Vector3(0.0, 0.0, 50.0)), std::range_error);
  EXPECT_THROW(format.line({}, nav::Vector3(std::nan(""), 0.0, 0.0), nav::Vector3::Zero()), std::range_error);
}

TEST(NovatelScale, AgreesWithThePublishedFigures) {
  // A few of each kind, to the 15 digits in which the driver's formulas give them.
  const auto expect = [](std::uint32_t number, double rad, double m_per_s) {
    const NovatelImuType* type = find_novatel_imu_type(number);
    ASSERT_NE(type, nullptr);
    EXPECT_NEAR(type->rad_per_count / rad, 1.0, 1e-14) << type->name;
    EXPECT_NEAR(type->m_per_s_per_count / m_per_s, 1.0, 1e-14) << type->name;
  };
  expect(1, 1.16415321826935e-10, 2.27093696594238e-09);
  expect(4, 1.16415321826935e-10, 4.54187393188477e-09);
  expect(8, 1.9073486328125e-06, 6.103515625e-05);
  expect(13, 1.89380344183413e-09, 1.52587890625e-06);
  expect(16, 1.08506944444444e-07, 1.52587890625e-06);
  expect(31, 5.85167231706864e-09, 9.31322574615479e-08);
  expect(32, 8.32237840649762e-09, 2.38418579101562e-07);
  expect(41, 1.70442309765071e-11, 2.39420166015625e-10);
  expect(58, 1.16415321826935e-10, 1.86264514923096e-09);
  expect(61, 2.01754426281678e-11, 2.99275207519531e-10);
  EXPECT_EQ(novatel_imu_types().size(), 22U);
}

}  // namespace novatel_test
}  // namespace inslab::novatel
