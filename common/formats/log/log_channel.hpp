#pragma once

#include <cstdint>
#include <string_view>

#include "inslab/data/catalog/wire_type.hpp"
#include "inslab/data/wire/cdr.hpp"
#include "inslab/data/wire/idl_text.hpp"
#include "inslab/formats/mcap/mcap_writer.hpp"

namespace inslab::log {

/// One topic of a log that is being written; the log describes it with the product's own IDL text.
template <class T>
class LogChannel {
 public:
  /// The log must live as long. Throws WriteError.
  LogChannel(mcap::McapWriter& log, std::string_view topic, const mcap::StringMap& metadata = {})
      : log_(&log),
        id_(log.add_channel(log.add_schema(catalog::WireType<T>::name, "omgidl",
                                           wire::self_contained_idl(catalog::WireType<T>::idl_file)),
                            topic, "cdr", metadata)) {}

  /// Adds a sample; errors as McapWriter::write().
  void write(const T& sample, std::uint32_t sequence, std::uint64_t log_time_ns, std::uint64_t publish_time_ns) {
    wire::encode_to(sample, log_->reserve(id_, sequence, log_time_ns, publish_time_ns, wire::encoded_size(sample)));
  }

  /// For McapWriter::write() of payloads that are encoded already.
  std::uint16_t id() const { return id_; }

 private:
  mcap::McapWriter* log_;
  std::uint16_t id_;
};

}  // namespace inslab::log
