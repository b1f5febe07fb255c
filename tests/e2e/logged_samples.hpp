#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "inslab/data/catalog/wire_type.hpp"
#include "inslab/data/wire/cdr.hpp"
#include "inslab/formats/mcap/mcap_reader.hpp"

namespace inslab::e2e {

/// All samples of one topic of a log, in the order of their sequence numbers.
template <class T>
std::vector<T> samples_of(const std::string& log_path, const std::string& topic) {
  const mcap::McapReader log(log_path);
  std::map<std::uint64_t, T> by_sequence;
  log.for_each([&](const mcap::Message& message) {
    if (log.channels().at(message.channel_id).topic != topic) return true;
    T sample;
    if (wire::decode(message.data, message.size, sample)) by_sequence[sample.header.sequence_number] = sample;
    return true;
  });
  std::vector<T> samples;
  for (auto& [sequence, sample] : by_sequence) samples.push_back(sample);
  return samples;
}

/// All messages of one topic of a log, in the order of the file; for types without a header.
template <class T>
std::vector<T> samples_of_kind(const std::string& log_path, const std::string& topic) {
  const mcap::McapReader log(log_path);
  std::vector<T> samples;
  log.for_each([&](const mcap::Message& message) {
    T sample;
    const bool of_it = log.channels().at(message.channel_id).topic == topic;
    if (of_it && wire::decode(message.data, message.size, sample)) samples.push_back(sample);
    return true;
  });
  return samples;
}

/// A sample's bytes without what may differ between two runs: run id, publish times and lateness.
template <class T>
std::vector<std::uint8_t> comparable_bytes(T sample) {
  sample.header.run_id = {};
  sample.header.publish_realtime_ns = 0;
  sample.header.publish_monotonic_ns = 0;
  sample.header.published_late = false;
  std::vector<std::uint8_t> bytes;
  wire::encode(sample, bytes);
  return bytes;
}

/// Expects that two logs hold the same bits of one topic, `expected_count` samples.
template <class T>
void expect_same_bits(const std::string& log, const std::string& reference_log, const std::string& topic,
                      std::size_t expected_count) {
  const std::vector<T> samples = samples_of<T>(log, topic);
  const std::vector<T> reference = samples_of<T>(reference_log, topic);
  ASSERT_EQ(reference.size(), expected_count) << topic;
  ASSERT_EQ(samples.size(), reference.size()) << topic;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    ASSERT_EQ(comparable_bytes(samples[i]), comparable_bytes(reference[i])) << topic << " sample " << i;
  }
}

/// Expects that a log of tests/data/short.json holds every sample, the same to the bit as the reference.
inline void expect_same_run(const std::string& log, const std::string& reference_log) {
  expect_same_bits<TruthState>(log, reference_log, "inslab/truth", 1601);
  expect_same_bits<ImuSample>(log, reference_log, "inslab/imu/0", 1600);
  expect_same_bits<ImuTruth>(log, reference_log, "inslab/imu_truth/0", 1600);
  expect_same_bits<ImuSample>(log, reference_log, "inslab/imu/3", 400);
  expect_same_bits<ImuTruth>(log, reference_log, "inslab/imu_truth/3", 400);
  expect_same_bits<GnssFix>(log, reference_log, "inslab/gnss/0", 65);  // 10 epochs in the outage, 5 until a fix
}

/// The same of tests/data/odd_rates.json: 120, 1024 and 300 Hz share 4 Hz, 120 and 1024 Hz 8, 120 and 300 Hz 60, and
/// each of them 1 Hz with the receiver's 7.
inline void expect_same_odd_run(const std::string& log, const std::string& reference_log) {
  constexpr std::size_t kTruthPerSecond = 120 + 1024 + 300 + 7 - 8 - 60 - 4 - 3 * 1 + 4 + 3 * 1 - 1;
  expect_same_bits<TruthState>(log, reference_log, "inslab/truth", 10 * kTruthPerSecond + 1);
  expect_same_bits<ImuSample>(log, reference_log, "inslab/imu/0", 10240);
  expect_same_bits<ImuTruth>(log, reference_log, "inslab/imu_truth/0", 10240);
  expect_same_bits<ImuSample>(log, reference_log, "inslab/imu/1", 3000);
  const auto fixes = samples_of<GnssFix>(reference_log, "inslab/gnss/0").size();
  EXPECT_GT(fixes, 30u);
  expect_same_bits<GnssFix>(log, reference_log, "inslab/gnss/0", fixes);
}

}  // namespace inslab::e2e
