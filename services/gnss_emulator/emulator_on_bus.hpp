#pragma once

#include "inslab/bus/service/stream_output.hpp"
#include "inslab/bus/service/truth_follower.hpp"
#include "inslab/scenario/service_names.hpp"
#include "inslab/sim/emulator.hpp"

namespace inslab::gnss {

/// The emulator on the bus: fixes go to inslab/gnss/N, acknowledgements to inslab/profile_ack.
class EmulatorOnBus : public app::TruthConsumer {
 public:
  EmulatorOnBus(app::Context& context, const scenario::LoadedGnss& gnss)
      : emulator_(context.scenario(), gnss),
        fixes_(context, dds::topics::gnss(gnss.number, gnss.rate.hz()),
               {app::stream_consumers(context.scenario().scenario, SensorKind::Gnss, gnss.number), false,
                app::StreamOutput<GnssFix>::kWindowSamples, app::StreamOutput<GnssFix>::half_a_minute(gnss.rate.hz())}),
        acks_(context.participant(), dds::topics::profile_ack()) {}

  void begin_run(const RunId& run, ClockMode clock) override { fixes_.begin_run(run, clock); }
  void add(const AnyProfile& entry) override { emulator_.add(entry); }
  bool ready_for(const TruthState& truth) const override { return emulator_.ready_for(truth); }
  bool has_room() const override { return fixes_.has_room(); }

  void process(const TruthState& truth) override {
    Emulator::Result result = emulator_.process(truth);
    if (result.fix) fixes_.put(*result.fix);
    for (const ProfileAck& ack : result.acks) acks_.write(ack);
  }
  void end_run(const RunId& run) override {
    for (const ProfileAck& ack : emulator_.close(run)) acks_.write(ack);
  }
  void flush_blocks() override { fixes_.flush_block(); }

  void take(const Credit& credit) override { fixes_.take(credit); }
  std::vector<std::uint64_t> outputs_end() const override { return {fixes_.next_sequence()}; }
  bool outputs_delivered(const std::vector<std::uint64_t>& ends) const override {
    return fixes_.lowest_wanted() >= ends[0];
  }
  bool outputs_logged() const override { return fixes_.is_logged(); }

  std::string missing_readers() const override {
    if (const std::string missing = fixes_.missing_readers(); !missing.empty()) return missing;
    return acks_.matched_readers() > 0 ? "" : "waits for a reader of inslab/profile_ack";
  }
  void save(recovery::StateWriter& writer) const override {
    writer(emulator_);
    fixes_.save(writer);
  }
  void load(recovery::StateReader& reader) override {
    reader(emulator_);
    fixes_.load(reader);
  }
  void report(ServiceStatus& status) const override { status.streams.push_back(fixes_.status()); }
  void flush(time::Nanoseconds deadline) override {
    fixes_.wait_for_acknowledgments(deadline);
    acks_.wait_for_acknowledgments(app::time_left(deadline));
  }

 private:
  Emulator emulator_;
  app::StreamOutput<GnssFix> fixes_;
  dds::Writer<ProfileAck> acks_;
};

}  // namespace inslab::gnss
