#pragma once

#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/service/service.hpp"

namespace inslab::service {

/// Reader of a topic that the set itself writes: hands on what its rightful writers send (bus/service/writers.hpp).
/// Otherwise as dds::Reader.
template <class T>
class SetReader {
 public:
  SetReader(Context& context, const dds::Topic<T>& topic, const typename dds::Reader<T>::Callback& callback)
      : reader_(context.participant(), topic, context.writers().only(topic, callback)) {}

  int matched_writers() const { return reader_.matched_writers(); }

 private:
  dds::Reader<T> reader_;
};

}  // namespace inslab::service
