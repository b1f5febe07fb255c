#include "tests/e2e/security/hostile_role.hpp"

#include <algorithm>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

namespace inslab::e2e {

namespace efd = eprosima::fastdds::dds;

HostileRole::HostileRole(std::uint32_t domain, const std::string& name, const Credentials* credentials) {
  dds::ParticipantOptions options;
  options.name = name;
  auto qos = dds::participant_qos(options, std::make_shared<std::atomic<std::uint32_t>>());
  if (credentials != nullptr) {
    const auto set = [&qos](const char* property, const std::string& value) {
      qos.properties().properties().emplace_back(property, value);
    };
    const auto set_file = [&set](const char* property, const std::string& path) { set(property, "file://" + path); };
    set("dds.sec.auth.plugin", "builtin.PKI-DH");
    set_file("dds.sec.auth.builtin.PKI-DH.identity_ca", credentials->authorities);
    set_file("dds.sec.auth.builtin.PKI-DH.identity_certificate", credentials->certificate);
    set_file("dds.sec.auth.builtin.PKI-DH.private_key", credentials->key);
    set("dds.sec.access.plugin", "builtin.Access-Permissions");
    set_file("dds.sec.access.builtin.Access-Permissions.permissions_ca", credentials->authorities);
    set_file("dds.sec.access.builtin.Access-Permissions.governance", credentials->governance);
    set_file("dds.sec.access.builtin.Access-Permissions.permissions", credentials->permissions);
    set("dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC");
    may_write_ = credentials->may_write;
    may_read_ = credentials->may_read;
  }
  participant_ = efd::DomainParticipantFactory::get_instance()->create_participant(domain, qos);
  if (participant_ == nullptr) return;
  publisher_ = participant_->create_publisher(efd::PUBLISHER_QOS_DEFAULT);
  subscriber_ = participant_->create_subscriber(efd::SUBSCRIBER_QOS_DEFAULT);
}

HostileRole::~HostileRole() {
  if (participant_ == nullptr) return;
  participant_->delete_contained_entities();
  efd::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

void HostileRole::drop_writers() {
  for (const auto& [topic, writer] : writers_) {
    if (writer != nullptr) publisher_->delete_datawriter(writer);
  }
  writers_.clear();
}

bool HostileRole::made_all() const {
  const auto is_made = [](const auto& end) { return end.second != nullptr; };
  return std::all_of(writers_.begin(), writers_.end(), is_made) &&
         std::all_of(readers_.begin(), readers_.end(), is_made);
}

bool HostileRole::is_heard(const std::string& topic) const {
  efd::PublicationMatchedStatus status;
  auto* writer = writers_.at(topic);
  if (writer != nullptr) writer->get_publication_matched_status(status);
  return status.current_count > 0;
}

bool HostileRole::hears(const std::string& topic) const {
  efd::SubscriptionMatchedStatus status;
  auto* reader = readers_.at(topic);
  if (reader != nullptr) reader->get_subscription_matched_status(status);
  return status.current_count > 0;
}

}  // namespace inslab::e2e
