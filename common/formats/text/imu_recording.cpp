#include "inslab/formats/text/imu_recording.hpp"

#include <map>
#include <set>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/formats/log/log_topic.hpp"
#include "inslab/formats/text/even_imu_samples.hpp"
#include "inslab/formats/text/imu_text_recording.hpp"
#include "inslab/foundation/files/error.hpp"

namespace inslab::io {
namespace {

template <class Sample>
ImuIncrements increments_of(const Sample& sample) {
  ImuIncrements values{};
  for (int i = 0; i < 3; ++i) {
    values[static_cast<std::size_t>(i)] = sample.dtheta_b[i];
    values[static_cast<std::size_t>(3 + i)] = sample.dv_b[i];
  }
  return values;
}

RawImuSample raw_of(const ImuSample& sample, std::uint64_t number) {
  return {static_cast<double>(sample.header.sim_time_ns) * 1e-9, increments_of(sample), number};
}

void read_log(const std::string& path, const ImuRecordingOptions& options, ImuRecordingInfo& info,
              EvenImuSamples& even) {
  const McapReader log(path);
  const std::string topic = catalog::stream_topic<ImuSample>(options.sensor_number);
  if (!options.minus_truth) {
    for_each_sample<ImuSample>(log, topic, [&](const ImuSample& sample, std::uint64_t number) {
      if (sample.gyro_valid && sample.accel_valid) {
        even.take(raw_of(sample, number));
      } else {
        ++info.invalid;
      }
      return true;
    });
    return;
  }
  const std::string truth_topic = catalog::stream_topic<ImuTruth>(options.sensor_number);
  const auto samples = channels_of(log, topic, wire::WireType<ImuSample>::name);
  const auto truths = channels_of(log, truth_topic, wire::WireType<ImuTruth>::name);
  if (samples.empty() || truths.empty()) {
    throw ReadError(path + ": has no topics " + topic + " and " + truth_topic + "; it has " + topics_text(log));
  }
  std::set<std::uint16_t> both = samples;
  both.insert(truths.begin(), truths.end());
  // The two topics of an IMU keep no order between each other; what waits for its partner is soon met.
  std::map<std::uint64_t, ImuSample> waiting_samples;
  std::map<std::uint64_t, ImuIncrements> waiting_truths;
  std::uint64_t number = 0;
  const auto pair = [&](const ImuSample& sample, const ImuIncrements& truth) {
    RawImuSample raw = raw_of(sample, ++number);
    for (std::size_t i = 0; i < kImuAxes; ++i) raw.values[i] -= truth[i];
    if (sample.gyro_valid && sample.accel_valid) {
      even.take(raw);
    } else {
      ++info.invalid;
    }
  };
  log.for_each(
      [&](const mcap::Message& message) {
        if (samples.count(message.channel_id) != 0) {
          ImuSample sample;
          if (!wire::decode(message.data, message.size, sample)) return true;
          const auto truth = waiting_truths.find(sample.header.sequence_number);
          if (truth == waiting_truths.end()) {
            waiting_samples[sample.header.sequence_number] = sample;
          } else {
            pair(sample, truth->second);
            waiting_truths.erase(truth);
          }
          return true;
        }
        ImuTruth truth;
        if (!wire::decode(message.data, message.size, truth)) return true;
        const auto sample = waiting_samples.find(truth.header.sequence_number);
        if (sample == waiting_samples.end()) {
          waiting_truths[truth.header.sequence_number] = increments_of(truth);
        } else {
          pair(sample->second, increments_of(truth));
          waiting_samples.erase(sample);
        }
        return true;
      },
      McapReader::Order::LogTime, both);
}

bool is_mcap(const std::string& path) {
  const InputFile file(path);
  constexpr std::uint8_t kMagic[] = {0x89, 'M', 'C', 'A', 'P'};
  if (file.size() < sizeof(kMagic)) return false;
  std::uint8_t head[sizeof(kMagic)];
  file.read(0, head, sizeof(head));
  return std::equal(std::begin(kMagic), std::end(kMagic), std::begin(head));
}

}  // namespace

ImuRecordingInfo read_imu_recording(const std::string& path, const ImuRecordingOptions& options,
                                    const std::function<void(const ImuRecordingInfo&)>& begin,
                                    const std::function<void(const ImuIncrements&)>& sample) {
  ImuRecordingInfo info;
  std::array<bool, kImuAxes> is_rate{};
  if (is_mcap(path)) {
    info.kind = "log, " + catalog::stream_topic<ImuSample>(options.sensor_number) +
                (options.minus_truth ? " less its truth" : "");
    info.has_axis.fill(true);
    EvenImuSamples even(path, "sample", options, info, is_rate, begin, sample);
    read_log(path, options, info, even);
    even.finish();
    return info;
  }
  if (options.minus_truth)
    throw ReadError(path + ": is no log of ours; only such a log holds the truth beside the IMU");
  ImuTextRecording text(path);
  for (const ImuColumn& column : text.layout().columns) {
    if (column.axis < 0) continue;
    info.has_axis[static_cast<std::size_t>(column.axis)] = true;
    is_rate[static_cast<std::size_t>(column.axis)] = column.is_rate;
  }
  info.kind = "text of " + std::to_string(text.layout().fields) + " columns";
  EvenImuSamples even(path, "line", options, info, is_rate, begin, sample);
  RawImuSample raw;
  while (text.next(raw)) even.take(raw);
  even.finish();
  return info;
}

}  // namespace inslab::io
