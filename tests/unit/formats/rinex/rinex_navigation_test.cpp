#include "inslab/formats/rinex/rinex_navigation.hpp"

#include <gmock/gmock.h>

#include "inslab/foundation/files/file_error.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::rinex {
namespace rinex_navigation_test {

using ::testing::EndsWith;
using ::testing::HasSubstr;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

std::string fixture(const std::string& name) { return INSLAB_SOURCE_DIR "/tests/data/gnss/" + name; }

class RinexNavigation : public test::TemporaryFolder {
 protected:
  /// The text of a fixture with `from` replaced by `to` where it first stands.
  std::string damaged(const std::string& name, const std::string& from, const std::string& to) const {
    std::string text = contents(fixture(name));
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos);
    return text.replace(at, from.size(), to);
  }

  /// What the reader says of a text.
  std::string refusal(const std::string& text) const {
    const std::string file = path("damaged.rnx");
    put(file, text);
    try {
      read_navigation(file);
    } catch (const files::ReadError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(RinexNavigation, MixedFileOfVersion305) {
  const NavigationFile file = read_navigation(fixture("mixed_305.rnx"));
  EXPECT_EQ(file.version, 3.05);
  ASSERT_EQ(file.keplerian.size(), 6u);
  ASSERT_EQ(file.glonass.size(), 2u);
  EXPECT_EQ(file.other_records, 1u);  // SBAS
  std::string names;
  for (const auto& record : file.keplerian) names += name_of(record.ephemeris.satellite);
  EXPECT_EQ(names, "G01E01C01C06C19J02");
  EXPECT_EQ(file.keplerian[0].line, 10u);
  EXPECT_EQ(file.keplerian[1].line, 18u);
}

TEST_F(RinexNavigation, EveryNumberOfAGpsRecordStandsInItsPlace) {
  const KeplerianEphemeris e = read_navigation(fixture("mixed_305.rnx")).keplerian[0].ephemeris;
  EXPECT_EQ(e.message, KeplerianMessage::Lnav);
  EXPECT_EQ(e.toc, (time::GpsTime{2244, 36000 * kSecond_ns}));
  EXPECT_EQ(e.toe, (time::GpsTime{2244, 36000 * kSecond_ns}));
  EXPECT_EQ(e.transmitted, (time::GpsTime{2244, 28818 * kSecond_ns}));
  EXPECT_EQ(e.af0_s, 2.270820550621e-04);
  EXPECT_EQ(e.af1_s_per_s, -4.774847184308e-12);
  EXPECT_EQ(e.af2_s_per_s2, 0.0);
  EXPECT_EQ(e.issue, 8u);
  EXPECT_EQ(e.crs_m, 34.375);
  EXPECT_EQ(e.delta_n_rad_per_s, 4.174459597284e-09);
  EXPECT_EQ(e.m0_rad, -9.548742209727e-01);
  EXPECT_EQ(e.cuc_rad, 2.007931470871e-06);
  EXPECT_EQ(e.eccentricity, 1.217735337559e-02);
  EXPECT_EQ(e.cus_rad, 1.018866896629e-06);
  EXPECT_EQ(e.sqrt_a_sqrt_m, 5.153650791168e+03);
  EXPECT_EQ(e.cic_rad, 1.154839992523e-07);
  EXPECT_EQ(e.omega0_rad, -1.509334398430e+00);
  EXPECT_EQ(e.cis_rad, 2.663582563400e-07);
  EXPECT_EQ(e.i0_rad, 9.889889512452e-01);
  EXPECT_EQ(e.crc_m, 374.28125);
  EXPECT_EQ(e.argument_of_perigee_rad, 9.377467184234e-01);
  EXPECT_EQ(e.omega_dot_rad_per_s, -8.216413675181e-09);
  EXPECT_EQ(e.i_dot_rad_per_s, 9.750406143553e-11);
  EXPECT_EQ(e.accuracy_m, 2.0);
  EXPECT_EQ(e.health, 0u);
  EXPECT_EQ(e.first_delay_s, 4.656612873077e-09);
  EXPECT_EQ(e.issue_of_clock, 8u);
}

TEST_F(RinexNavigation, GalileoIsINavWithTwoDelays) {
  const KeplerianEphemeris e = read_navigation(fixture("mixed_305.rnx")).keplerian[1].ephemeris;
  EXPECT_EQ(e.message, KeplerianMessage::Inav);  // data sources 517 = 0x205
  EXPECT_EQ(e.first_delay_s, 2.328306436539e-10);
  EXPECT_EQ(e.second_delay_s, 2.328306436539e-10);
  EXPECT_EQ(e.issue, 59u);
  EXPECT_EQ(e.accuracy_m, 3.12);
}

TEST_F(RinexNavigation, BeiDouCountsItsOwnSeconds) {
  const auto records = read_navigation(fixture("mixed_305.rnx")).keplerian;
  EXPECT_EQ(records[2].ephemeris.message, KeplerianMessage::D2);
  EXPECT_EQ(records[4].ephemeris.message, KeplerianMessage::D1);
  const KeplerianEphemeris& e = records[4].ephemeris;
  EXPECT_EQ(e.toc, (time::GpsTime{2244, 36014 * kSecond_ns}));
  EXPECT_EQ(e.toe, (time::GpsTime{2244, 36014 * kSecond_ns}));
  EXPECT_EQ(e.first_delay_s, 1.01e-8);
  EXPECT_EQ(e.second_delay_s, 1.01e-8);
  EXPECT_EQ(e.issue_of_clock, 1u);
}

// 10:15:00 UTC, 18 leap seconds; kilometres; RINEX writes the clock with the other sign.
TEST_F(RinexNavigation, GlonassInUtcWithOrWithoutItsFourthLine) {
  const auto records = read_navigation(fixture("mixed_305.rnx")).glonass;
  const GlonassEphemeris &first = records[0].ephemeris, &second = records[1].ephemeris;
  EXPECT_EQ(first.tb, (time::GpsTime{2244, (36900 + 18) * kSecond_ns}));
  EXPECT_EQ(first.transmitted, (time::GpsTime{2244, (36030 + 18) * kSecond_ns}));
  EXPECT_EQ(first.tau_s, -2.088211476803e-05);
  EXPECT_DOUBLE_EQ(first.r_e_m.x(), 4.562864746094e+06);
  EXPECT_DOUBLE_EQ(first.v_e_m_per_s.z(), -1.630043029785e+03);
  EXPECT_DOUBLE_EQ(first.lunisolar_e_m_per_s2.y(), 1.862645149231e-06);
  EXPECT_EQ(first.channel, 1);
  EXPECT_EQ(first.delta_tau_s, 0.0);  // .999999999999e+09 is not known
  EXPECT_EQ(second.channel, -4);
  EXPECT_EQ(second.delta_tau_s, 4.656612873077e-09);
}

TEST_F(RinexNavigation, IonosphereOfTheHeader) {
  const NavigationFile file = read_navigation(fixture("mixed_305.rnx"));
  ASSERT_EQ(file.ionosphere.size(), 2u);
  EXPECT_EQ(file.ionosphere[0].system, GnssSystem::Gps);
  EXPECT_EQ(file.ionosphere[0].alpha[2], -1.1921e-07);
  EXPECT_EQ(file.ionosphere[0].beta[3], 2.6214e+05);
  EXPECT_EQ(file.ionosphere[1].system, GnssSystem::BeiDou);
  EXPECT_EQ(file.ionosphere[1].alpha[3], 1.6093e-06);
}

TEST_F(RinexNavigation, Version2OfGpsAndGlonass) {
  const NavigationFile gps = read_navigation(fixture("gps_2.rnx"));
  ASSERT_EQ(gps.keplerian.size(), 1u);
  const KeplerianEphemeris& e = gps.keplerian[0].ephemeris;
  EXPECT_EQ(name_of(e.satellite), "G02");
  EXPECT_EQ(e.toe, (time::GpsTime{1590, 345600 * kSecond_ns}));
  EXPECT_EQ(e.transmitted, (time::GpsTime{1590, 338418 * kSecond_ns}));
  EXPECT_EQ(e.af0_s, 0.269108917564e-03);
  EXPECT_EQ(e.first_delay_s, -0.172294676304e-07);
  ASSERT_EQ(gps.ionosphere.size(), 1u);
  EXPECT_EQ(gps.ionosphere[0].alpha[0], 0.4657e-08);
  EXPECT_EQ(gps.ionosphere[0].beta[3], -0.5243e+06);

  const NavigationFile glonass = read_navigation(fixture("glonass_210.rnx"));
  ASSERT_EQ(glonass.glonass.size(), 1u);
  EXPECT_EQ(name_of(glonass.glonass[0].ephemeris.satellite), "R01");
  EXPECT_EQ(glonass.glonass[0].ephemeris.tb, (time::GpsTime{2111, (3 * 86400 + 85500 + 18) * kSecond_ns}));
  EXPECT_EQ(glonass.glonass[0].ephemeris.transmitted, glonass.glonass[0].ephemeris.tb);
}

TEST_F(RinexNavigation, Version4NamesMessages) {
  const NavigationFile file = read_navigation(fixture("mixed_400.rnx"));
  ASSERT_EQ(file.keplerian.size(), 2u);
  EXPECT_EQ(file.keplerian[0].ephemeris.message, KeplerianMessage::Fnav);
  EXPECT_EQ(file.keplerian[1].ephemeris.message, KeplerianMessage::D1);
  ASSERT_EQ(file.glonass.size(), 1u);
  EXPECT_EQ(file.glonass[0].ephemeris.delta_tau_s, 4.656612873077e-09);
  EXPECT_EQ(file.other_records, 2u);  // STO, and CNAV
  ASSERT_EQ(file.ionosphere.size(), 1u);
  EXPECT_EQ(file.ionosphere[0].alpha[3], 5.9605e-08);
  EXPECT_EQ(file.ionosphere[0].beta[0], 1.4746e+05);
  EXPECT_EQ(file.ionosphere[0].beta[3], 2.6214e+05);
}

// The record of a Saturday's last hours has toe in the week that begins, whatever its week field says.
TEST_F(RinexNavigation, WeekOfToeIsTheOneNearestToToc) {
  put(path("eve.rnx"), damaged("mixed_305.rnx", "3.600000000000e+04 1.154", "6.047840000000e+05 1.154"));
  const KeplerianEphemeris e = read_navigation(path("eve.rnx")).keplerian[0].ephemeris;
  EXPECT_EQ(e.toe, (time::GpsTime{2243, 604784 * kSecond_ns}));
}

// Networks keep such records: a receiver had not heard the message yet.
TEST_F(RinexNavigation, ARecordOfZerosIsCountedAndLeftOut) {
  put(path("zero.rnx"), damaged("mixed_305.rnx", "5.153650791168e+03", "0.000000000000e+00"));
  const NavigationFile file = read_navigation(path("zero.rnx"));
  EXPECT_EQ(file.keplerian.size(), 5u);
  EXPECT_EQ(file.empty_records, 1u);
}

TEST_F(RinexNavigation, ATimeOfTransmissionThatIsUnknownIsThatOfTheState) {
  put(path("unknown.rnx"), damaged("glonass_210.rnx", "8.550000000000D+04", "8.550000000000D+84"));
  const GlonassEphemeris e = read_navigation(path("unknown.rnx")).glonass.at(0).ephemeris;
  EXPECT_EQ(e.transmitted, e.tb);
}

TEST_F(RinexNavigation, ANumberThatIsNoneIsNamedByFileAndLine) {
  const std::string said = refusal(damaged("mixed_305.rnx", "4.174459597284e-09", "4.174459x97284e-09"));
  EXPECT_THAT(said, HasSubstr("damaged.rnx: line 11: has '4.174459x97284e-09' for number 6 of the record"));
}

TEST_F(RinexNavigation, ARecordThatBreaksOffIsNamed) {
  const std::string text = contents(fixture("gps_2.rnx"));
  EXPECT_THAT(refusal(text.substr(0, text.find("    0.200000000000D+01"))),
              HasSubstr("line 12: lacks number 26 of the record, first_delay_s"));
}

TEST_F(RinexNavigation, DatesSatellitesAndLimitsAreChecked) {
  EXPECT_THAT(refusal(damaged("mixed_305.rnx", "G01 2023 01", "G01 2023 13")),
              HasSubstr("line 10: begins with the time '2023 13 08 10 00 00'"));
  EXPECT_THAT(refusal(damaged("mixed_305.rnx", "G01 2023", "X01 2023")), HasSubstr("line 10: begins with 'X01'"));
  EXPECT_THAT(refusal(damaged("mixed_305.rnx", "1.217735337559e-02", "1.217735337559e+02")),
              HasSubstr("line 12: has the eccentricity 121.77"));
  EXPECT_THAT(refusal(damaged("mixed_305.rnx", "5.153650791168e+03", "5.153650791168e+02")),
              HasSubstr("line 12: has the root of the semi-major axis 515.36"));
  EXPECT_THAT(refusal(damaged("mixed_305.rnx", "3.600000000000e+04 1.154", "6.048010000000e+05 1.154")),
              HasSubstr("line 13: has toe 604801"));
}

TEST_F(RinexNavigation, HeadersAreChecked) {
  EXPECT_THAT(refusal("not RINEX\n"), HasSubstr("line 1: is no header of RINEX"));
  EXPECT_THAT(refusal(damaged("mixed_305.rnx", "3.05", "5.00")), HasSubstr("line 1: is version '5.00'"));
  EXPECT_THAT(refusal(damaged("mixed_305.rnx", "N: GNSS NAV DATA", "O: OBSERVATION  ")),
              HasSubstr("line 1: is of the type 'O'"));
  EXPECT_THAT(refusal(damaged("mixed_305.rnx", "END OF HEADER", "COMMENT      ")), EndsWith("expected END OF HEADER"));
}

}  // namespace rinex_navigation_test
}  // namespace inslab::rinex
