#include "inslab/sim/offline_run.hpp"

#include <stdexcept>

#include "inslab/models/navigation/app_setup.hpp"

namespace inslab::cli {

OfflineRun::OfflineRun(const scenario::LoadedScenario& scenario, const time::GpsTime& start, const RunId& run_id,
                       RunSink& sink, std::vector<UsedVehicleState> vehicle_states)
    : sink_(sink), run_id_(run_id), source_(scenario, start, run_id), vehicle_states_(std::move(vehicle_states)) {
  for (const auto& imu : scenario.imus) injectors_.emplace_back(scenario, imu);
  for (const auto& gnss : scenario.gnss) emulators_.emplace_back(scenario, gnss);
  if (const auto& app = scenario.scenario.reference_nav) {
    const reference_nav::AppSetup setup = reference_nav::setup_for(scenario, *app);
    navigator_.emplace(setup.parameters, setup.gravity);
    while (scenario.imus[nav_imu_].number != app->imu) ++nav_imu_;
    while (scenario.gnss[nav_gnss_].number != app->gnss) ++nav_gnss_;
  }
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

/// Before a truth sample, what the live run knew before it.
void OfflineRun::use_vehicle_states() {
  while (next_vehicle_state_ < vehicle_states_.size()) {
    const UsedVehicleState& logged = vehicle_states_[next_vehicle_state_];
    if (logged.header.sim_time_ns > source_.next_time().count()) return;
    const auto used = source_.receive(logged.state);
    if (!used) {
      throw std::runtime_error(
          "state " + std::to_string(logged.header.sequence_number) +
          " of the vehicle does not belong to this scenario: " + source_.vehicle_link()->last_refusal);
    }
    sink_.vehicle_state(*used);
    ++next_vehicle_state_;
  }
}

void OfflineRun::navigate(std::int64_t fixes_complete_up_to_ns) {
  navigator_->fixes_complete_up_to(fixes_complete_up_to_ns);
  while (const auto step = navigator_->step()) {
    if (step->solution) sink_.nav(*step->solution);
  }
}

void OfflineRun::leave_navigation() {
  navigator_.reset();
  emulators_.clear();
}

void OfflineRun::leave_sensors() {
  leave_navigation();
  injectors_.clear();
}

bool OfflineRun::step() {
  if (!source_.has_next()) {
    if (navigator_) navigate(reference_nav::Navigator::kEver);
    for (auto& injector : injectors_) {
      for (const ProfileAck& ack : injector.close(run_id_)) sink_.ack(ack);
    }
    for (auto& emulator : emulators_) {
      for (const ProfileAck& ack : emulator.close(run_id_)) sink_.ack(ack);
    }
    return false;
  }
  use_vehicle_states();
  const TruthState truth = source_.take();
  sim_time_ = time::Nanoseconds(truth.header.sim_time_ns);
  sink_.truth(truth);
  for (std::size_t i = 0; i < injectors_.size(); ++i) {
    const imu::Injector::Result result = injectors_[i].process(truth);
    if (result.output) {
      sink_.imu(i, result.output->sample, result.output->truth);
      if (navigator_ && i == nav_imu_) navigator_->add(result.output->sample);
    }
    for (const ProfileAck& ack : result.acks) sink_.ack(ack);
  }
  for (std::size_t i = 0; i < emulators_.size(); ++i) {
    const gnss::Emulator::Result result = emulators_[i].process(truth);
    if (result.fix) {
      sink_.gnss(i, *result.fix);
      if (navigator_ && i == nav_gnss_) navigator_->add(*result.fix);
    }
    for (const ProfileAck& ack : result.acks) sink_.ack(ack);
  }
  if (navigator_) navigate(sim_time_.count());
  return true;
}

}  // namespace inslab::cli
