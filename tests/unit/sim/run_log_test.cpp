#include "inslab/sim/run_log.hpp"

#include <map>

#include "inslab/data/json/json_reader.hpp"
#include "inslab/formats/mcap/mcap_reader.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"
#include "tests/unit/foundation/fields/field_bits.hpp"
#include "tests/unit/foundation/fields/number_fields.hpp"

namespace inslab::sim {
namespace run_log_test {

class RunLogFile : public test::TemporaryFolder {
 protected:
  void write(const std::vector<catalog::AnyProfile>& entries, const std::vector<ProfileAck>& acks = {}) {
    RunLog log(path("run.mcap"), scenario_, "x86-64");
    for (const catalog::AnyProfile& entry : entries) log.add_profile(entry);
    for (const ProfileAck& ack : acks) log.add_ack(ack);
    log.file().close();
    const mcap::McapReader reader(path("run.mcap"));
    for (const auto& record : reader.metadata()) metadata_[record.name] = record.values;
  }

  template <class T>
  T read_back(const std::string& record) {
    return json::struct_from_json<T>(json::parse_json(metadata_.at(record).at("json"), record), record);
  }

  scenario::LoadedScenario scenario_ = scenario::load(std::string(INSLAB_SOURCE_DIR) + "/config/scenarios/demo.json");
  std::map<std::string, mcap::StringMap> metadata_;
};

template <class Profile>
Profile random_profile(std::uint32_t journal_number) {
  std::mt19937_64 engine(journal_number);
  Profile profile;
  test::ValidFiller filler(&engine);
  Profile::fields(profile, filler);
  profile.target = Profile{}.target;
  profile.request = {};
  profile.request.journal_number = journal_number;
  return profile;
}

TEST_F(RunLogFile, KeepsTheScenarioAsItWasRead) {
  write({});
  EXPECT_EQ(metadata_.at("scenario").at("name"), "demo");
  EXPECT_EQ(metadata_.at("scenario").at("file"), "demo.json");
  EXPECT_EQ(test::bits_of(read_back<scenario::Scenario>("scenario")), test::bits_of(scenario_.scenario));
  EXPECT_EQ(metadata_.at("build").at("cpu_features"), "x86-64");
}

TEST_F(RunLogFile, KeepsTheProfilesTheRunBeganWithAsProfileFiles) {
  write({});
  const auto stim300 = read_back<ImuErrorProfile>("profile/imu_error/imu0/0");
  EXPECT_EQ(test::bits_of(stim300), test::bits_of(scenario_.imus.at(0).errors));
  for (const char* record : {"profile/vibration/imu0/0", "profile/installation/imu0/0", "profile/gnss_error/gnss0/0",
                             "profile/installation/gnss0/0"}) {
    EXPECT_EQ(metadata_.count(record), 1U) << record;
  }
}

TEST_F(RunLogFile, GivesEveryJournalledProfileBackToTheBit) {
  const auto imu = random_profile<ImuErrorProfile>(1);
  const auto vibration = random_profile<VibrationProfile>(2);
  const auto installation = random_profile<InstallationProfile>(3);
  const auto gnss = random_profile<GnssErrorProfile>(4);
  const auto fault = random_profile<FaultProfile>(5);
  write({imu, vibration, installation, gnss, fault});
  const auto expect_same = [this](auto profile) {
    using Profile = decltype(profile);
    const std::uint32_t number = profile.request.journal_number;
    const std::string record = profile_record(Profile::kind, profile.target, number);
    EXPECT_EQ(metadata_.at(record).at("journal_number"), std::to_string(number));
    profile.request = {};
    EXPECT_EQ(test::bits_of(read_back<Profile>(record)), test::bits_of(profile)) << record;
  };
  expect_same(imu);
  expect_same(vibration);
  expect_same(installation);
  expect_same(gnss);
  expect_same(fault);
}

TEST_F(RunLogFile, NumbersAcknowledgements) {
  ProfileAck ack;
  ack.reason = "because";
  write({}, {ack, ack});
  EXPECT_EQ(metadata_.count("ack/1"), 1U);
  EXPECT_EQ(json::parse_json(metadata_.at("ack/2").at("json"), "ack").at("reason"), "because");
}

}  // namespace run_log_test
}  // namespace inslab::sim
