#include "inslab/data/broadcast/message_field.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "inslab/foundation/units/units.hpp"

namespace inslab::broadcast {
namespace message_field_test {

using ::testing::HasSubstr;

const MessageField<KeplerianEphemeris>& keplerian_field(std::string_view name) {
  for (const auto& field : keplerian_fields()) {
    if (field.name == name) return field;
  }
  throw std::out_of_range(std::string(name));
}

// Whole numbers times the scale factors of IS-GPS-200, tables 20-I and 20-III, written out by hand.
TEST(MessageFields, ScaleFactorsOfGps) {
  KeplerianEphemeris e;
  e.message = KeplerianMessage::Lnav;
  e.af0_s = 3.0 / 2147483648.0;
  e.af1_s_per_s = -5.0 / 8796093022208.0;
  e.crs_m = 7.0 / 32.0;
  e.m0_rad = units::kPi * 11.0 / 2147483648.0;
  e.eccentricity = 13.0 / 8589934592.0;
  e.sqrt_a_sqrt_m = 17.0 / 524288.0;
  e.cuc_rad = 19.0 / 536870912.0;
  e.first_delay_s = -23.0 / 2147483648.0;
  e.i_dot_rad_per_s = units::kPi * 29.0 / 8796093022208.0;
  const std::vector<std::pair<std::string_view, std::int64_t>> expected{
      {"af0_s", 3},          {"af1_s_per_s", -5}, {"crs_m", 7},           {"m0_rad", 11},         {"eccentricity", 13},
      {"sqrt_a_sqrt_m", 17}, {"cuc_rad", 19},     {"first_delay_s", -23}, {"i_dot_rad_per_s", 29}};
  for (const auto& [name, number] : expected) {
    const auto& field = keplerian_field(name);
    EXPECT_EQ(broadcast_number(field, coding_of(field, e.message), Sign::TwosComplement, field.value(e)), number)
        << name;
  }
}

TEST(MessageFields, RoundsToTheNearestNumber) {
  KeplerianEphemeris e;
  e.message = KeplerianMessage::D1;
  e.first_delay_s = 1.26e-9;  // tenths of a nanosecond
  e.crs_m = 1.0 / 64.0 + 0.4 / 64.0;
  const KeplerianEphemeris rounded = as_broadcast(e);
  EXPECT_DOUBLE_EQ(rounded.first_delay_s, 1.3e-9);
  EXPECT_EQ(rounded.crs_m, 1.0 / 64.0);
}

TEST(MessageFields, GpsHasNoSecondDelay) {
  KeplerianEphemeris e;
  e.second_delay_s = 5e-9;
  EXPECT_EQ(as_broadcast(e).second_delay_s, 0.0);
  e.message = KeplerianMessage::Inav;
  EXPECT_NEAR(as_broadcast(e).second_delay_s, 5e-9, 1.2e-10);  // half of 2^-32
}

TEST(MessageFields, WhatDoesNotFitIsRefusedByName) {
  KeplerianEphemeris e;
  e.first_delay_s = 127.4 / 2147483648.0;
  EXPECT_EQ(as_broadcast(e).first_delay_s, 127.0 / 2147483648.0);
  e.first_delay_s = 127.6 / 2147483648.0;
  try {
    as_broadcast(e);
    FAIL();
  } catch (const std::range_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("first_delay_s: is 127.6"));
    EXPECT_THAT(error.what(), HasSubstr("-128 to 127"));
  }
}

TEST(MessageFields, HalfATurnIsMinusHalfATurn) {
  KeplerianEphemeris e;
  e.m0_rad = units::kPi;
  e.omega0_rad = -units::kPi;
  const KeplerianEphemeris rounded = as_broadcast(e);
  EXPECT_DOUBLE_EQ(rounded.m0_rad, -units::kPi);
  EXPECT_DOUBLE_EQ(rounded.omega0_rad, -units::kPi);
}

// GLONASS: sign and magnitude, so that -16 of five bits is not to be had.
TEST(MessageFields, GlonassInKilometresWithSignAndMagnitude) {
  GlonassEphemeris e;
  e.r_e_m = {1000.0 * 5.0 / 2048.0 + 0.2, 0.0, 0.0};
  e.v_e_m_per_s.y() = -1000.0 * 3.0 / 1048576.0;
  e.lunisolar_e_m_per_s2.z() = -15.0 * 1000.0 / 1073741824.0;
  e.tau_s = 9.0 / 1073741824.0;
  const GlonassEphemeris rounded = as_broadcast(e);
  EXPECT_DOUBLE_EQ(rounded.r_e_m.x(), 1000.0 * 5.0 / 2048.0);
  EXPECT_DOUBLE_EQ(rounded.v_e_m_per_s.y(), e.v_e_m_per_s.y());
  EXPECT_DOUBLE_EQ(rounded.lunisolar_e_m_per_s2.z(), e.lunisolar_e_m_per_s2.z());
  EXPECT_EQ(rounded.tau_s, e.tau_s);
  e.lunisolar_e_m_per_s2.z() = -16.0 * 1000.0 / 1073741824.0;
  EXPECT_THROW(as_broadcast(e), std::range_error);
}

TEST(MessageFields, UnitsOfTheTimesOfReference) {
  EXPECT_EQ(reference_time_unit_s(KeplerianMessage::Lnav), 16);
  EXPECT_EQ(reference_time_unit_s(KeplerianMessage::Fnav), 60);
  EXPECT_EQ(reference_time_unit_s(KeplerianMessage::D2), 8);
}

}  // namespace message_field_test
}  // namespace inslab::broadcast
