#pragma once

#include <map>

#include "inslab/data/samples/imu_sample.hpp"
#include "inslab/data/samples/imu_truth.hpp"
#include "inslab/formats/mcap/mcap_reader.hpp"
#include "inslab/formats/recordings/regular_samples.hpp"

namespace inslab::recordings {

/// The errors of an IMU of a log, its samples less their truth, as a recording: told of the two as they come, in no
/// order between each other, by whoever reads the log.
class ImuErrors {
 public:
  using Begin = std::function<void(const ImuRecordingInfo&)>;
  using Take = std::function<void(const ImuIncrements&)>;

  /// `begin` and `take` are called as read_imu_recording() calls them. Throws ReadError when the log does not hold both
  /// topics.
  ImuErrors(const mcap::McapReader& log, const ImuRecordingOptions& options, Begin begin, Take take);
  ImuErrors(const ImuErrors&) = delete;
  ImuErrors& operator=(const ImuErrors&) = delete;

  /// Of these topics, and no other. Both throw ReadError.
  void add(const ImuSample& sample);
  void add(const ImuTruth& truth);

  /// Nothing more comes. Throws ReadError.
  ImuRecordingInfo finish();

 private:
  void pair(const ImuSample& sample, const ImuIncrements& truth);

  ImuRecordingOptions options_;
  Begin begin_;
  Take take_;
  ImuRecordingInfo info_;
  RegularSamples regular_;
  // What waits for its partner is soon met.
  std::map<std::uint64_t, ImuSample> waiting_samples_;
  std::map<std::uint64_t, ImuIncrements> waiting_truths_;
  std::uint64_t number_ = 0;
};

/// Increments of a sample, or of its truth.
template <class Sample>
ImuIncrements increments_of(const Sample& sample) {
  ImuIncrements values{};
  for (int i = 0; i < 3; ++i) {
    values[static_cast<std::size_t>(i)] = sample.dtheta_b[i];
    values[static_cast<std::size_t>(3 + i)] = sample.dv_b[i];
  }
  return values;
}

}  // namespace inslab::recordings
