#include "inslab/foundation/fields/rule.hpp"

#include <gtest/gtest.h>

#include <set>

namespace inslab {
namespace rule_test {

TEST(Rule, HasANameOfItsOwnForEach) {
  const auto& names = EnumNames<Rule>::values;
  EXPECT_EQ(std::set<std::string_view>(names.begin(), names.end()).size(), names.size());
  // Spot checks along the list: a name in the wrong place would shift them.
  EXPECT_EQ(enum_name(Rule::Readable), "readable");
  EXPECT_EQ(enum_name(Rule::KnownKey), "known_key");
  EXPECT_EQ(enum_name(Rule::NamedFile), "named_file");
  EXPECT_EQ(enum_name(Rule::ProfileFitsSensor), "profile_fits_sensor");
  EXPECT_EQ(enum_name(Rule::ApplyTime), "apply_time");
}

}  // namespace rule_test
}  // namespace inslab
