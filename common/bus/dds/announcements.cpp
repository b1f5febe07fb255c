#include "inslab/bus/dds/announcements.hpp"

#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>

namespace inslab::dds {

namespace efd = eprosima::fastdds::dds;

void Announcements::add(efd::DataWriter& writer) {
  const std::lock_guard<std::mutex> lock(mutex_);
  writers_.insert(&writer);
}
void Announcements::add(efd::DataReader& reader) {
  const std::lock_guard<std::mutex> lock(mutex_);
  readers_.insert(&reader);
}
void Announcements::remove(efd::DataWriter& writer) {
  const std::lock_guard<std::mutex> lock(mutex_);
  writers_.erase(&writer);
}
void Announcements::remove(efd::DataReader& reader) {
  const std::lock_guard<std::mutex> lock(mutex_);
  readers_.erase(&reader);
}

/// Settings that are set are announced, changed or not.
void Announcements::repeat() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (efd::DataWriter* writer : writers_) writer->set_qos(writer->get_qos());
  for (efd::DataReader* reader : readers_) reader->set_qos(reader->get_qos());
}

}  // namespace inslab::dds
