// What is declared once is there everywhere: walks the catalogue and asks for everything that a topic, a kind of sensor
// and a kind of profile must have. Readers and taps on the bus are asked for in tests/dds/topic_table_test.cpp.

#include <fnmatch.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "inslab/data/catalog/any_profile.hpp"
#include "inslab/data/catalog/topics.hpp"
#include "inslab/data/catalog/wire_type.hpp"
#include "inslab/data/json/schema_writer.hpp"
#include "inslab/data/wire/cdr.hpp"
#include "inslab/data/wire/idl_text.hpp"
#include "inslab/formats/log/log_types.hpp"
#include "inslab/scenario/document_kind.hpp"
#include "inslab/scenario/scenario.hpp"
#include "inslab/services/inslab/derived/derived_files.hpp"

namespace inslab::catalog {
namespace catalog_test {

using testing::Contains;
using testing::HasSubstr;

constexpr std::uint32_t kSensor = 3;

std::string text_of(const std::string& path) {
  std::ifstream file(INSLAB_SOURCE_DIR + ("/" + path));
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// What the roles may do, as make-keys reads it.
class Roles {
 public:
  struct May {
    std::vector<std::string> write;
    std::vector<std::string> read;
  };

  Roles() {
    std::istringstream words(text_of("deploy/security/roles"));
    std::string name;
    std::vector<std::string>* list = nullptr;
    int quotes = 0;
    for (std::string line; std::getline(words, line);) {
      if (line.rfind('#', 0) == 0) continue;
      std::istringstream parts(line);
      for (std::string word; parts >> word;) {
        if (word == "role") {
          parts >> name;
          quotes = 0;
        } else if (word != "\\") {
          if (word.front() == '\'') list = quotes++ == 0 ? &roles_[name].write : &roles_[name].read;
          word.erase(std::remove(word.begin(), word.end(), '\''), word.end());
          list->push_back(word);
        }
      }
    }
  }

  std::set<std::string> writers_of(const std::string& topic) const { return those(topic, &May::write); }
  std::set<std::string> readers_of(const std::string& topic) const { return those(topic, &May::read); }

 private:
  std::set<std::string> those(const std::string& topic, std::vector<std::string> May::*list) const {
    std::set<std::string> names;
    for (const auto& [name, may] : roles_) {
      const auto matches = [&topic](const std::string& pattern) {
        return fnmatch(pattern.c_str(), topic.c_str(), 0) == 0;
      };
      if (std::any_of((may.*list).begin(), (may.*list).end(), matches)) names.insert(name);
    }
    return names;
  }

  std::map<std::string, May> roles_;
};

/// A topic has a codec, a channel type in logs, IDL, and somebody who may write it and the two who read everything.
template <class T>
void expect_everything(const std::string& topic, const Roles& roles) {
  SCOPED_TRACE(topic);
  EXPECT_EQ(topic.rfind(kRoot, 0), 0u);
  std::vector<std::uint8_t> bytes;
  wire::encode(T(), bytes);
  T again;
  EXPECT_TRUE(wire::decode(bytes.data(), bytes.size(), again));
  EXPECT_NE(log::find_log_type(WireType<T>::name), nullptr);
  const std::string name(WireType<T>::name.substr(kModule.size()));
  EXPECT_THAT(wire::self_contained_idl(WireType<T>::idl_file), HasSubstr("struct " + name + " {"));
  EXPECT_FALSE(roles.writers_of(topic).empty());
  EXPECT_THAT(roles.readers_of(topic), Contains("inslab-truth-logger"));
  EXPECT_THAT(roles.readers_of(topic), Contains("operator"));
}

/// The blocks of a stream have a codec and IDL, and whoever may write the stream may write them.
template <class T>
void expect_blocks(const std::string& topic, const Roles& roles) {
  const std::string blocks = block_topic(topic);
  SCOPED_TRACE(blocks);
  std::vector<std::uint8_t> bytes;
  wire::encode(Block<T>{{T()}}, bytes);
  Block<T> again;
  EXPECT_TRUE(wire::decode(bytes.data(), bytes.size(), again));
  const std::string name(WireType<Block<T>>::name.substr(kModule.size()));
  EXPECT_THAT(wire::self_contained_idl(WireType<Block<T>>::idl_file), HasSubstr("struct " + name + " {"));
  EXPECT_EQ(roles.writers_of(blocks), roles.writers_of(topic));
}

TEST(Topics, EachHasWhatItNeeds) {
  const Roles roles;
  for_each_of(kTopics, [&roles](const auto& topic) {
    using T = typename std::decay_t<decltype(topic)>::Type;
    expect_everything<T>(topic.name, roles);
    if constexpr (std::decay_t<decltype(topic)>::has_blocks) expect_blocks<T>(topic.name, roles);
  });
}

TEST(Topics, AreOneForEachNameOfTheirFile) {
  std::set<std::string> declared;
  for_each_of(kTopics, [&declared](const auto& topic) { declared.insert(topic.name); });
  EXPECT_EQ(declared.size(), std::tuple_size_v<std::decay_t<decltype(kTopics)>>);
  const std::string text = text_of("common/data/catalog/topics.hpp");
  for (std::size_t at = text.find("{\"inslab/"); at != std::string::npos; at = text.find("{\"inslab/", at + 1)) {
    const std::string name = text.substr(at + 2, text.find('"', at + 2) - at - 2);
    EXPECT_THAT(declared, Contains(name)) << "is not among kTopics";
  }
}

TEST(Topics, AreNamedByStreamAndKind) {
  EXPECT_EQ(stream_topic<ImuSample>(3), "inslab/imu/3");
  EXPECT_EQ(stream_topic<ImuTruth>(0), "inslab/imu_truth/0");
  EXPECT_EQ(stream_topic<GnssFix>(1), "inslab/gnss/1");
  EXPECT_EQ(block_topic("inslab/imu/0"), "inslab/block/imu/0");
  EXPECT_EQ(request_topic(ProfileKind::GnssError), "inslab/profile/gnss_error");
  EXPECT_EQ(journal_topic(ProfileKind::ImuError), "inslab/journal/imu_error");
}

TEST(SensorKinds, EachHasTopicsThatItsServiceAloneWrites) {
  const Roles roles;
  for_each(SensorKinds{}, [&roles](auto tag) {
    using Kind = typename decltype(tag)::type;
    for_each(SamplesOf<Kind>{}, [&roles](auto sample) {
      using Sample = typename decltype(sample)::type;
      const std::string topic = stream_topic<Sample>(kSensor);
      expect_everything<Sample>(topic, roles);
      expect_blocks<Sample>(topic, roles);
      EXPECT_EQ(roles.writers_of(topic), std::set<std::string>{Kind::service}) << topic;
      const bool is_for_apps = kStream<Sample>.audience == Audience::App;
      EXPECT_EQ(roles.readers_of(topic).count("nav-app"), is_for_apps ? 1u : 0u) << topic;
      EXPECT_TRUE((std::is_same_v<SourceOf<Sample>, Kind>)) << topic;
    });
  });
}

TEST(SensorKinds, EachHasAServiceWithUnitAndPlaceInInventories) {
  const std::string inventory = text_of("deploy/hosts/services.json");
  const std::string services = text_of("services/sensor/CMakeLists.txt");
  for_each(SensorKinds{}, [&](auto tag) {
    using Kind = typename decltype(tag)::type;
    const std::string service = Kind::service;
    EXPECT_TRUE(is_service(service));
    EXPECT_EQ(security_identity(service), service);
    EXPECT_THAT(inventory, HasSubstr("\"" + service.substr(std::string("inslab-").size()) + "\": \"" +
                                     std::string(Kind::name) + "\""));
    EXPECT_THAT(text_of("deploy/systemd/" + service + "@.service"), HasSubstr("/" + service + " "));
    EXPECT_THAT(services, HasSubstr(service + " "));
  });
}

template <class Sample, class... More>
Sample first_of(Types<Sample, More...>) {
  return {};
}

TEST(SensorKinds, EachSaysInItsSamplesWhichOfItsProfilesWereInEffect) {
  for_each(SensorKinds{}, [](auto tag) {
    using Kind = typename decltype(tag)::type;
    std::set<std::string> profiles, revisions;
    for_each(typename Kind::Profiles{},
             [&](auto one) { profiles.insert(std::string(enum_name(decltype(one)::type::kind))); });
    const auto sample = first_of(SamplesOf<Kind>{});
    const auto note = [&](const Field& field, const auto&) { revisions.insert(std::string(field.name)); };
    std::decay_t<decltype(sample.revisions)>::fields(sample.revisions, note);
    EXPECT_EQ(revisions, profiles) << Kind::name;
  });
}

TEST(SensorKinds, EachHasASectionInScenariosAndCanBeAskedForByName) {
  const auto schema = json::schema<scenario::Scenario>("scenario");
  for_each(SensorKinds{}, [&schema](auto tag) {
    using Kind = typename decltype(tag)::type;
    EXPECT_TRUE(schema["properties"].contains(std::string(Kind::name))) << Kind::name;
    EXPECT_EQ(enum_named<SensorKind>(Kind::name), Kind::kind);
  });
}

TEST(ProfileKinds, EachHasTopicsWordsAndASchema) {
  const Roles roles;
  std::set<std::string> schemas;
  for (const derived::DerivedFile& file : derived::derived_files()) schemas.insert(file.path);
  for_each(ProfileKinds{}, [&](auto tag) {
    using Profile = typename decltype(tag)::type;
    const std::string name(enum_name(Profile::kind));
    SCOPED_TRACE(name);
    expect_everything<Profile>(request_topic(Profile::kind), roles);
    expect_everything<Profile>(journal_topic(Profile::kind), roles);
    EXPECT_EQ(roles.writers_of(request_topic(Profile::kind)), std::set<std::string>{"operator"});
    EXPECT_EQ(roles.writers_of(journal_topic(Profile::kind)), std::set<std::string>{catalog::kTrajectoryServer});
    const std::string word(kWords<Profile>.word);
    for (const std::string& said : {name, word}) {  // of swap and of check --kind
      EXPECT_EQ(scenario::profile_kind_named(said), Profile::kind) << said;
      EXPECT_THAT(scenario::profile_kind_words(), Contains(said));
    }
    EXPECT_EQ(scenario::profile_of(scenario::document_of(Profile::kind)), Profile::kind);
    EXPECT_THAT(scenario::words_of(scenario::document_of(Profile::kind)),
                HasSubstr(std::string(kWords<Profile>.document)));
    EXPECT_THAT(schemas, Contains("config/schema/" + name + ".schema.json"));
    EXPECT_THAT(text_of("docs/parameters.md"), HasSubstr("## " + std::string(kWords<Profile>.title)));
    EXPECT_EQ(kind_of(AnyProfile(Profile())), Profile::kind);
  });
}

TEST(ProfileKinds, EachIsForSomeSensorWhoseDefaultItIs) {
  for_each(ProfileKinds{}, [](auto tag) {
    using Profile = typename decltype(tag)::type;
    const SensorKind usual = usual_sensor(Profile::kind);
    EXPECT_TRUE(takes_profile(usual, Profile::kind));
    EXPECT_EQ(Profile().target.kind, usual) << enum_name(Profile::kind);
  });
}

}  // namespace catalog_test
}  // namespace inslab::catalog
