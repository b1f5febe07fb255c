#pragma once

#include <mutex>
#include <set>

namespace eprosima::fastdds::dds {
class DataReader;
class DataWriter;
}  // namespace eprosima::fastdds::dds

namespace inslab::dds {

/// The writers and readers of a participant, as they are to be announced to the network once more.
///
/// A participant that was not heard for as long as its lease is forgotten by the others, and found again when it goes
/// on. It has not forgotten them, and what they had acknowledged before of its announcements of endpoints Fast DDS
/// (2.9.1 and 3.1.2 alike) never sends again, unless their very first message asks for it: if a heartbeat comes to them
/// before they have sent that, some of its writers and readers stay unknown to them for good. An announcement that is
/// new is sent to everybody.
class Announcements {
 public:
  void add(eprosima::fastdds::dds::DataWriter& writer);
  void add(eprosima::fastdds::dds::DataReader& reader);
  /// Before it is deleted.
  void remove(eprosima::fastdds::dds::DataWriter& writer);
  void remove(eprosima::fastdds::dds::DataReader& reader);

  void repeat() const;

 private:
  mutable std::mutex mutex_;
  std::set<eprosima::fastdds::dds::DataWriter*> writers_;
  std::set<eprosima::fastdds::dds::DataReader*> readers_;
};

}  // namespace inslab::dds
