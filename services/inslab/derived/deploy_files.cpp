#include "inslab/services/inslab/derived/deploy_files.hpp"

#include <string>
#include <vector>

#include "inslab/data/catalog/topics.hpp"

namespace inslab::derived {

namespace {

using Words = std::vector<std::string>;

/// The topics that a role may write, and those that it may read. Sensors are numbered as they like.
class Permissions {
 public:
  Words writes;
  Words reads;

  explicit Permissions(catalog::Roles role) : role_(role) {
    if (catalog::kReadersOfAll.has(role)) reads.push_back(std::string(catalog::kRoot) + "*");
    add(catalog::kRequests + std::string("*"), catalog::roles::kOperator, catalog::roles::kServer);
    add(catalog::kJournal + std::string("*"), catalog::roles::kServer, catalog::roles::kSensors);
    for_each_of(catalog::kTopics, [this](const auto& topic) {
      add(topic.name, topic.writers, topic.readers);
      if (topic.has_blocks) add(catalog::block_topic(topic.name), topic.writers, topic.readers_of_blocks);
    });
  }

  /// The streams of a kind of sensor: `writes_them` when the role is that of its service.
  template <class Kind>
  void add_streams(bool writes_them) {
    for_each_of(Kind::streams, [this, writes_them](const auto& stream) {
      const std::string topic = std::string(catalog::kRoot) + stream.name + "/*";
      const bool is_for_apps = stream.audience == catalog::Audience::App;
      for (const std::string& one : {topic, catalog::block_topic(topic)}) {
        if (writes_them) writes.push_back(one);
        if (is_for_apps && role_.has(catalog::roles::kNavApp)) reads.push_back(one);
      }
    });
  }

 private:
  void add(const std::string& topic, catalog::Roles writers, catalog::Roles readers) {
    if (writers.has(role_)) writes.push_back(topic);
    if (readers.has(role_) && !catalog::kReadersOfAll.has(role_)) reads.push_back(topic);
  }

  catalog::Roles role_;
};

/// In quotes, in lines that a screen holds.
std::string quoted(const Words& words) {
  constexpr std::size_t kWidth = 116;
  std::string text = "  '";
  std::size_t width = text.size();
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool fits = width + 1 + words[i].size() < kWidth;
    if (i > 0) text += fits ? " " : "\n   ";
    width = (fits ? width + 1 : 3) + words[i].size();
    text += words[i];
  }
  return text + "'";
}

std::string role_text(std::string_view identity, const Permissions& may) {
  return "role " + std::string(identity) + " \\\n" + quoted(may.writes) + " \\\n" + quoted(may.reads) + "\n";
}

std::string role_text(std::string_view identity, catalog::Roles role) {
  Permissions may(role);
  for_each(catalog::SensorKinds{}, [&may](auto kind) { may.add_streams<typename decltype(kind)::type>(false); });
  return role_text(identity, may);
}

/// The name of a service in inventories and units is that of the program without this.
constexpr std::string_view kPrefix = "inslab-";

/// What each role of a secured set may write and read.
std::string security_roles() {
  std::string text =
      "# What each role of a secured set may write and read, for make-keys. Derived from common/data/catalog by\n"
      "# 'inslab reference deploy/security/roles'.\n";
  text += role_text(catalog::kTrajectoryServer, catalog::roles::kServer);
  for_each(catalog::SensorKinds{}, [&text](auto tag) {
    using Kind = typename decltype(tag)::type;
    Permissions may(catalog::roles::kSensors);
    may.add_streams<Kind>(true);
    text += role_text(Kind::service, may);
  });
  text += role_text(catalog::kTruthLogger, catalog::roles::kLogger);
  text += role_text(catalog::kOperatorIdentity, catalog::roles::kOperator);
  text += role_text(catalog::kNavAppIdentity, catalog::roles::kNavApp);
  text += role_text(catalog::kVehicleIdentity, catalog::roles::kVehicle);
  return text;
}

/// The services by their names in inventories, and of which sensors of a scenario there is one for each.
std::string lab_services() {
  std::string text;
  for (const catalog::Service& service : catalog::services()) {
    text += std::string(text.empty() ? "{\n" : ",\n") + "  \"" + std::string(service.name.substr(kPrefix.size())) +
            "\": \"" + std::string(service.sensor) + "\"";
  }
  return text + "\n}\n";
}

template <class Kind>
std::string sensor_unit() {
  const std::string title = std::string(Kind::service_title) + " of sensor %i";
  const std::string service = Kind::service;
  return "# " + title +
         "; installed by deploy/lab, which writes /etc/inslab/lab.env.\n"
         "# Derived from common/data/catalog by 'inslab reference deploy/systemd/" +
         service +
         "@.service'.\n"
         "[Unit]\n"
         "Description=Inslab " +
         title +
         "\n"
         "Wants=network-online.target\n"
         "After=network-online.target\n"
         "\n"
         "[Service]\n"
         "EnvironmentFile=/etc/inslab/lab.env\n"
         "WorkingDirectory=/opt/inslab\n"
         "ExecStart=/opt/inslab/build/bin/" +
         service + " $INSLAB_ARGUMENTS --sensor %i --state /run/" + service +
         "-%i\n"
         "# Killed, it goes on from its checkpoint in the runtime folder; ended in order or by a bad input, it stays "
         "ended.\n"
         "Restart=on-abnormal\n"
         "RestartSec=0\n"
         "KillSignal=SIGTERM\n"
         "TimeoutStopSec=30\n"
         "RuntimeDirectory=" +
         service +
         "-%i\n"
         "RuntimeDirectoryPreserve=restart\n"
         "\n"
         "[Install]\n"
         "WantedBy=multi-user.target\n";
}

}  // namespace

std::vector<DerivedFile> deploy_files() {
  std::vector<DerivedFile> files{{"deploy/security/roles", security_roles},
                                 {"deploy/hosts/services.json", lab_services}};
  for_each(catalog::SensorKinds{}, [&files](auto tag) {
    using Kind = typename decltype(tag)::type;
    files.push_back({"deploy/systemd/" + std::string(Kind::service) + "@.service", sensor_unit<Kind>});
  });
  return files;
}

}  // namespace inslab::derived
