#include "inslab/sim/injector.hpp"

#include "inslab/scenario/service_names.hpp"

namespace inslab::imu {

namespace {

ImuModel::Setup setup_of(const scenario::LoadedScenario& scenario, const scenario::LoadedImu& imu) {
  return {scenario.stream_seed(), imu.number,      imu.rate, scenario.gravity(), imu.errors,
          imu.vibration,          imu.installation};
}

}  // namespace

Injector::Injector(const scenario::LoadedScenario& scenario, const scenario::LoadedImu& imu)
    : rate_(imu.rate),
      model_(setup_of(scenario, imu)),
      desk_({SensorKind::Imu, imu.number}, app::kImuInjector, {imu.errors, imu.vibration, imu.installation}) {}

Injector::Result Injector::process(const TruthState& truth) {
  Result result;
  // An IMU slower than the truth swaps between two of its own intervals: only where one begins is anything due.
  const bool interval_begins = rate_.contains(time::Nanoseconds(truth.header.sim_time_ns - truth.interval_ns));
  if (interval_begins) {
    for (const AnyProfile& entry : desk_.take_due(truth.header.sim_time_ns)) {
      std::visit(
          [this](const auto& profile) {
            if constexpr (!std::is_same_v<std::decay_t<decltype(profile)>, GnssErrorProfile>) model_.apply(profile);
          },
          entry);
    }
  }
  result.output = model_.measure(truth);
  if (result.output) {
    result.output->sample.header.run_id = truth.header.run_id;
    result.output->truth.header.run_id = truth.header.run_id;
    result.acks = desk_.acknowledge(result.output->sample.header);
  }
  return result;
}

}  // namespace inslab::imu
