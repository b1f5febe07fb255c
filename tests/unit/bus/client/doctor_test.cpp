#include "inslab/bus/client/doctor.hpp"

#include <gmock/gmock.h>

#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::client {
namespace doctor_test {

using testing::HasSubstr;
using Grade = Finding::Grade;

class Doctor : public test::TemporaryFolder {
 protected:
  Findings environment(const std::string& set, const std::string& value) const {
    return examine_environment([&](const char* name) { return name == set ? value : std::string(); }, path(""));
  }
};

TEST_F(Doctor, FindsNothingInACleanEnvironment) {
  const Findings findings = environment("", "");
  ASSERT_EQ(findings.found.size(), 1u);
  EXPECT_EQ(findings.found[0].grade, Grade::Good);
  EXPECT_EQ(findings.to_cure(), 0u);
  EXPECT_EQ(words_of(findings), "environment\n  ok    no variable leads Fast DDS astray\n");
}

TEST_F(Doctor, CuresADiscoveryServerInTheEnvironment) {
  const Findings findings = environment("ROS_DISCOVERY_SERVER", "10.0.0.1:11811");
  EXPECT_EQ(findings.to_cure(), 1u);
  EXPECT_THAT(words_of(findings), HasSubstr("  BAD   ROS_DISCOVERY_SERVER=10.0.0.1:11811 makes this process"));
  EXPECT_THAT(words_of(findings), HasSubstr("        cure: unset it"));
}

TEST_F(Doctor, TellsAProfilesFileThatIsThereFromOneThatIsNot) {
  EXPECT_EQ(environment("FASTDDS_DEFAULT_PROFILES_FILE", path("gone.xml")).to_cure(), 1u);
  put(path("there.xml"), "<dds/>");
  const Findings findings = environment("FASTDDS_DEFAULT_PROFILES_FILE", path("there.xml"));
  EXPECT_EQ(findings.to_cure(), 0u);
  EXPECT_EQ(findings.found[0].grade, Grade::Note);
}

TEST_F(Doctor, NotesSocketBuffersThatAreSmall) {
  put(path("rmem_max"), "212992\n");
  put(path("wmem_max"), "1048576\n");
  const Findings findings = examine_socket_buffers(path(""));
  ASSERT_EQ(findings.found.size(), 2u);
  EXPECT_EQ(findings.found[0].grade, Grade::Note);
  EXPECT_THAT(findings.found[0].what, HasSubstr("net.core.rmem_max = 212992: enough for 1 kHz live"));
  EXPECT_EQ(findings.found[1].grade, Grade::Good);
}

TEST_F(Doctor, FindsAndCleansSegmentsThatNobodyHolds) {
  put(path("fastrtps_0123456789abcdef"), "x");
  put(path("fastrtps_0123456789abcdef_el"), "");
  const Findings found = examine_shared_memory(path(""), false);
  EXPECT_EQ(found.to_cure(), 1u) << words_of(found);
  EXPECT_EQ(found.found[0].cure, "inslab doctor --clean");
  EXPECT_THAT(words_of(examine_shared_memory(path(""), true)), HasSubstr("removed 1 stale segments of 1"));
  EXPECT_THAT(words_of(examine_shared_memory(path(""), false)), HasSubstr("0 segments of Fast DDS, all in use"));
}

TEST_F(Doctor, SaysThatNobodyWasHeardOrThatAllMatch) {
  EXPECT_THAT(words_of(examine_endpoints("domain 7", 0, {})), HasSubstr("nobody was heard"));
  const Findings findings = examine_endpoints("domain 7", 2, {});
  EXPECT_EQ(findings.title, "on the wire, domain 7");
  EXPECT_EQ(findings.found[0].grade, Grade::Good);
}

}  // namespace doctor_test
}  // namespace inslab::client
