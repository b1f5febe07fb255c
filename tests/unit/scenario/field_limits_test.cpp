#include <gtest/gtest.h>

#include "inslab/data/json/json_reader.hpp"
#include "inslab/data/json/json_writer.hpp"
#include "inslab/models/navigation/parameters.hpp"
#include "inslab/scenario/load.hpp"
#include "tests/unit/foundation/fields/number_fields.hpp"

/// Walks the declarations of every file: no field is named here, so a new one is tested from the day it is declared.
namespace inslab::scenario {
namespace field_limits_test {

using json::Json;

template <class T>
T filled() {
  T value;
  test::ValidFiller filler;
  T::fields(value, filler);
  return value;
}

template <class T>
void expect_refusal(const Json& base, const test::NumberField& number, const Json& outside) {
  Json json = base;
  json[Json::json_pointer(number.pointer)] = outside;
  try {
    json::struct_from_json<T>(json, "file.json");
    ADD_FAILURE() << number.path << " = " << outside << " was accepted";
  } catch (const json::Error& error) {
    EXPECT_EQ(error.path(), number.path) << error.what();
    EXPECT_EQ(error.file(), "file.json");
    EXPECT_EQ(error.rule(), Rule::ValueRange) << error.what();
  }
}

template <class T>
void expect_acceptance(const Json& base, const test::NumberField& number, const Json& inside) {
  Json json = base;
  json[Json::json_pointer(number.pointer)] = inside;
  EXPECT_NO_THROW(json::struct_from_json<T>(json, "file.json")) << number.path << " = " << inside;
}

template <class T>
void try_ends_of_whole_number(const Json& base, const test::NumberField& number) {
  if (!std::isfinite(number.minimum)) {
    expect_refusal<T>(base, number, -1);
    return;
  }
  expect_acceptance<T>(base, number, static_cast<std::int64_t>(number.minimum));
  expect_acceptance<T>(base, number, static_cast<std::int64_t>(number.maximum));
  expect_refusal<T>(base, number, static_cast<std::int64_t>(number.minimum) - 1);
  expect_refusal<T>(base, number, static_cast<std::int64_t>(number.maximum) + 1);
}

/// Returns how many numbers there were.
template <class T>
std::size_t try_ends(T value) {
  const Json base = json::json_from_struct(value);
  EXPECT_NO_THROW(json::struct_from_json<T>(base, "file.json"));
  test::NumberFinder finder;
  T::fields(value, finder);
  for (const test::NumberField& number : finder.found) {
    if (number.is_whole) {
      try_ends_of_whole_number<T>(base, number);
      continue;
    }
    EXPECT_TRUE(std::isfinite(number.minimum) && std::isfinite(number.maximum)) << number.path << " has no limits";
    expect_acceptance<T>(base, number, number.minimum);
    expect_acceptance<T>(base, number, number.maximum);
    expect_refusal<T>(base, number, std::nextafter(number.minimum, -INFINITY));
    expect_refusal<T>(base, number, std::nextafter(number.maximum, INFINITY));
    expect_refusal<T>(base, number, std::nan(""));
    expect_refusal<T>(base, number, HUGE_VAL);
  }
  return finder.found.size();
}

TEST(FieldLimits, HoldInEveryProfile) {
  EXPECT_GE(try_ends(filled<ImuErrorProfile>()), 50U);
  EXPECT_GE(try_ends(filled<VibrationProfile>()), 18U);
  EXPECT_GE(try_ends(filled<InstallationProfile>()), 8U);
  EXPECT_GE(try_ends(filled<GnssErrorProfile>()), 12U);
  EXPECT_GE(try_ends(filled<FaultProfile>()), 12U);
}

TEST(FieldLimits, HoldInTheParametersOfANavigationFilter) {
  EXPECT_GE(try_ends(filled<navigation::NavigationParameters>()), 55U);
}

TEST(FieldLimits, HoldInAScenarioWithEveryMotion) {
  for (std::size_t i = 0; i < EnumNames<MotionType>::values.size(); ++i) {
    auto scenario = filled<Scenario>();
    Motion& motion = scenario.trajectory.segments.at(0).motions.at(0);
    motion.type = static_cast<MotionType>(i);
    test::ValidFiller filler;
    Motion::fields(motion, filler);
    EXPECT_GE(try_ends(scenario), 27U) << enum_name(motion.type);
  }
}

TEST(FieldLimits, OfAnUnsigned64BitNumberAreItsOwn) {
  auto scenario = filled<Scenario>();
  scenario.seed = std::numeric_limits<std::uint64_t>::max();
  std::string text = json::json_from_struct(scenario).dump();
  const std::string largest = "18446744073709551615";
  const auto read = [](const std::string& json) {
    return json::struct_from_json<Scenario>(json::parse_json(json, "file.json"), "file.json");
  };
  EXPECT_EQ(read(text).seed, scenario.seed);
  text.replace(text.find(largest), largest.size(), "18446744073709551616");
  EXPECT_THROW(read(text), json::Error);
}

}  // namespace field_limits_test
}  // namespace inslab::scenario
