#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "inslab/formats/recordings/imu_recording.hpp"

namespace inslab::recordings {

/// One sample of an IMU as its source has it; a rate becomes an increment when the interval is known.
struct RawSample {
  double time_s = 0.0;
  ImuIncrements values{};
  std::uint64_t place = 0;  ///< line, or number in the topic
};

/// Holds back the first samples until they tell the interval, then passes everything on and looks for gaps. What it is
/// told to use is used until the end.
class RegularSamples {
 public:
  /// `place_name`: what the source counts, "line" or "sample".
  RegularSamples(std::string path, std::string place_name, const ImuRecordingOptions& options, ImuRecordingInfo& info,
                 std::array<bool, kImuAxes> is_rate, const std::function<void(const ImuRecordingInfo&)>& begin,
                 const std::function<void(const ImuIncrements&)>& sample)
      : path_(std::move(path)),
        place_name_(std::move(place_name)),
        options_(options),
        info_(info),
        is_rate_(is_rate),
        begin_(begin),
        sample_(sample) {}

  /// Throws ReadError.
  void take(const RawSample& raw);
  /// Throws ReadError, also when there were fewer than three samples.
  void finish();

 private:
  void flush();
  void judge() const;
  void pass(const RawSample& raw);

  std::string path_;
  std::string place_name_;
  const ImuRecordingOptions& options_;
  ImuRecordingInfo& info_;
  std::array<bool, kImuAxes> is_rate_;
  const std::function<void(const ImuRecordingInfo&)>& begin_;
  const std::function<void(const ImuIncrements&)>& sample_;
  bool begun_ = false;
  std::vector<RawSample> waiting_;
  std::optional<double> last_time_s_;
};

}  // namespace inslab::recordings
