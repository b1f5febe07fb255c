#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/mcap_reader.hpp"
#include "wire/cdr.hpp"
#include "wire/wire_type.hpp"

namespace inslab::e2e {

/// All samples of one topic of a log, in the order of their sequence numbers.
template <class T>
std::vector<T> samples_of(const std::string& log_path, const std::string& topic) {
  const io::McapReader log(log_path);
  std::map<std::uint64_t, T> by_sequence;
  log.for_each([&](const io::mcap::Message& message) {
    if (log.channels().at(message.channel_id).topic != topic) return true;
    T sample;
    if (wire::decode(message.data, message.size, sample)) by_sequence[sample.header.sequence_number] = sample;
    return true;
  });
  std::vector<T> samples;
  for (auto& [sequence, sample] : by_sequence) samples.push_back(sample);
  return samples;
}

/// A sample's bytes without what may differ between two runs: run id and publish times.
template <class T>
std::vector<std::uint8_t> comparable_bytes(T sample) {
  sample.header.run_id = {};
  sample.header.publish_realtime_ns = 0;
  sample.header.publish_monotonic_ns = 0;
  std::vector<std::uint8_t> bytes;
  wire::encode(sample, bytes);
  return bytes;
}

}  // namespace inslab::e2e
