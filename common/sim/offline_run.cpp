#include "inslab/sim/offline_run.hpp"

#include <stdexcept>

#include "inslab/models/navigation/app_setup.hpp"

namespace inslab::sim {

OfflineRun::OfflineRun(const scenario::LoadedScenario& scenario, const time::GpsTime& start, const RunId& run_id,
                       RunSink& sink, std::vector<UsedVehicleState> vehicle_states)
    : sink_(sink), run_id_(run_id), source_(scenario, start, run_id), vehicle_states_(std::move(vehicle_states)) {
  for_each_sensor(scenario, [&](auto kind, const auto& sensor) {
    sensors<typename decltype(kind)::type>().emplace_back(scenario, sensor);
  });
  if (const auto& app = scenario.scenario.reference_nav) {
    const navigation::AppSetup setup = navigation::setup_for(scenario, *app);
    navigator_.emplace(setup.parameters, setup.gravity);
    app_ = app;
  }
  for (const catalog::AnyProfile& request : scenario.swaps) {
    auto verdict = source_.submit(request);
    if (const auto* rejection = std::get_if<ProfileAck>(&verdict)) {
      sink_.ack(*rejection);
      continue;
    }
    const catalog::AnyProfile& entry = std::get<catalog::AnyProfile>(verdict);
    sink_.journal(entry);
    for_each_of(sensors_, [&entry](auto& of_a_kind) {
      for (auto& sensor : of_a_kind) sensor.add(entry);
    });
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

template <class Kind>
void OfflineRun::process(const TruthState& truth) {
  for (std::size_t i = 0; i < sensors<Kind>().size(); ++i) {
    typename Sensor<Kind>::Result result = sensors<Kind>()[i].process(truth);
    result.put_out([&](auto& output) {
      using Wiring = SensorModel<Kind>;
      Wiring::hand(sink_, i, output);
      constexpr bool is_beside = std::is_same_v<std::decay_t<decltype(output)>, Beside<Kind>>;
      if constexpr (scenario::is_navigated_by<Kind> && !is_beside) {
        const auto& sample = std::get<0>(Wiring::samples(output));
        if (navigator_ && scenario::is_of_the_app<Kind>(*app_, sample.sensor_number)) navigator_->add(sample);
      }
    });
    for (const ProfileAck& ack : result.acks) sink_.ack(ack);
  }
}

bool OfflineRun::step() {
  if (!source_.has_next()) {
    if (navigator_) navigate(navigation::Navigator::kEver);
    for_each_of(sensors_, [this](auto& of_a_kind) {
      for (auto& sensor : of_a_kind) {
        for (const ProfileAck& ack : sensor.close(run_id_)) sink_.ack(ack);
      }
    });
    return false;
  }
  use_vehicle_states();
  const TruthState truth = source_.take();
  sim_time_ = time::Nanoseconds(truth.header.sim_time_ns);
  sink_.truth(truth);
  for_each(catalog::SensorKinds{}, [this, &truth](auto kind) { process<typename decltype(kind)::type>(truth); });
  if (navigator_) navigate(sim_time_.count());
  return true;
}

}  // namespace inslab::sim
