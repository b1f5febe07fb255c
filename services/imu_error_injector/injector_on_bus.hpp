#pragma once

#include "app/service_names.hpp"
#include "app/stream_output.hpp"
#include "app/truth_follower.hpp"
#include "services/imu_error_injector/injector.hpp"

namespace inslab::imu {

/// The injector on the bus: what it puts out goes to inslab/imu/N, inslab/imu_truth/N and inslab/profile_ack.
class InjectorOnBus : public app::TruthConsumer {
 public:
  InjectorOnBus(app::Context& context, const scenario::LoadedImu& imu)
      : injector_(context.scenario(), imu),
        paced_by_nav_app_(context.scenario().scenario.require_nav_app &&
                          context.scenario().imus.front().number == imu.number),
        samples_(context, dds::topics::imu(imu.number, 1.0 / imu.rate.period_s()),
                 {{{app::kTruthLogger, 0u}}, paced_by_nav_app_}),
        truths_(context, dds::topics::imu_truth(imu.number, 1.0 / imu.rate.period_s()), {{{app::kTruthLogger, 0u}}}),
        acks_(context.participant(), dds::topics::profile_ack()) {}

  void begin_run(const RunId& run, ClockMode clock) override {
    samples_.begin_run(run, clock);
    truths_.begin_run(run, clock);
  }
  void add(const AnyProfile& entry) override { injector_.add(entry); }
  bool ready_for(const TruthState& truth) const override { return injector_.ready_for(truth); }
  bool has_room() const override { return samples_.has_room() && truths_.has_room(); }
  std::string paced_by_nav_app() const override { return paced_by_nav_app_ ? samples_.topic() : ""; }

  void process(const TruthState& truth) override {
    Injector::Result result = injector_.process(truth);
    if (result.output) {
      samples_.put(result.output->sample);
      truths_.put(result.output->truth);
    }
    for (const ProfileAck& ack : result.acks) acks_.write(ack);
  }
  void flush_blocks() override {
    samples_.flush_block();
    truths_.flush_block();
  }

  void take(const Credit& credit) override {
    samples_.take(credit);
    truths_.take(credit);
  }
  std::vector<std::uint64_t> outputs_end() const override {
    return {samples_.next_sequence(), truths_.next_sequence()};
  }
  bool outputs_delivered(const std::vector<std::uint64_t>& ends) const override {
    return samples_.lowest_wanted() >= ends[0] && truths_.lowest_wanted() >= ends[1];
  }

  std::string missing_readers() const override {
    for (const std::string& missing : {samples_.missing_readers(), truths_.missing_readers()}) {
      if (!missing.empty()) return missing;
    }
    return acks_.matched_readers() > 0 ? "" : "waits for a reader of inslab/profile_ack";
  }
  void save(recovery::StateWriter& writer) const override {
    writer(injector_);
    samples_.save(writer);
    truths_.save(writer);
  }
  void load(recovery::StateReader& reader) override {
    reader(injector_);
    samples_.load(reader);
    truths_.load(reader);
  }
  void report(ServiceStatus& status) const override {
    status.streams.push_back(samples_.status());
    status.streams.push_back(truths_.status());
  }
  void flush(time::Nanoseconds deadline) override {
    samples_.wait_for_acknowledgments(deadline);
    truths_.wait_for_acknowledgments(deadline);
    acks_.wait_for_acknowledgments(app::time_left(deadline));
  }

 private:
  Injector injector_;
  bool paced_by_nav_app_;
  app::StreamOutput<ImuSample> samples_;
  app::StreamOutput<ImuTruth> truths_;
  dds::Writer<ProfileAck> acks_;
};

}  // namespace inslab::imu
