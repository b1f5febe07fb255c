#include "inslab/sim/truth_source.hpp"

#include <stdexcept>

namespace inslab::sim {

namespace {

std::vector<SensorAddress> sensors_of(const scenario::LoadedScenario& scenario) {
  std::vector<SensorAddress> sensors;
  for_each_sensor(scenario, [&sensors](auto kind, const auto& sensor) {
    sensors.push_back({decltype(kind)::type::kind, sensor.number});
  });
  return sensors;
}

}  // namespace

TruthSource::TruthSource(const scenario::LoadedScenario& scenario, const time::GpsTime& start, const RunId& run_id)
    : run_id_(run_id),
      grid_(scenario.truth_grid()),
      samples_(scenario.truth_samples),
      start_(start),
      model_(trajectory::make_truth_model(scenario, start)),
      live_vehicle_(dynamic_cast<trajectory::LiveVehicleModel*>(model_.get())),
      journal_(sensors_of(scenario), grid_, grid_.at(samples_ == 0 ? 0 : samples_ - 1)),
      scenario_(scenario),
      next_(model_->current()) {}

std::variant<catalog::AnyProfile, ProfileAck> TruthSource::submit(const catalog::AnyProfile& request) {
  if (const auto problem = scenario::recording_problem(request, scenario_)) {
    return rejected(request, "recorded_error", *problem);
  }
  return journal_.submit(request, last_time_);
}

std::optional<UsedVehicleState> TruthSource::receive(const VehicleState& state) {
  if (live_vehicle_ == nullptr) throw std::logic_error("the scenario's trajectory takes no states of a vehicle");
  const std::uint64_t number = live_vehicle_->link().used;
  if (!live_vehicle_->receive(state)) return std::nullopt;
  UsedVehicleState used;
  used.header.run_id = run_id_;
  used.header.sequence_number = number;
  used.header.sim_time_ns = next_time().count();
  const time::GpsTime gps = start_ + next_time();
  used.header.gps_week = gps.week;
  used.header.gps_time_of_week_ns = gps.time_of_week_ns;
  used.state = state;
  return used;
}

void TruthSource::prepare() {
  if (live_vehicle_ == nullptr) compute_next();
}

void TruthSource::compute_next() {
  if (prepared_ || !has_next()) return;
  next_ = model_->advance();
  prepared_ = true;
}

TruthState TruthSource::take() {
  compute_next();
  TruthState sample = next_;
  sample.header.run_id = run_id_;
  sample.journal_in_effect = journal_.in_effect(time::Nanoseconds(sample.header.sim_time_ns));
  prepared_ = false;
  ++taken_;
  last_time_ = next_time_;
  next_time_ = grid_.after(next_time_);
  return sample;
}

}  // namespace inslab::sim
