#include "inslab/data/json/json_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "inslab/scenario/scenario.hpp"

namespace inslab::json {
namespace json_reader_test {

std::string nearest(const std::string& key, const std::vector<std::string>& known) {
  return detail::nearest_key(key, known);
}

TEST(NearestKey, IsTheOneWithALetterWrong) {
  EXPECT_EQ(nearest("durration_s", {"duration_s", "description"}), "duration_s");
  EXPECT_EQ(nearest("imu_rate", {"name", "seed"}), "");
}

TEST(NearestKey, IsTheSameQuantityInAnotherUnit) {
  EXPECT_EQ(nearest("duration_min", {"description", "duration_s", "seed"}), "duration_s");
  EXPECT_EQ(nearest("speed_kmh", {"speed_m_per_s", "roll_deg"}), "speed_m_per_s");
  EXPECT_EQ(nearest("accel_bias_jump_m_per_s2", {"gyro_bias_jump_deg_per_h", "accel_bias_jump_mgal"}),
            "accel_bias_jump_mgal");
}

TEST(NearestKey, PrefersTheMisspellingToTheLongerCommonBeginning) {
  EXPECT_EQ(nearest("bias_gm_sigma_deg_per_g", {"bias_gm_correlation_time_s", "bias_gm_sigma_deg_per_h"}),
            "bias_gm_sigma_deg_per_h");
}

template <class T>
std::string reason(const std::string& text) {
  try {
    struct_from_json<T>(parse_json(text, "f"), "f");
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(JsonReader, AKeyOfAStructWithoutItsTypeIsBlamedOnTheType) {
  EXPECT_EQ(reason<scenario::Motion>(R"({"angle_deg": 90})"), "f: type: missing");
  EXPECT_EQ(reason<scenario::Motion>(R"({"tpye": "turn", "angle_deg": 90})"),
            "f: tpye: unknown key; did you mean 'type'?");
}

TEST(JsonReader, TakesAMotionByItsNumberInTheThesis) {
  const auto type = [](int number) {
    const Json json = parse_json("{\"duration_s\": 1, \"motions\": [{\"type\": " + std::to_string(number) + "}]}", "f");
    try {
      return std::string(enum_name(struct_from_json<scenario::Segment>(json, "f").motions.at(0).type));
    } catch (const Error& error) {
      return error.path();
    }
  };
  EXPECT_EQ(type(1), "uniform");
  EXPECT_EQ(type(2), "motions[0].speed_change_m_per_s");
  EXPECT_EQ(type(0), "motions[0].type");
  EXPECT_EQ(type(11), "motions[0].type");
  EXPECT_EQ(type(-1), "motions[0].type");
}

TEST(JsonReader, GivesEveryNumberTheMotionOfItsName) {
  const std::vector<std::pair<int, std::string>> table{{1, "uniform"},        {2, "delta_speed"},   {3, "target_speed"},
                                                       {4, "constant_accel"}, {5, "sine_accel"},    {6, "ramp_accel"},
                                                       {7, "turn"},           {8, "constant_rate"}, {9, "sine_rate"},
                                                       {91, "cosine_rate"},   {10, "ramp_rate"}};
  for (const auto& [number, name] : table) {
    ASSERT_TRUE(enum_of_number<scenario::MotionType>(number)) << number;
    EXPECT_EQ(enum_name(*enum_of_number<scenario::MotionType>(number)), name);
  }
}

TEST(JsonReader, TakesOneNumberForAllAxes) {
  const auto profile = struct_from_json<InstallationProfile>(parse_json(R"({"lever_arm_v_m": 2})", "f"), "f");
  EXPECT_EQ(profile.lever_arm_v_m, Vector3(2.0, 2.0, 2.0));
}

TEST(JsonReader, KeepsTheDefaultsOfAbsentKeys) {
  const auto profile = struct_from_json<GnssErrorProfile>(
      parse_json(R"({"fix_type": "fixed", "position_sigma_ned_m": 1, "velocity_sigma_ned_m_per_s": 1})", "f"), "f");
  EXPECT_EQ(profile.satellites, GnssErrorProfile{}.satellites);
  EXPECT_EQ(profile.fix_type, FixType::Fixed);
}

TEST(JsonReader, TakesNamesOfEveryScriptAndNoControlCharacters) {
  const auto name = [](const std::string& text) {
    return reason<InstallationProfile>("{\"name\": \"" + text + "\", \"lever_arm_v_m\": 2}");
  };
  EXPECT_EQ(name("\xe8\xbd\xa6 1"), "accepted");
  EXPECT_EQ(name("\\u001b[31mred"), "f: name: is '\\x1b[31mred'; expected one line without control characters");
}

TEST(JsonReader, AnswersAnUnknownWordWithTheOneThatWasMeant) {
  EXPECT_EQ(reason<scenario::Motion>(R"({"type": "trun"})").substr(0, 34), "f: type: is 'trun'; expected one o");
  EXPECT_THAT(reason<scenario::Motion>(R"({"type": "trun"})"), testing::EndsWith("; did you mean 'turn'?"));
}

TEST(JsonReader, DoesNotTakeAWholeNumberGivenAsAFraction) {
  EXPECT_EQ(reason<FaultProfile>(R"({"outage": 0})"), "f: outage: is a number; expected true or false");
  EXPECT_EQ(reason<scenario::ImuSensor>(R"({"number": 0.0, "rate_hz": 200})"),
            "f: number: is a number; expected a whole number");
}

}  // namespace json_reader_test
}  // namespace inslab::json
