#pragma once

#include "app/stamp.hpp"
#include "app/truth_follower.hpp"
#include "services/gnss_emulator/emulator.hpp"

namespace inslab::gnss {

/// The emulator on the bus: fixes go to inslab/gnss/N, acknowledgements to inslab/profile_ack.
class EmulatorOnBus : public app::TruthConsumer {
 public:
  EmulatorOnBus(app::Context& context, const scenario::LoadedGnss& gnss)
      : emulator_(context.scenario(), gnss),
        topic_(dds::topics::gnss(gnss.number, 1.0 / gnss.rate.period_s())),
        fixes_(context.participant(), topic_),
        acks_(context.participant(), dds::topics::profile_ack()),
        fixes_sent_(topic_.name, StreamDirection::Out) {}

  void add(const AnyProfile& entry) override { emulator_.add(entry); }
  bool ready_for(const TruthState& truth) const override { return emulator_.ready_for(truth); }

  void process(const TruthState& truth) override {
    Emulator::Result result = emulator_.process(truth);
    if (result.fix && fixes_.write(app::stamped(*result.fix))) fixes_sent_.sent();
    for (const ProfileAck& ack : result.acks) acks_.write(ack);
  }

  bool outputs_matched() const override { return fixes_.matched_readers() > 0 && acks_.matched_readers() > 0; }
  void report(ServiceStatus& status) const override { status.streams.push_back(fixes_sent_.status()); }
  void flush(std::chrono::nanoseconds timeout) override {
    fixes_.wait_for_acknowledgments(timeout);
    acks_.wait_for_acknowledgments(timeout);
  }

 private:
  Emulator emulator_;
  dds::Topic<GnssFix> topic_;
  dds::Writer<GnssFix> fixes_;
  dds::Writer<ProfileAck> acks_;
  app::StreamMonitor fixes_sent_;
};

}  // namespace inslab::gnss
