#include "inslab/referee/score/latency.hpp"

#include <algorithm>

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::score {

namespace {

constexpr std::size_t kMostSent = 65536;

}  // namespace

void Latency::add(const ImuSample& imu) {
  if (!sent_.empty() && imu.header.sequence_number <= sent_.back().sequence) return;
  sent_.push_back({imu.header.sequence_number, imu.header.sim_time_ns, imu.header.publish_realtime_ns});
  if (sent_.size() > kMostSent) sent_.pop_front();
}

const Latency::Sent* Latency::named_by(const NavSolution& solution) const {
  if (solution.imu_sequence == 0) return nullptr;
  const auto sent =
      std::lower_bound(sent_.begin(), sent_.end(), solution.imu_sequence,
                       [](const Sent& sample, std::uint64_t sequence) { return sample.sequence < sequence; });
  return sent == sent_.end() || sent->sequence != solution.imu_sequence ? nullptr : &*sent;
}

void Latency::note(const Sent& sample, std::int64_t received_realtime_ns) {
  if (sample.publish_realtime_ns == 0 || received_realtime_ns == 0) return;
  const std::int64_t latency_ns = received_realtime_ns - sample.publish_realtime_ns;
  if (latency_ns < 0) {
    ++negative_;
  } else {
    seconds_.add(time::to_seconds(latency_ns));
  }
}

}  // namespace inslab::score
