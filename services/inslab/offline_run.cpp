#include "services/inslab/offline_run.hpp"

namespace inslab::cli {

OfflineRun::OfflineRun(const scenario::LoadedScenario& scenario, const time::GpsTime& start, const RunId& run_id,
                       RunSink& sink)
    : sink_(sink), source_(scenario, start, run_id) {
  for (const auto& imu : scenario.imus) injectors_.emplace_back(scenario, imu);
  for (const auto& gnss : scenario.gnss) emulators_.emplace_back(scenario, gnss);
  for (const AnyProfile& request : scenario.swaps) {
    auto verdict = source_.submit(request);
    if (const auto* rejection = std::get_if<ProfileAck>(&verdict)) {
      sink_.ack(*rejection);
      continue;
    }
    const AnyProfile& entry = std::get<AnyProfile>(verdict);
    sink_.journal(entry);
    for (auto& injector : injectors_) injector.add(entry);
    for (auto& emulator : emulators_) emulator.add(entry);
  }
}

bool OfflineRun::step() {
  if (!source_.has_next()) return false;
  const TruthState truth = source_.take();
  sim_time_ = time::Nanoseconds(truth.header.sim_time_ns);
  sink_.truth(truth);
  for (std::size_t i = 0; i < injectors_.size(); ++i) {
    const imu::Injector::Result result = injectors_[i].process(truth);
    if (result.output) sink_.imu(i, result.output->sample, result.output->truth);
    for (const ProfileAck& ack : result.acks) sink_.ack(ack);
  }
  for (std::size_t i = 0; i < emulators_.size(); ++i) {
    const gnss::Emulator::Result result = emulators_[i].process(truth);
    if (result.fix) sink_.gnss(i, *result.fix);
    for (const ProfileAck& ack : result.acks) sink_.ack(ack);
  }
  return true;
}

}  // namespace inslab::cli
