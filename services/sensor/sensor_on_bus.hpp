#pragma once

#include "inslab/bus/service/truth_follower.hpp"
#include "inslab/services/sensor/sensor_outputs.hpp"
#include "inslab/sim/sensor.hpp"

namespace inslab::sensor {

/// One sensor on the bus: what it puts out goes to its streams and to inslab/profile_ack.
template <class Kind>
class SensorOnBus : public service::TruthConsumer {
 public:
  SensorOnBus(service::Context& context, const scenario::Loaded<Kind>& sensor)
      : sensor_(context.scenario(), sensor),
        paced_by_nav_app_(Kind::sets_the_pace && context.scenario().scenario.require_nav_app &&
                          scenario::sensors_of<Kind>(context.scenario()).front().number == sensor.number),
        outputs_(context, sensor, paced_by_nav_app_),
        acks_(context.participant(), dds::topics::profile_ack()) {}

  void begin_run(const RunId& run, ClockMode clock) override { outputs_.begin_run(run, clock); }
  void add(const catalog::AnyProfile& entry) override { sensor_.add(entry); }
  bool ready_for(const TruthState& truth) const override { return sensor_.ready_for(truth); }
  bool has_room() const override { return outputs_.has_room(); }
  std::string paced_by_nav_app() const override { return paced_by_nav_app_ ? outputs_.topic() : ""; }

  void process(const TruthState& truth) override {
    auto result = sensor_.process(truth);
    result.put_out([this](auto& output) {
      std::apply([this](auto&... sample) { outputs_.put(sample...); }, sim::SensorModel<Kind>::samples(output));
    });
    for (const ProfileAck& ack : result.acks) acks_.write(ack);
  }
  void end_run(const RunId& run) override {
    for (const ProfileAck& ack : sensor_.close(run)) acks_.write(ack);
  }
  void flush_blocks() override { outputs_.flush_blocks(); }

  void take(const Credit& credit) override { outputs_.take(credit); }
  std::vector<std::uint64_t> outputs_end() const override { return outputs_.ends(); }
  bool outputs_delivered(const std::vector<std::uint64_t>& ends) const override { return outputs_.delivered(ends); }
  bool outputs_logged() const override { return outputs_.are_logged(); }

  std::string missing_readers() const override {
    if (const std::string missing = outputs_.missing_readers(); !missing.empty()) return missing;
    return acks_.matched_readers() > 0 ? "" : std::string("waits for a reader of ") + catalog::kProfileAck.name;
  }
  void save(state::StateWriter& writer) const override {
    writer(sensor_);
    outputs_.save(writer);
  }
  void load(state::StateReader& reader) override {
    reader(sensor_);
    outputs_.load(reader);
  }
  void report(ServiceStatus& status) const override { outputs_.report(status); }
  void flush(time::Nanoseconds deadline) override {
    outputs_.wait_for_acknowledgments(deadline);
    acks_.wait_for_acknowledgments(service::time_left(deadline));
  }

 private:
  sim::Sensor<Kind> sensor_;
  bool paced_by_nav_app_;
  SensorOutputs<Kind> outputs_;
  dds::Writer<ProfileAck> acks_;
};

/// The service of one sensor of a kind: its main().
template <class Kind>
int run_sensor(int argc, char** argv) {
  return service::run_service(Kind::service, Kind::purpose, {true, false}, argc, argv, [](service::Context& context) {
    const std::uint32_t number = context.options().sensor;
    SensorOnBus<Kind> bus(context, context.scenario().template sensor<Kind>(number));
    return service::TruthFollower(context, number, bus).run();
  });
}

}  // namespace inslab::sensor
