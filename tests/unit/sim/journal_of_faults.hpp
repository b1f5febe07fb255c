#pragma once

#include "inslab/data/samples/imu_sample.hpp"
#include "inslab/referee/evidence/log_summary.hpp"

/// A log's summary with as many swaps of IMU 0's faults, spread over 90 s, as a soak makes.
namespace inslab::sim {

constexpr std::int64_t time_of_swap_ns(std::uint32_t i, std::uint32_t swaps) {
  return static_cast<std::int64_t>(i) * 90'000'000'000 / swaps;
}

inline evidence::LogSummary journal_of_faults(std::uint32_t swaps) {
  evidence::LogSummary summary;
  summary.scenario.duration_s = 100.0;
  for (std::uint32_t i = 1; i <= swaps; ++i) {
    const std::int64_t t_ns = time_of_swap_ns(i, swaps);
    FaultProfile fault;
    fault.target = {SensorKind::Imu, 0};
    fault.request.journal_number = i;
    fault.request.apply_at_ns = t_ns;
    summary.profiles.push_back({t_ns, fault});
    ProfileAck ack;
    ack.kind = ProfileKind::Fault;
    ack.target = fault.target;
    ack.journal_number = i;
    ack.first_sample_time_ns = t_ns + 1;
    ack.first_sequence = i;
    summary.acks.push_back(ack);
  }
  summary.timeline = evidence::ProfileTimeline(summary.profiles);
  return summary;
}

/// The first sample under swap `i`.
inline ImuSample sample_after(std::uint32_t i, std::uint32_t swaps) {
  ImuSample sample;
  sample.interval_ns = 1'000'000;
  sample.header.sim_time_ns = time_of_swap_ns(i, swaps) + 1;
  sample.header.sequence_number = sample.revisions.fault = i;
  return sample;
}

}  // namespace inslab::sim
