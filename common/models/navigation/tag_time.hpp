#pragma once

#include <optional>

#include "inslab/data/samples/imu_sample.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/models/navigation/measurements.hpp"

namespace inslab::navigation {

/// A flight computer knows when a sample was valid from its tag alone, and takes every tag for right: here samples get
/// the time that their tag says, GPS week and time of week, counted as sim time is. The first tag of the IMU sets the
/// count; a sample without a tag (week 0, time 0) keeps its time. When a sample is there is not changed.
class TagTime {
 public:
  /// The next sample of the IMU. If it follows the last one, its interval is from tag to tag.
  ImuSample applied(ImuSample sample) {
    if (!begun_ && has_tag(sample.header)) begun_ = sample.header;
    const std::int64_t begins_ns = sample.header.sim_time_ns - sample.interval_ns;
    const std::int64_t end_ns = of(sample.header);
    if (last_ && last_->valid_ns == begins_ns) sample.interval_ns = end_ns - last_->tagged_ns;
    last_ = {sample.header.sim_time_ns, end_ns};
    sample.header.sim_time_ns = end_ns;
    return sample;
  }

  Observation applied(Observation observation) const {
    std::visit([this](auto& sample) { sample.header.sim_time_ns = of(sample.header); }, observation);
    return observation;
  }

 private:
  struct Last {
    std::int64_t valid_ns;
    std::int64_t tagged_ns;
  };

  static bool has_tag(const StreamHeader& header) { return header.gps_week != 0 || header.gps_time_of_week_ns != 0; }
  std::int64_t of(const StreamHeader& header) const {
    if (!begun_ || !has_tag(header)) return header.sim_time_ns;
    const time::GpsTime tag{header.gps_week, header.gps_time_of_week_ns};
    const time::GpsTime begun{begun_->gps_week, begun_->gps_time_of_week_ns};
    return begun_->sim_time_ns + (tag - begun).count();
  }

  std::optional<StreamHeader> begun_;  ///< of the first tagged sample
  std::optional<Last> last_;
};

}  // namespace inslab::navigation
