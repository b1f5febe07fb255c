#pragma once

#include "inslab/bus/service/truth_follower.hpp"
#include "inslab/services/imu_error_injector/imu_outputs.hpp"
#include "inslab/sim/injector.hpp"

namespace inslab::imu {

/// The injector on the bus: what it puts out goes to inslab/imu/N, inslab/imu_truth/N and inslab/profile_ack.
class InjectorOnBus : public app::TruthConsumer {
 public:
  InjectorOnBus(app::Context& context, const scenario::LoadedImu& imu)
      : injector_(context.scenario(), imu),
        paced_by_nav_app_(context.scenario().scenario.require_nav_app &&
                          context.scenario().imus.front().number == imu.number),
        outputs_(context, imu, paced_by_nav_app_),
        acks_(context.participant(), dds::topics::profile_ack()) {}

  void begin_run(const RunId& run, ClockMode clock) override { outputs_.begin_run(run, clock); }
  void add(const AnyProfile& entry) override { injector_.add(entry); }
  bool ready_for(const TruthState& truth) const override { return injector_.ready_for(truth); }
  bool has_room() const override { return outputs_.has_room(); }
  std::string paced_by_nav_app() const override { return paced_by_nav_app_ ? outputs_.samples_topic() : ""; }

  void process(const TruthState& truth) override {
    Injector::Result result = injector_.process(truth);
    if (result.output) outputs_.put(result.output->sample, result.output->truth);
    for (const ProfileAck& ack : result.acks) acks_.write(ack);
  }
  void end_run(const RunId& run) override {
    for (const ProfileAck& ack : injector_.close(run)) acks_.write(ack);
  }
  void flush_blocks() override { outputs_.flush_blocks(); }

  void take(const Credit& credit) override { outputs_.take(credit); }
  std::vector<std::uint64_t> outputs_end() const override { return outputs_.ends(); }
  bool outputs_delivered(const std::vector<std::uint64_t>& ends) const override { return outputs_.delivered(ends); }
  bool outputs_logged() const override { return outputs_.are_logged(); }

  std::string missing_readers() const override {
    if (const std::string missing = outputs_.missing_readers(); !missing.empty()) return missing;
    return acks_.matched_readers() > 0 ? "" : "waits for a reader of inslab/profile_ack";
  }
  void save(recovery::StateWriter& writer) const override {
    writer(injector_);
    outputs_.save(writer);
  }
  void load(recovery::StateReader& reader) override {
    reader(injector_);
    outputs_.load(reader);
  }
  void report(ServiceStatus& status) const override { outputs_.report(status); }
  void flush(time::Nanoseconds deadline) override {
    outputs_.wait_for_acknowledgments(deadline);
    acks_.wait_for_acknowledgments(app::time_left(deadline));
  }

 private:
  Injector injector_;
  bool paced_by_nav_app_;
  ImuOutputs outputs_;
  dds::Writer<ProfileAck> acks_;
};

}  // namespace inslab::imu
