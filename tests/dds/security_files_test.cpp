#include "inslab/bus/dds/security_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/posix_acl_xattr.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <stdexcept>

#include "tests/dds/keys.hpp"

namespace inslab::dds {
namespace security_files_test {

using testing::AllOf;
using testing::HasSubstr;

class SecurityFilesOf : public testing::Test {
 protected:
  static void SetUpTestSuite() { good_ = new Keys(); }
  static void TearDownTestSuite() {
    delete good_;
    good_ = nullptr;
  }
  void SetUp() override { ASSERT_TRUE(good_->made()) << "deploy/security/make-keys failed"; }

  /// What is said about the operator's files.
  std::string refusal() const {
    try {
      check_security_files(keys.path(), "operator");
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  static Keys* good_;
  const Keys keys{*good_};
};
Keys* SecurityFilesOf::good_ = nullptr;

TEST_F(SecurityFilesOf, MakeKeysAreGood) {
  EXPECT_EQ(refusal(), "");
  for (const char* role : {"inslab-trajectory-server", "inslab-imu-injector", "inslab-gnss-emulator",
                           "inslab-truth-logger", "nav-app", "vehicle-simulator"}) {
    EXPECT_NO_THROW(check_security_files(keys.path(), role)) << role;
  }
}

TEST_F(SecurityFilesOf, AMissingFileIsNamed) {
  for (const char* name :
       {"ca.cert.pem", "operator.cert.pem", "operator.key.pem", "governance.p7s", "operator.permissions.p7s"}) {
    ASSERT_TRUE(keys.run(std::string("mv ") + name + " away")) << name;
    EXPECT_THAT(refusal(), HasSubstr(keys / name + " is not there")) << name;
    ASSERT_TRUE(keys.run(std::string("mv away ") + name));
  }
}

TEST_F(SecurityFilesOf, AnothersKeyIsToldFromItsOwn) {
  ASSERT_TRUE(keys.run("cp -p nav-app.key.pem operator.key.pem"));
  EXPECT_THAT(refusal(), AllOf(HasSubstr("operator.key.pem: is not the key of"), HasSubstr("operator.cert.pem")));
}

TEST_F(SecurityFilesOf, AKeyWithAPasswordIsNotWaitedFor) {
  ASSERT_TRUE(keys.run("openssl ec -in nav-app.key.pem -aes256 -passout pass:word -out operator.key.pem"));
  EXPECT_THAT(refusal(), HasSubstr("operator.key.pem: expected a private key in PEM, without a password"));
}

TEST_F(SecurityFilesOf, AFileThatIsSomethingElseIsNamed) {
  ASSERT_TRUE(keys.run("echo nothing > operator.cert.pem"));
  EXPECT_THAT(refusal(), HasSubstr("operator.cert.pem: expected a certificate in PEM"));
}

TEST_F(SecurityFilesOf, AnExpiredCertificateIsTold) {
  ASSERT_TRUE(
      keys.run("openssl req -new -key operator.key.pem -subj '/O=Inslab/CN=operator' -out csr && "
               "openssl x509 -req -in csr -CA ca.cert.pem -CAkey ca.key.pem -CAcreateserial -days 0 "
               "-out operator.cert.pem"));
  EXPECT_THAT(refusal(), AllOf(HasSubstr("operator.cert.pem: "), HasSubstr("expired")));
}

TEST_F(SecurityFilesOf, NoRoleCanSignPermissions) {
  // As Fast DDS verifies them: by OpenSSL's rules for a signer of S/MIME, against the authority.
  ASSERT_TRUE(keys.run("openssl smime -verify -in nav-app.permissions.p7s -text -CAfile ca.cert.pem"));
  ASSERT_TRUE(
      keys.run("openssl smime -sign -in inslab-trajectory-server.permissions.xml -text -out own.p7s "
               "-signer nav-app.cert.pem -inkey nav-app.key.pem"));
  EXPECT_FALSE(keys.run("openssl smime -verify -in own.p7s -text -CAfile ca.cert.pem"));
}

TEST_F(SecurityFilesOf, ACertificateThatCouldSignIsRefused) {
  ASSERT_TRUE(
      keys.run("openssl req -new -key operator.key.pem -subj '/O=Inslab/CN=operator' -out csr && "
               "openssl x509 -req -in csr -CA ca.cert.pem -CAkey ca.key.pem -CAcreateserial -days 2 "
               "-out operator.cert.pem"));
  EXPECT_THAT(refusal(), HasSubstr("operator.cert.pem: its holder could sign permissions for itself"));
}

TEST_F(SecurityFilesOf, AChangedGovernanceIsTold) {
  ASSERT_TRUE(keys.run("sed -i 's/<max>232</<max>231</' governance.p7s"));
  EXPECT_THAT(refusal(), HasSubstr("governance.p7s: its signature is not good"));
}

TEST_F(SecurityFilesOf, AGovernanceThatWasNeverSignedIsTold) {
  ASSERT_TRUE(keys.run("cp governance.xml governance.p7s"));
  EXPECT_THAT(refusal(), HasSubstr("governance.p7s: expected a document signed by the authority"));
}

TEST_F(SecurityFilesOf, PermissionsOfAnotherAuthorityAreTold) {
  const Keys others;
  ASSERT_TRUE(others.made());
  ASSERT_TRUE(keys.run("cp " + others / "operator.permissions.p7s" + " ."));
  EXPECT_THAT(refusal(), AllOf(HasSubstr("operator.permissions.p7s: its signature is not good"),
                               HasSubstr("another authority than " + keys / "ca.cert.pem")));
}

TEST_F(SecurityFilesOf, DamagedXmlIsToldEvenWhenItIsSigned) {
  ASSERT_TRUE(keys.rewrite("governance", "s/<\\/domain_rule>//"));
  EXPECT_THAT(refusal(), HasSubstr("governance.p7s: its XML is damaged at line"));
}

TEST_F(SecurityFilesOf, AGovernanceThatLeavesHeartbeatsInTheClearIsRefused) {
  ASSERT_TRUE(keys.rewrite("governance", "s/rtps_protection_kind>ENCRYPT/rtps_protection_kind>NONE/"));
  EXPECT_THAT(refusal(), HasSubstr("governance.p7s: rtps_protection_kind is 'NONE'; expected ENCRYPT"));
}

TEST_F(SecurityFilesOf, AGovernanceThatLetsStrangersInIsRefused) {
  ASSERT_TRUE(keys.rewrite("governance", "s/\\(allow_unauthenticated_participants>\\)false/\\1true/"));
  EXPECT_THAT(refusal(), HasSubstr("allow_unauthenticated_participants is 'true'; expected false"));
}

TEST_F(SecurityFilesOf, ExpiredPermissionsAreToldWithTheirDate) {
  ASSERT_TRUE(keys.rewrite("operator.permissions",
                           "s/<not_after>.*<\\/not_after>/<not_after>2020-02-03T04:05:06<\\/not_after>/"));
  EXPECT_THAT(refusal(), HasSubstr("operator.permissions.p7s: has expired at 2020-02-03T04:05:06 UTC"));
}

TEST_F(SecurityFilesOf, PermissionsOfTheFutureAreToldWithTheirDate) {
  ASSERT_TRUE(keys.rewrite("operator.permissions", "s/<not_before>[^<]*</<not_before>2099-02-03T04:05:06</"));
  EXPECT_THAT(refusal(), HasSubstr("operator.permissions.p7s: is not valid before 2099-02-03T04:05:06 UTC"));
}

TEST_F(SecurityFilesOf, AnothersPermissionsAreToldFromItsOwn) {
  ASSERT_TRUE(keys.run("cp nav-app.permissions.p7s operator.permissions.p7s"));
  EXPECT_THAT(refusal(), AllOf(HasSubstr("operator.permissions.p7s: permits nothing to 'CN=operator,O=Inslab'"),
                               HasSubstr("it is for 'CN=nav-app, O=Inslab'")));
}

TEST_F(SecurityFilesOf, AKeyThatOthersMayReadOrWriteIsRefusedWithItsMode) {
  const std::array<std::pair<mode_t, const char*>, 4> modes{{{0640, "read by others than its owner (mode 0640)"},
                                                             {0604, "read by others than its owner (mode 0604)"},
                                                             {0620, "written by others than its owner (mode 0620)"},
                                                             {0606, "read and written by others"}}};
  for (const auto& [mode, said] : modes) {
    ASSERT_EQ(chmod((keys / "operator.key.pem").c_str(), mode), 0);
    EXPECT_THAT(refusal(), AllOf(HasSubstr(keys / "operator.key.pem"), HasSubstr(said)));
  }
  ASSERT_EQ(chmod((keys / "operator.key.pem").c_str(), 0400), 0);
  EXPECT_EQ(refusal(), "");
}

TEST_F(SecurityFilesOf, AnAuthorityThatOthersMayReplaceIsRefused) {
  ASSERT_EQ(chmod((keys / "ca.cert.pem").c_str(), 0666), 0);
  EXPECT_THAT(refusal(), HasSubstr("ca.cert.pem: can be written by others than its owner (mode 0666)"));
}

TEST_F(SecurityFilesOf, AFolderInWhichOthersMayReplaceTheKeysIsRefused) {
  ASSERT_EQ(chmod((keys / ".").c_str(), 0777), 0);
  EXPECT_THAT(refusal(),
              HasSubstr("can be written by others than its owner (mode 0777): whoever writes to the folder"));
  ASSERT_EQ(chmod((keys / ".").c_str(), 0755), 0);
  EXPECT_EQ(refusal(), "");
}

/// Gives one user the right to read a file, as systemd does for the credentials of a service. The mode then shows a
/// right of the group that no group has.
int let_read(const std::string& file, uid_t user) {
  constexpr auto kNobody = static_cast<std::uint32_t>(-1);
  struct {
    posix_acl_xattr_header header{POSIX_ACL_XATTR_VERSION};
    posix_acl_xattr_entry entries[5];
  } list;
  list.entries[0] = {0x01, 6, kNobody};  // the owner
  list.entries[1] = {0x02, 4, user};
  list.entries[2] = {0x04, 0, kNobody};  // the file's group
  list.entries[3] = {0x10, 4, kNobody};  // the most that the list grants
  list.entries[4] = {0x20, 0, kNobody};  // others
  return setxattr(file.c_str(), "system.posix_acl_access", &list, sizeof list, 0);
}

TEST_F(SecurityFilesOf, AnAccessListIsReadAndNotMistakenForAGroup) {
  const std::string key = keys / "operator.key.pem";
  if (let_read(key, geteuid()) != 0) GTEST_SKIP() << "the file system of /tmp has no access lists";
  struct stat status {};
  ASSERT_EQ(stat(key.c_str(), &status), 0);
  ASSERT_EQ(status.st_mode & 0777, 0640u);
  EXPECT_EQ(refusal(), "");
  ASSERT_EQ(let_read(key, geteuid() + 12345), 0);
  EXPECT_THAT(refusal(), HasSubstr("operator.key.pem: can be read by others"));
}

/// The topics of one rule of a role's permissions, as the table in SECURITY.md has them.
std::string topics_of(const std::string& permissions_file, const std::string& rule) {
  std::ifstream file(permissions_file);
  std::string topics;
  bool in_rule = false;
  for (std::string line; std::getline(file, line);) {
    if (line.find("<" + rule + ">") != std::string::npos) in_rule = true;
    if (line.find("</" + rule + ">") != std::string::npos) in_rule = false;
    const std::string before = "<topic>inslab/";
    const std::size_t begin = line.find(before);
    if (!in_rule || begin == std::string::npos) continue;
    const std::size_t name = begin + before.size();
    topics += (topics.empty() ? "`" : ", `") + line.substr(name, line.find('<', name) - name) + "`";
  }
  return topics;
}

TEST_F(SecurityFilesOf, GrantWhatSecurityMdSays) {
  std::string expected;
  for (const char* role : {"inslab-trajectory-server", "inslab-imu-injector", "inslab-gnss-emulator",
                           "inslab-magnetometer", "inslab-barometer", "inslab-odometer", "inslab-heading",
                           "inslab-air-data", "inslab-truth-logger", "operator", "nav-app", "vehicle-simulator"}) {
    const std::string file = keys / (std::string(role) + ".permissions.xml");
    expected +=
        std::string("| ") + role + " | " + topics_of(file, "publish") + " | " + topics_of(file, "subscribe") + " |\n";
  }
  std::ifstream document(INSLAB_SOURCE_DIR "/SECURITY.md");
  std::string documented;
  for (std::string line; std::getline(document, line);) {
    if (line.rfind("| inslab-", 0) != 0 && line.rfind("| operator", 0) != 0 && line.rfind("| nav-app", 0) != 0 &&
        line.rfind("| vehicle-simulator", 0) != 0) {
      continue;
    }
    if (line.find('`') != std::string::npos) documented += line + "\n";
  }
  EXPECT_EQ(documented, expected);
}

}  // namespace security_files_test
}  // namespace inslab::dds
