#include "services/trajectory_server/truth_source.hpp"

namespace inslab::trajectory {

namespace {

std::vector<SensorAddress> sensors_of(const scenario::LoadedScenario& scenario) {
  std::vector<SensorAddress> sensors;
  for (const auto& imu : scenario.imus) sensors.push_back({SensorKind::Imu, imu.number});
  for (const auto& gnss : scenario.gnss) sensors.push_back({SensorKind::Gnss, gnss.number});
  return sensors;
}

}  // namespace

TruthSource::TruthSource(const scenario::LoadedScenario& scenario, const time::GpsTime& start, const RunId& run_id)
    : run_id_(run_id),
      rate_(scenario.truth_rate),
      samples_(scenario.truth_samples),
      model_(make_truth_model(scenario, start)),
      journal_(sensors_of(scenario), scenario.truth_rate),
      next_(model_->current()) {}

std::variant<AnyProfile, ProfileAck> TruthSource::submit(const AnyProfile& request) {
  const time::Nanoseconds last_sent = rate_.at(taken_ == 0 ? 0 : taken_ - 1);
  return journal_.submit(request, last_sent);
}

void TruthSource::prepare() {
  if (prepared_ || !has_next()) return;
  next_ = model_->advance();
  prepared_ = true;
}

TruthState TruthSource::take() {
  prepare();
  TruthState sample = next_;
  sample.header.run_id = run_id_;
  sample.journal_in_effect = journal_.in_effect(time::Nanoseconds(sample.header.sim_time_ns));
  prepared_ = false;
  ++taken_;
  return sample;
}

}  // namespace inslab::trajectory
