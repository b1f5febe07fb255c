#pragma once

#include <optional>
#include <vector>

#include "inslab/formats/text/imu_recording.hpp"

namespace inslab::io {

/// One sample of a recording as its source has it; a rate becomes an increment when the interval is known.
struct RawImuSample {
  double time_s = 0.0;
  ImuIncrements values{};
  std::uint64_t place = 0;  ///< line, or number in the topic
};

/// Makes increments over one interval of the samples of a recording: holds back the first ones until they tell the
/// interval, then passes everything on and looks for gaps.
class EvenImuSamples {
 public:
  /// `place_name` is what messages call a sample's place; `options` and the callbacks outlive this.
  EvenImuSamples(std::string path, std::string place_name, const ImuRecordingOptions& options, ImuRecordingInfo& info,
                 std::array<bool, kImuAxes> is_rate, const std::function<void(const ImuRecordingInfo&)>& begin,
                 const std::function<void(const ImuIncrements&)>& sample)
      : path_(std::move(path)),
        place_name_(std::move(place_name)),
        options_(options),
        info_(info),
        is_rate_(is_rate),
        begin_(begin),
        sample_(sample) {}

  /// Throws ReadError, naming file and place.
  void take(const RawImuSample& raw);
  /// After the last sample.
  void finish();

 private:
  void flush();
  void judge() const;
  void pass(const RawImuSample& raw);

  std::string path_;
  std::string place_name_;
  const ImuRecordingOptions& options_;
  ImuRecordingInfo& info_;
  std::array<bool, kImuAxes> is_rate_;
  const std::function<void(const ImuRecordingInfo&)>& begin_;
  const std::function<void(const ImuIncrements&)>& sample_;
  bool begun_ = false;
  std::vector<RawImuSample> waiting_;
  std::optional<double> last_time_s_;
};

}  // namespace inslab::io
