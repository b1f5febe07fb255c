#include "inslab/formats/recordings/imu_errors.hpp"

#include "inslab/data/catalog/topics.hpp"
#include "inslab/formats/log/log_topic.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::recordings {

ImuErrors::ImuErrors(const mcap::McapReader& log, const ImuRecordingOptions& options, Begin begin, Take take)
    : options_(options),
      begin_(std::move(begin)),
      take_(std::move(take)),
      regular_(log.path(), "sample", options_, info_, {}, begin_, take_) {
  const std::string topic = catalog::stream_topic<ImuSample>(options_.sensor_number);
  const std::string truth_topic = catalog::stream_topic<ImuTruth>(options_.sensor_number);
  if (log::channels_of(log, topic, catalog::WireType<ImuSample>::name).empty() ||
      log::channels_of(log, truth_topic, catalog::WireType<ImuTruth>::name).empty()) {
    throw files::ReadError(log.path() + ": has no topics " + topic + " and " + truth_topic + "; it has " +
                           log::topics_text(log));
  }
  info_.kind = "log, " + topic + " less its truth";
  info_.has_axis.fill(true);
}

void ImuErrors::add(const ImuSample& sample) {
  const auto truth = waiting_truths_.find(sample.header.sequence_number);
  if (truth == waiting_truths_.end()) {
    waiting_samples_[sample.header.sequence_number] = sample;
  } else {
    pair(sample, truth->second);
    waiting_truths_.erase(truth);
  }
}

void ImuErrors::add(const ImuTruth& truth) {
  const auto sample = waiting_samples_.find(truth.header.sequence_number);
  if (sample == waiting_samples_.end()) {
    waiting_truths_[truth.header.sequence_number] = increments_of(truth);
  } else {
    pair(sample->second, increments_of(truth));
    waiting_samples_.erase(sample);
  }
}

void ImuErrors::pair(const ImuSample& sample, const ImuIncrements& truth) {
  ++number_;
  if (!sample.gyro_valid || !sample.accel_valid) {
    ++info_.invalid;
    return;
  }
  RawSample raw{time::to_seconds(sample.header.sim_time_ns), increments_of(sample), number_};
  for (std::size_t i = 0; i < kImuAxes; ++i) raw.values[i] -= truth[i];
  regular_.take(raw);
}

ImuRecordingInfo ImuErrors::finish() {
  regular_.finish();
  return info_;
}

}  // namespace inslab::recordings
