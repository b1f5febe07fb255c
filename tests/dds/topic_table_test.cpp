// The table of topics is one list; what must follow it is compared here, so that no topic is forgotten anywhere.

#include <fnmatch.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <memory>
#include <regex>
#include <set>

#include "inslab/bus/client/topic_tap.hpp"
#include "inslab/bus/dds/participant.hpp"
#include "inslab/bus/dds/writer.hpp"
#include "inslab/formats/log/log_types.hpp"
#include "tests/dds/keys.hpp"

namespace inslab::dds {
namespace topic_table_test {

constexpr std::uint32_t kSensor = 3;

struct Row {
  std::string name;
  std::string type;
};

std::vector<Row> table() {
  std::vector<Row> rows;
  topics::for_each(kSensor, [&rows](const auto& topic) {
    using T = typename std::decay_t<decltype(topic)>::Type;
    rows.push_back({topic.name, std::string(catalog::WireType<T>::name)});
  });
  return rows;
}

bool is_block(const Row& row) { return row.name.rfind("inslab/block/", 0) == 0; }

std::string text_of(const std::string& path) {
  std::ifstream file(INSLAB_SOURCE_DIR + ("/" + path));
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// What a role may do, as make-keys signs it.
class Permissions {
 public:
  Permissions(const std::string& keys, const std::string& role) {
    tinyxml2::XMLDocument document;
    EXPECT_EQ(document.LoadFile((keys + "/" + role + ".permissions.xml").c_str()), tinyxml2::XML_SUCCESS) << role;
    const auto* grant = document.RootElement()->FirstChildElement("permissions")->FirstChildElement("grant");
    const auto* rule = grant->FirstChildElement("allow_rule");
    read(rule->FirstChildElement("publish"), written_);
    read(rule->FirstChildElement("subscribe"), read_);
  }
  bool may_write(const std::string& topic) const { return matches(written_, topic); }
  bool may_read(const std::string& topic) const { return matches(read_, topic); }

 private:
  static void read(const tinyxml2::XMLElement* rule, std::vector<std::string>& patterns) {
    for (const auto* topic = rule->FirstChildElement("topics")->FirstChildElement("topic"); topic != nullptr;
         topic = topic->NextSiblingElement("topic")) {
      patterns.emplace_back(topic->GetText());
    }
  }
  static bool matches(const std::vector<std::string>& patterns, const std::string& topic) {
    return std::any_of(patterns.begin(), patterns.end(), [&topic](const std::string& pattern) {
      return fnmatch(pattern.c_str(), topic.c_str(), 0) == 0;
    });
  }
  std::vector<std::string> written_;
  std::vector<std::string> read_;
};

/// Whose topic it is.
std::string writer_role(const std::string& topic) {
  const auto begins = [&topic](const char* prefix) { return topic.rfind(prefix, 0) == 0; };
  std::string sensor;
  for_each(catalog::SensorSamples{}, [&](auto tag) {
    using Sample = typename decltype(tag)::type;
    const std::string stream = catalog::stream_topic<Sample>(kSensor);
    if (topic == stream || topic == catalog::block_topic(stream)) sensor = catalog::SourceOf<Sample>::service;
  });
  if (!sensor.empty()) return sensor;
  if (begins("inslab/nav") || begins("inslab/block/nav")) return "nav-app";
  if (begins("inslab/profile/") || begins("inslab/sim/command")) return "operator";
  if (topic == "inslab/vehicle_state") return "vehicle-simulator";
  return "inslab-trajectory-server";  // among others for acknowledgements, statuses and credits
}

/// Topics that services in several roles write.
bool has_many_writers(const std::string& topic) {
  return topic == "inslab/profile_ack" || topic == "inslab/service_status" || topic == "inslab/credit";
}

class TopicTable : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    keys_ = std::make_unique<Keys>();
    std::set<std::string> roles{catalog::kOperatorIdentity, catalog::kNavAppIdentity, catalog::kVehicleIdentity};
    for (const catalog::Service& service : catalog::services()) {
      roles.insert(std::string(catalog::security_identity(service.name)));
    }
    for (const std::string& role : roles) roles_.emplace(role, Permissions(keys_->path(), role));
  }
  static void TearDownTestSuite() {
    keys_.reset();
    roles_.clear();
  }

