#include "samples/plain_text.hpp"

#include <gtest/gtest.h>

namespace inslab {
namespace plain_text_test {

TEST(PlainText, IsOneLineOfUtf8) {
  EXPECT_TRUE(is_plain_text(""));
  EXPECT_TRUE(is_plain_text("inslab/imu/0, 20 °C, λ, 真, 🛰"));
  for (const char* odd : {"two\nlines", "\x1b[2J", "\x7f", "\xc2\x85"}) EXPECT_FALSE(is_plain_text(odd)) << odd;
  EXPECT_FALSE(is_plain_text(std::string(1, '\0')));
}

/// RFC 3629, and the bytes next to what it admits.
TEST(PlainText, IsNotWhatOnlyLooksLikeUtf8) {
  const char* broken[] = {"\x80",
                          "\xff",
                          "\xc3",
                          "\xc3(",
                          "\xc0\xaf",
                          "\xc1\xbf",
                          "\xe0\x9f\xbf",
                          "\xed\xa0\x80",
                          "\xe2\x82",
                          "\xf0\x8f\xbf\xbf",
                          "\xf0\x9f\x9b",
                          "\xf4\x90\x80\x80",
                          "\xf5\x80\x80\x80"};
  for (const char* text : broken) EXPECT_FALSE(is_plain_text(text)) << plain_text(text);
  for (const char* text : {"\xc2\xa0", "\xdf\xbf", "\xe0\xa0\x80", "\xed\x9f\xbf", "\xef\xbf\xbf", "\xf0\x90\x80\x80",
                           "\xf4\x8f\xbf\xbf"}) {
    EXPECT_TRUE(is_plain_text(text)) << plain_text(text);
  }
}

TEST(PlainText, ShowsWhatIsNotAsHexadecimalDigits) {
  EXPECT_EQ(plain_text("a\x1b[31mb\xff"
                       "c\n"),
            "a\\x1b[31mb\\xffc\\x0a");
  EXPECT_EQ(plain_text("20 °C"), "20 °C");
}

TEST(PlainText, IsCutBetweenCharacters) {
  EXPECT_EQ(plain_text("abc", 2), "ab");
  EXPECT_EQ(plain_text("ab°", 3), "ab");
  EXPECT_EQ(plain_text("ab°", 4), "ab°");
  EXPECT_EQ(plain_text("ab\x1b", 5), "ab");
}

}  // namespace plain_text_test
}  // namespace inslab
