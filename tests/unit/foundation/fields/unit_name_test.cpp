#include "inslab/foundation/fields/unit_name.hpp"

#include <gtest/gtest.h>

namespace inslab {
namespace unit_name_test {

TEST(UnitName, IsAWord) {
  for (const char* name : {"truck", "UAV-7", "rover_2.left", "0", "..."}) EXPECT_TRUE(is_unit_name(name)) << name;
}

TEST(UnitName, IsNoPatternAndNoText) {
  for (const char* name : {"", "*", "tr?ck", "[ab]", "my car", "a/b", "a\\*", "caf\xc3\xa9", "a\nb"}) {
    EXPECT_FALSE(is_unit_name(name)) << name;
  }
  EXPECT_TRUE(is_unit_name(std::string(64, 'u')));
  EXPECT_FALSE(is_unit_name(std::string(65, 'u')));
}

}  // namespace unit_name_test
}  // namespace inslab