  static std::unique_ptr<Keys> keys_;
  static std::map<std::string, Permissions> roles_;
};
std::unique_ptr<Keys> TopicTable::keys_;
std::map<std::string, Permissions> TopicTable::roles_;

TEST_F(TopicTable, HasEveryNameThatTheCodeKnows) {
  const std::string names = text_of("common/data/catalog/topics.hpp");
  const std::regex literal("\"(inslab/[a-z_/]+)\"");
  std::set<std::string> known;
  for (std::sregex_iterator at(names.begin(), names.end(), literal), end; at != end; ++at) known.insert((*at)[1]);
  ASSERT_GE(known.size(), 14U);
  for (const std::string& name : known) {
    const auto rows = table();
    const bool visited = std::any_of(rows.begin(), rows.end(), [&name](const Row& row) {
      return row.name == name || (name.back() == '/' && row.name.rfind(name, 0) == 0);
    });
    EXPECT_TRUE(visited) << name << " is not among topics::for_each";
  }
}

TEST_F(TopicTable, HasEveryTypeOfTheWire) {
  std::set<std::string> types;
  for (const Row& row : table()) types.insert(row.type);
  for (const log::LogType& type : log::log_types()) EXPECT_EQ(types.count(std::string(type.name)), 1U) << type.name;
}

TEST_F(TopicTable, HasATapForEachButTheBlocks) {
  ParticipantOptions options;
  options.name = "tapping";
  options.domain = 40 + static_cast<std::uint32_t>(getpid() % 150);
  Participant participant(options);
  for (const Row& row : table()) {
    const auto tap = [&] { const client::TopicTap opened(participant, row.name, [](const client::TappedMessage&) {}); };
    if (is_block(row)) {
      EXPECT_THROW(tap(), std::invalid_argument) << row.name;
    } else {
      EXPECT_NO_THROW(tap()) << row.name;
    }
  }
}

TEST_F(TopicTable, LetsTheRoleThatWritesATopicWriteItAndNoOther) {
  for (const Row& row : table()) {
    EXPECT_TRUE(roles_.at(writer_role(row.name)).may_write(row.name)) << row.name;
    if (has_many_writers(row.name)) continue;
    for (const auto& [role, permissions] : roles_) {
      EXPECT_EQ(permissions.may_write(row.name), role == writer_role(row.name)) << role << " " << row.name;
    }
  }
}

TEST_F(TopicTable, LetsTheLoggerAndTheOperatorReadEverything) {
  for (const Row& row : table()) {
    EXPECT_TRUE(roles_.at("inslab-truth-logger").may_read(row.name)) << row.name;
    EXPECT_TRUE(roles_.at("operator").may_read(row.name)) << row.name;
  }
}

TEST_F(TopicTable, KeepsTheTruthFromTheAppUnderTest) {
  const std::set<std::string> for_the_app{
      "inslab/imu/3",        "inslab/block/imu/3",       "inslab/gnss/3",         "inslab/block/gnss/3",
      "inslab/gnss_pps/3",   "inslab/block/gnss_pps/3",  "inslab/magnetometer/3", "inslab/block/magnetometer/3",
      "inslab/barometer/3",  "inslab/block/barometer/3", "inslab/odometer/3",     "inslab/block/odometer/3",
      "inslab/heading/3",    "inslab/block/heading/3",   "inslab/air_data/3",     "inslab/block/air_data/3",
      "inslab/installation", "inslab/sim/status",        "inslab/service_status", "inslab/credit"};
  for (const Row& row : table()) {
    EXPECT_EQ(roles_.at("nav-app").may_read(row.name), for_the_app.count(row.name) == 1) << row.name;
  }
}

TEST(KeysOfUnits, HoldInThoseAlone) {
  const Keys keys("truck car.1");
  ASSERT_TRUE(keys.made());
  ParticipantOptions options;
  options.name = options.role = "operator";
  options.domain = 40 + static_cast<std::uint32_t>(getpid() % 150);
  options.security = keys.path();
  const auto command = [&options](const char* unit) {
    options.unit = unit;
    Participant participant(options);
    const Writer<SimCommand> writer(participant, topics::sim_command());
  };
  EXPECT_NO_THROW(command("truck"));
  EXPECT_THROW(command("van"), std::runtime_error);
  EXPECT_THROW(command(""), std::runtime_error);
}

TEST(KeysOfUnits, AreNotMadeForAPattern) { EXPECT_FALSE(Keys("'*'").made()); }

}  // namespace topic_table_test
}  // namespace inslab::dds
