// The injector and the emulator with models that only copy bytes: the same processes, topics, sizes, settings and
// threads as the product's. What the product's chain takes beyond theirs its models take.
//
//   bench_copying_service inslab-imu-injector|inslab-gnss-emulator, then the service's own options

#include <memory>
#include <stdexcept>

#include "inslab/bus/service/stream_output.hpp"
#include "inslab/bus/service/truth_follower.hpp"
#include "inslab/data/samples/gnss_fix.hpp"
#include "inslab/data/samples/imu_truth.hpp"
#include "inslab/scenario/service_names.hpp"
#include "inslab/services/sensor/sensor_outputs.hpp"

namespace inslab::bench {
namespace {

/// What both have in common: no journal, no checkpoint, no acknowledgements.
class Copier : public service::TruthConsumer {
 public:
  void add(const catalog::AnyProfile&) override {}
  bool ready_for(const TruthState&) const override { return true; }
  void save(state::StateWriter&) const override {}
  void load(state::StateReader&) override {}
};

class CopyingInjector : public Copier {
 public:
  CopyingInjector(service::Context& context, const scenario::LoadedImu& imu)
      : number_(imu.number), outputs_(context, imu, false) {}

  void begin_run(const RunId& run, ClockMode clock) override { outputs_.begin_run(run, clock); }
  bool has_room() const override { return outputs_.has_room(); }
  void process(const TruthState& truth) override {
    if (truth.header.sequence_number == 0) return;
    ImuSample sample;
    sample.header = truth.header;
    --sample.header.sequence_number;
    sample.sensor_number = number_;
    sample.dtheta_b = truth.dtheta_v;
    sample.dv_b = truth.dv_v;
    sample.interval_ns = truth.interval_ns;
    ImuTruth perfect;
    perfect.header = sample.header;
    perfect.sensor_number = number_;
    perfect.dtheta_b = truth.dtheta_v;
    perfect.dv_b = truth.dv_v;
    outputs_.put(sample, perfect);
  }
  void end_run(const RunId&) override {}  // it has no swaps
  void flush_blocks() override { outputs_.flush_blocks(); }
  void take(const Credit& credit) override { outputs_.take(credit); }
  std::vector<std::uint64_t> outputs_end() const override { return outputs_.ends(); }
  bool outputs_delivered(const std::vector<std::uint64_t>& ends) const override { return outputs_.delivered(ends); }
  bool outputs_logged() const override { return outputs_.are_logged(); }
  std::string missing_readers() const override { return outputs_.missing_readers(); }
  void report(ServiceStatus& status) const override { outputs_.report(status); }
  void flush(time::Nanoseconds deadline) override { outputs_.wait_for_acknowledgments(deadline); }

 private:
  std::uint32_t number_;
  sensor::SensorOutputs<catalog::Imu> outputs_;
};

class CopyingEmulator : public Copier {
 public:
  CopyingEmulator(service::Context& context, const scenario::LoadedGnss& gnss)
      : number_(gnss.number),
        period_ns_(gnss.rate.period().count()),
        fixes_(context, dds::topics::stream<GnssFix>(gnss.number, 1.0 / gnss.rate.period_s()),
               {{{catalog::kTruthLogger, 0u}}}) {}

  void begin_run(const RunId& run, ClockMode clock) override { fixes_.begin_run(run, clock); }
  bool has_room() const override { return fixes_.has_room(); }
  void process(const TruthState& truth) override {
    if (truth.header.sim_time_ns == 0 || truth.header.sim_time_ns % period_ns_ != 0) return;
    GnssFix fix;
    fix.header = truth.header;
    fix.header.sequence_number = next_++;
    fix.sensor_number = number_;
    fix.latitude_rad = truth.latitude_rad;
    fix.longitude_rad = truth.longitude_rad;
    fix.height_m = truth.height_m;
    fix.v_n = truth.v_n;
    fixes_.put(fix);
  }
  void end_run(const RunId&) override {}  // it has no swaps
  void flush_blocks() override { fixes_.flush_block(); }
  void take(const Credit& credit) override { fixes_.take(credit); }
  std::vector<std::uint64_t> outputs_end() const override { return {fixes_.next_sequence()}; }
  bool outputs_delivered(const std::vector<std::uint64_t>& ends) const override {
    return fixes_.lowest_wanted() >= ends[0];
  }
  bool outputs_logged() const override { return fixes_.is_logged(); }
  std::string missing_readers() const override { return fixes_.missing_readers(); }
  void report(ServiceStatus& status) const override { status.streams.push_back(fixes_.status()); }
  void flush(time::Nanoseconds deadline) override { fixes_.wait_for_acknowledgments(deadline); }

 private:
  std::uint32_t number_;
  std::int64_t period_ns_;
  service::StreamOutput<GnssFix> fixes_;
  std::uint64_t next_ = 0;
};

}  // namespace
}  // namespace inslab::bench

int main(int argc, char** argv) {
  using namespace inslab;
  const std::string service = argc > 1 ? argv[1] : "";
  if (service == catalog::Imu::service) {
    return service::run_service(catalog::Imu::service, "Copies truth to an IMU's topics", {true, false}, argc - 1,
                                argv + 1, [](service::Context& context) {
                                  const std::uint32_t sensor = context.options().sensor;
                                  bench::CopyingInjector bus(context, context.scenario().sensor<catalog::Imu>(sensor));
                                  return service::TruthFollower(context, sensor, bus).run();
                                });
  }
  return service::run_service(catalog::Gnss::service, "Copies truth to a receiver's topic", {true, false}, argc - 1,
                              argv + 1, [](service::Context& context) {
                                const std::uint32_t sensor = context.options().sensor;
                                bench::CopyingEmulator bus(context, context.scenario().sensor<catalog::Gnss>(sensor));
                                return service::TruthFollower(context, sensor, bus).run();
                              });
}
