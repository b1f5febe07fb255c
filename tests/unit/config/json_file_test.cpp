#include "config/json_file.hpp"

#include <gtest/gtest.h>

#include "config/error.hpp"
#include "tests/unit/io/temporary_folder.hpp"

namespace inslab::config {
namespace {

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

TEST(JsonText, DeepNestingIsNoWayToCrash) {
  const std::string deep = std::string(100'000, '[') + std::string(100'000, ']');
  EXPECT_NO_THROW(parse_json(deep, "file.json"));
  EXPECT_THROW(parse_json(std::string(100'000, '['), "file.json"), Error);
}

TEST(JsonText, BytesThatAreNoUtf8AreRefused) { EXPECT_THROW(parse_json("{\"a\": \"\xff\xfe\"}", "file.json"), Error); }

}  // namespace
}  // namespace inslab::config
