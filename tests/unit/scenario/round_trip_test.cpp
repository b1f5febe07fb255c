#include <gtest/gtest.h>

#include "inslab/data/json/json_reader.hpp"
#include "inslab/data/json/json_writer.hpp"
#include "inslab/models/navigation/parameters.hpp"
#include "inslab/scenario/scenario.hpp"
#include "tests/unit/foundation/fields/field_bits.hpp"
#include "tests/unit/foundation/fields/number_fields.hpp"

namespace inslab::scenario {
namespace round_trip_test {

/// Clears what files do not hold, as reading one leaves it.
template <class Profile>
void without_request(Profile& profile) {
  profile.target = Profile{}.target;
  profile.request = {};
}
void without_request(Scenario&) {}
void without_request(navigation::NavigationParameters&) {}

template <class T>
class RoundTrip : public testing::Test {};

using Files =
    Applied<testing::Types, Joined<Types<Scenario>, catalog::ProfileKinds, Types<navigation::NavigationParameters>>>;
TYPED_TEST_SUITE(RoundTrip, Files, );

TYPED_TEST(RoundTrip, ThroughJsonTextKeepsEveryBitOfRandomValues) {
  std::mt19937_64 engine(20261122);
  for (int i = 0; i < 200; ++i) {
    TypeParam value;
    test::ValidFiller filler(&engine);
    TypeParam::fields(value, filler);
    without_request(value);
    const std::string text = json::json_from_struct(value).dump(2);
    const auto back = json::struct_from_json<TypeParam>(json::parse_json(text, "file.json"), "file.json");
    ASSERT_EQ(test::bits_of(back), test::bits_of(value)) << text;
  }
}

}  // namespace round_trip_test
}  // namespace inslab::scenario
