#include <gtest/gtest.h>

#include <set>

#include "samples/any_profile.hpp"
#include "wire/topic_names.hpp"
#include "wire/wire_type.hpp"

namespace inslab::wire {
namespace {

TEST(SelfContainedIdl, HasNoPreprocessorLineAndTheTypesItNeeds) {
  const std::string text = self_contained_idl(WireType<ImuSample>::idl_file);
  EXPECT_EQ(text.find("#include"), std::string::npos);
  EXPECT_EQ(text.find("\n#"), std::string::npos);
  const std::size_t header = text.find("struct StreamHeader");
  const std::size_t sample = text.find("struct ImuSample");
  ASSERT_NE(header, std::string::npos);
  ASSERT_NE(sample, std::string::npos);
  EXPECT_LT(header, sample);
}

TEST(SelfContainedIdl, RefusesAFileThatIsNotThere) { EXPECT_THROW(self_contained_idl("no.idl"), std::out_of_range); }

TEST(TopicNames, AreOneForEachStreamAndKind) {
  EXPECT_EQ(topic_names::imu(3), "inslab/imu/3");
  EXPECT_EQ(topic_names::imu_truth(0), "inslab/imu_truth/0");
  EXPECT_EQ(topic_names::gnss(1), "inslab/gnss/1");
  EXPECT_EQ(topic_names::request(ProfileKind::GnssError), "inslab/profile/gnss_error");
  EXPECT_EQ(topic_names::journal(ProfileKind::ImuError), "inslab/journal/imu_error");
}

}  // namespace
}  // namespace inslab::wire
