#pragma once

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <map>
#include <string>

#include "inslab/bus/dds/participant.hpp"
#include "inslab/bus/dds/qos.hpp"
#include "inslab/bus/dds/typed_topics.hpp"

namespace inslab::e2e {

/// What an intruder brings: paths of the files that its participant uses, and what it may really do.
struct Credentials {
  std::string authorities;  ///< of identities and of permissions; may hold several certificates
  std::string certificate;
  std::string key;
  std::string governance;
  std::string permissions;
  std::string may_write;  ///< a topic
  std::string may_read;   ///< a topic
};

/// A participant that uses its keys without the checks of ours, and that deceives those of Fast DDS: they ask about the
/// topic that the properties of an endpoint name first, and so about one that it may have. It tries what its
/// permissions forbid, and leaves it to its peers to refuse.
class HostileRole {
 public:
  /// Without credentials it is a stranger who does not know of security at all.
  HostileRole(std::uint32_t domain, const std::string& name, const Credentials* credentials);
  ~HostileRole();
  HostileRole(const HostileRole&) = delete;
  HostileRole& operator=(const HostileRole&) = delete;

  /// Whether Fast DDS took the credentials.
  bool made() const { return participant_ != nullptr; }

  template <class T>
  void try_writing(const dds::Topic<T>& topic) {
    auto qos = dds::writer_qos(topic.delivery, topic.nominal_rate_hz);
    if (!may_write_.empty()) qos.properties().properties().emplace_back("topic_name", may_write_);
    writers_[topic.name] = publisher_->create_datawriter(&make<T>(topic.name), qos);
  }
  /// Not before the writers are dropped: the two would find each other.
  template <class T>
  void try_reading(const dds::Topic<T>& topic) {
    auto qos = dds::reader_qos(topic.delivery, topic.nominal_rate_hz);
    if (!may_read_.empty()) qos.properties().properties().emplace_back("topic_name", may_read_);
    readers_[topic.name] = subscriber_->create_datareader(&make<T>(topic.name), qos);
  }
  void drop_writers();

  /// Whether Fast DDS made all of them: what it refuses here its peers were not asked.
  bool made_all() const;
  /// Whether readers of others take what this writes on the topic, and whether it hears writers of others.
  bool is_heard(const std::string& topic) const;
  bool hears(const std::string& topic) const;

 private:
  template <class T>
  eprosima::fastdds::dds::Topic& make(const std::string& name) {
    if (auto* known = dynamic_cast<eprosima::fastdds::dds::Topic*>(participant_->lookup_topicdescription(name))) {
      return *known;
    }
    eprosima::fastdds::dds::TypeSupport type(new dds::TypeAdapter<T>());
    type.register_type(participant_);
    return *participant_->create_topic(name, type.get_type_name(), eprosima::fastdds::dds::TOPIC_QOS_DEFAULT);
  }

  eprosima::fastdds::dds::DomainParticipant* participant_ = nullptr;
  eprosima::fastdds::dds::Publisher* publisher_ = nullptr;
  eprosima::fastdds::dds::Subscriber* subscriber_ = nullptr;
  std::string may_write_;
  std::string may_read_;
  std::map<std::string, eprosima::fastdds::dds::DataWriter*> writers_;
  std::map<std::string, eprosima::fastdds::dds::DataReader*> readers_;
};

}  // namespace inslab::e2e
