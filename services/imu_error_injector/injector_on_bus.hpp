#pragma once

#include "app/stamp.hpp"
#include "app/truth_follower.hpp"
#include "services/imu_error_injector/injector.hpp"

namespace inslab::imu {

/// The injector on the bus: what it puts out goes to inslab/imu/N, inslab/imu_truth/N and inslab/profile_ack.
class InjectorOnBus : public app::TruthConsumer {
 public:
  InjectorOnBus(app::Context& context, const scenario::LoadedImu& imu)
      : injector_(context.scenario(), imu),
        imu_topic_(dds::topics::imu(imu.number, 1.0 / imu.rate.period_s())),
        truth_topic_(dds::topics::imu_truth(imu.number, 1.0 / imu.rate.period_s())),
        samples_(context.participant(), imu_topic_),
        truths_(context.participant(), truth_topic_),
        acks_(context.participant(), dds::topics::profile_ack()),
        samples_sent_(imu_topic_.name, StreamDirection::Out),
        truths_sent_(truth_topic_.name, StreamDirection::Out) {}

  void add(const AnyProfile& entry) override { injector_.add(entry); }
  bool ready_for(const TruthState& truth) const override { return injector_.ready_for(truth); }

  void process(const TruthState& truth) override {
    Injector::Result result = injector_.process(truth);
    if (result.output) {
      if (samples_.write(app::stamped(result.output->sample))) samples_sent_.sent();
      if (truths_.write(app::stamped(result.output->truth))) truths_sent_.sent();
    }
    for (const ProfileAck& ack : result.acks) acks_.write(ack);
  }

  bool outputs_matched() const override {
    return samples_.matched_readers() > 0 && truths_.matched_readers() > 0 && acks_.matched_readers() > 0;
  }
  void report(ServiceStatus& status) const override {
    status.streams.push_back(samples_sent_.status());
    status.streams.push_back(truths_sent_.status());
  }
  void flush(std::chrono::nanoseconds timeout) override {
    samples_.wait_for_acknowledgments(timeout);
    truths_.wait_for_acknowledgments(timeout);
    acks_.wait_for_acknowledgments(timeout);
  }

 private:
  Injector injector_;
  dds::Topic<ImuSample> imu_topic_;
  dds::Topic<ImuTruth> truth_topic_;
  dds::Writer<ImuSample> samples_;
  dds::Writer<ImuTruth> truths_;
  dds::Writer<ProfileAck> acks_;
  app::StreamMonitor samples_sent_;
  app::StreamMonitor truths_sent_;
};

}  // namespace inslab::imu
