#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "inslab/data/profiles/recording_place.hpp"
#include "inslab/models/imu/increments.hpp"

namespace inslab::imu {

/// Stage 4d: errors of a real IMU, as they were recorded, on top of the others.
///
/// A function of sim time alone: what was recorded over an interval of the recording is spread evenly over it, and an
/// interval of the simulated IMU takes what lies in it, so that the sum over any number of intervals loses nothing.
class RecordedSignal {
 public:
  /// What a run asks of a recording.
  struct Run {
    std::uint64_t seed = 0;
    std::string sensor;        ///< such as "imu0": names the random stream
    time::Nanoseconds end{0};  ///< sim time of the last sample
    RecordingFinder find{};    ///< may be empty: then there are no recordings
  };

  /// No recording: errors are zero.
  RecordedSignal() = default;
  /// Throws std::invalid_argument, naming the file, when the recording is not found or is too short for the run.
  RecordedSignal(const RecordedError& profile, const Run& run);

  bool is_off() const { return recording_ == nullptr; }

  /// The errors over (from, to] of sim time, rad and m/s; zero before the recording begins.
  Increments between(std::int64_t from_ns, std::int64_t to_ns) const;

 private:
  RecordedErrors::Increments interval(std::int64_t number) const;
  void find_mean();

  std::shared_ptr<const RecordedErrors> recording_;
  RecordedAxes axes_ = RecordedAxes::All;
  profiles::RecordingPlace place_;
  RecordedErrors::Increments mean_{};
};

}  // namespace inslab::imu
