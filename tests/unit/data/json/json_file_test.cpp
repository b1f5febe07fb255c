#include "inslab/data/json/json_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "inslab/data/json/config_error.hpp"
#include "inslab/foundation/files/input_limits.hpp"
#include "inslab/foundation/text/shown.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::json {
namespace json_file_test {

using ::testing::HasSubstr;
using ::testing::Not;

class JsonFile : public test::TemporaryFolder {};

TEST_F(JsonFile, CutAtAnyByteIsRefused) {
  const std::string text = contents(std::string(INSLAB_SOURCE_DIR) + "/config/scenarios/demo.json");
  const std::size_t end = text.find_last_of('}') + 1;
  EXPECT_NO_THROW(parse_json(text.substr(0, end), "cut.json"));
  for (std::size_t size = 0; size < end; ++size) {
    EXPECT_THROW(parse_json(text.substr(0, size), "cut.json"), Error) << size << " of " << end << " bytes";
  }
}

TEST_F(JsonFile, ErrorsNameTheLine) {
  put(path("bad.json"), "{\n  \"a\": 1,\n  \"b\": oops\n}\n");
  try {
    read_json_file(path("bad.json"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.file(), path("bad.json"));
    EXPECT_EQ(error.path(), "line 3");
  }
}

std::string path_of_double_key(const std::string& text) {
  try {
    parse_json(text, "file.json");
  } catch (const Error& error) {
    EXPECT_EQ(error.rule(), Rule::KeysOnce);
    return error.path();
  }
  return "accepted";
}

TEST(JsonText, AKeyGivenTwiceIsNamedByItsPath) {
  EXPECT_EQ(path_of_double_key(R"({"a": 1, "a": 2})"), "a");
  EXPECT_EQ(path_of_double_key(R"({"a": {"b": [0, {"c": 1}, {"c": 1, "d": [1, 2], "c": 2}]}})"), "a.b[2].c");
  EXPECT_EQ(path_of_double_key(R"([[{}], {"a": {}, "a": {}}])"), "[1].a");
}

TEST(JsonText, TheSameKeyInTwoObjectsIsNoDuplicate) {
  EXPECT_EQ(path_of_double_key(R"({"a": {"a": 1}, "b": [{"a": 1}, {"a": 1}]})"), "accepted");
}

std::string refusal_of(const std::string& text) {
  try {
    parse_json(text, "file.json");
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(JsonText, NestingIsRefusedAtItsLimitWithThePlace) {
  const auto nested = [](std::size_t levels) { return std::string(levels, '[') + std::string(levels, ']'); };
  EXPECT_EQ(refusal_of(nested(files::kMaxJsonLevels)), "accepted");
  EXPECT_THAT(refusal_of(nested(files::kMaxJsonLevels + 1)), HasSubstr("is nested deeper than 32 levels"));
  EXPECT_THAT(refusal_of(std::string(1'000'000, '[')), HasSubstr("[0][0]"));
  std::string objects;
  for (int i = 0; i < 70'000; ++i) objects += "{\"a\":";
  EXPECT_THAT(refusal_of(objects), HasSubstr("a.a.a"));
}

/// What grows quadratically takes an hour here, and what is linear a second.
TEST(JsonText, TimeGrowsWithTheText) {
  std::string wide = "{\"a\": [", keys = "{";
  for (int i = 0; i < 300'000; ++i) {
    wide += std::string(i == 0 ? "" : ",") + "{\"b\": {\"c\": 1, \"d\": 2}, \"e\": 3}";
    keys += std::string(i == 0 ? "" : ",") + "\"k" + std::to_string(i) + "\": [1, 2]";
  }
  EXPECT_EQ(parse_json(wide + "]}", "file.json").at("a").size(), 300'000U);
  EXPECT_EQ(parse_json(keys + "}", "file.json").size(), 300'000U);
}

TEST(JsonText, TooManyValuesAreRefused) {
  std::string many = "[0";
  for (std::size_t i = 0; i < files::kMaxJsonValues; ++i) many += ",0";
  EXPECT_THAT(refusal_of(many + "]"), HasSubstr("[3999999]: is one value too many; expected at most 4000000"));
}

TEST(JsonText, KeepsTheOrderAndTheValues) {
  const std::string text = R"({"b":[1,-2,0.5,true,null,"x"],"a":{"z":{},"y":[]}})";
  EXPECT_EQ(parse_json(text, "file.json").dump(), text);
}

TEST(JsonText, NoWordOfTheLibrarysExceptionsIsInAMessage) {
  for (const char* text : {"1e999", "{\"a\": 1e999}", "[1,", "{\"a\" 1}", "nul", "\"\x1b[31m\"", "{\"a\": \"\xff\"}"}) {
    const std::string message = refusal_of(text);
    EXPECT_THAT(message, HasSubstr("file.json: ")) << text;
    EXPECT_THAT(message, Not(HasSubstr("exception"))) << text;
    EXPECT_TRUE(inslab::text::is_plain(message)) << message;
  }
}

TEST_F(JsonFile, AFileThatIsNotThereIsNamedAsItWasLookedFor) {
  try {
    read_json_file("no_such.json");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("looked for as " + (std::filesystem::current_path() / "no_such.json").string()));
  }
}

TEST(JsonText, BytesThatAreNoUtf8AreRefused) { EXPECT_THROW(parse_json("{\"a\": \"\xff\xfe\"}", "file.json"), Error); }

}  // namespace json_file_test
}  // namespace inslab::json
