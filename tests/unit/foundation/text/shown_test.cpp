#include "inslab/foundation/text/shown.hpp"

#include <gtest/gtest.h>

namespace inslab::text {
namespace shown_test {

TEST(ShownText, KeepsEveryScript) {
  for (const char* name :
       {"car 1", "\xd0\xb8\xd0\xbc\xd1\x8f", "\xe8\xbd\xa6\xe8\xbe\x86", "\xf0\x9f\x9a\x97", "\xc3\xa4"}) {
    EXPECT_EQ(shown(name), name);
    EXPECT_TRUE(is_plain(name)) << name;
  }
}

TEST(ShownText, ShowsControlCharactersByTheirNumber) {
  EXPECT_EQ(shown("\x1b[31mred"), "\\x1b[31mred");
  EXPECT_EQ(shown("a\rb\nc\td"), "a\\x0db\\x0ac\\x09d");
  EXPECT_EQ(shown("\x7f"), "\\x7f");
  EXPECT_EQ(shown("\xc2\x9b"), "\\u009b");  // the one-character form of an escape sequence's beginning
  EXPECT_EQ(shown("\xe2\x80\xae"), "\\u202e");
  EXPECT_FALSE(is_plain("\x1b"));
  EXPECT_EQ(shown_lines("a\nb\tc\x1b"), "a\nb\tc\\x1b");
}

TEST(ShownText, ShowsBytesThatAreNotUtf8) {
  EXPECT_EQ(shown("\xff"), "\\xff");
  EXPECT_EQ(shown("\xc3"), "\\xc3");                    // cut
  EXPECT_EQ(shown("\xc0\xaf"), "\\xc0\\xaf");           // longer than needed
  EXPECT_EQ(shown("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // a surrogate
  EXPECT_EQ(shown("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");
}

/// RFC 3629, and the bytes next to what it admits.
TEST(ShownText, IsPlainUpToTheEdgesOfUtf8) {
  for (const char* text : {"\x80", "\xff", "\xc3", "\xc3(", "\xc0\xaf", "\xc1\xbf", "\xe0\x9f\xbf", "\xed\xa0\x80",
                           "\xe2\x82", "\xf0\x8f\xbf\xbf", "\xf0\x9f\x9b", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80"}) {
    EXPECT_FALSE(is_plain(text)) << shown(text);
  }
  for (const char* text : {"", "\xc2\xa0", "\xdf\xbf", "\xe0\xa0\x80", "\xed\x9f\xbf", "\xef\xbf\xbf",
                           "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf"}) {
    EXPECT_TRUE(is_plain(text)) << shown(text);
  }
  EXPECT_FALSE(is_plain(std::string(1, '\0')));
}

TEST(ShownText, QuotesAndCutsBetweenCharacters) {
  EXPECT_EQ(quoted("abc"), "'abc'");
  EXPECT_EQ(quoted("\xc3\xa4\xc3\xb6\xc3\xbc", 2), "'\xc3\xa4\xc3\xb6...'");
  EXPECT_EQ(cut("\xc3\xa4\xc3\xb6", 3), "\xc3\xa4");
  EXPECT_EQ(cut("abc", 64), "abc");
}

TEST(ShownText, MakesFileNamesThatLeadNowhere) {
  EXPECT_EQ(file_name_of("../../etc/passwd"), "_._.._etc_passwd");
  EXPECT_EQ(file_name_of("my car\x1b"), "my_car_");
  EXPECT_EQ(file_name_of("-rf"), "_rf");
  EXPECT_EQ(file_name_of("\xe8\xbd\xa6"), "\xe8\xbd\xa6");
  EXPECT_EQ(file_name_of(""), "_");
}

}  // namespace shown_test
}  // namespace inslab::text
