#pragma once

#include "inslab/bus/service/stream_output.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/scenario/service_names.hpp"

namespace inslab::imu {

/// The two streams of an injector on the bus, inslab/imu/N and inslab/imu_truth/N, which go together.
class ImuOutputs {
 public:
  ImuOutputs(app::Context& context, const scenario::LoadedImu& imu, bool paced_by_nav_app)
      : samples_(
            context, dds::topics::imu(imu.number, imu.rate.hz()),
            {app::stream_consumers(context.scenario().scenario, SensorKind::Imu, imu.number), paced_by_nav_app,
             app::StreamOutput<ImuSample>::kWindowSamples, app::StreamOutput<ImuSample>::half_a_minute(imu.rate.hz())}),
        truths_(context, dds::topics::imu_truth(imu.number, imu.rate.hz()),
                {{{app::kTruthLogger, 0u}},
                 false,
                 app::StreamOutput<ImuTruth>::kWindowSamples,
                 app::StreamOutput<ImuTruth>::half_a_minute(imu.rate.hz())}) {}

  void begin_run(const RunId& run, ClockMode clock) {
    samples_.begin_run(run, clock);
    truths_.begin_run(run, clock);
  }
  void put(ImuSample& sample, ImuTruth& truth) {
    samples_.put(sample);
    truths_.put(truth);
  }
  void flush_blocks() {
    samples_.flush_block();
    truths_.flush_block();
  }
  void take(const Credit& credit) {
    samples_.take(credit);
    truths_.take(credit);
  }
  bool has_room() const { return samples_.has_room() && truths_.has_room(); }
  /// Sequence numbers that follow the newest of each, and whether everybody has them up to there.
  std::vector<std::uint64_t> ends() const { return {samples_.next_sequence(), truths_.next_sequence()}; }
  bool delivered(const std::vector<std::uint64_t>& ends) const {
    return samples_.lowest_wanted() >= ends[0] && truths_.lowest_wanted() >= ends[1];
  }
  bool are_logged() const { return samples_.is_logged() && truths_.is_logged(); }
  /// Whose readers are missing; empty when none.
  std::string missing_readers() const {
    const std::string missing = samples_.missing_readers();
    return missing.empty() ? truths_.missing_readers() : missing;
  }
  void save(recovery::StateWriter& writer) const {
    samples_.save(writer);
    truths_.save(writer);
  }
  void load(recovery::StateReader& reader) {
    samples_.load(reader);
    truths_.load(reader);
  }
  void report(ServiceStatus& status) const {
    status.streams.push_back(samples_.status());
    status.streams.push_back(truths_.status());
  }
  void wait_for_acknowledgments(time::Nanoseconds deadline) {
    samples_.wait_for_acknowledgments(deadline);
    truths_.wait_for_acknowledgments(deadline);
  }
  const std::string& samples_topic() const { return samples_.topic(); }

 private:
  app::StreamOutput<ImuSample> samples_;
  app::StreamOutput<ImuTruth> truths_;
};

}  // namespace inslab::imu
