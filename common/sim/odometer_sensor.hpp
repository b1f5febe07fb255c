#pragma once

#include <tuple>

#include "inslab/models/odometer/odometer_model.hpp"
#include "inslab/sim/run_sink.hpp"
#include "inslab/sim/sensor.hpp"

namespace inslab::sim {

template <>
struct SensorModel<catalog::Odometer> {
  using Model = odometer::OdometerModel;
  using Output = WheelTravel;

  static Model::Setup setup(const scenario::LoadedScenario& scenario, const scenario::LoadedOdometer& sensor) {
    return {scenario.stream_seed(), sensor.number, sensor.rate, sensor.errors, sensor.installation};
  }
  /// A sample is of a whole interval: profiles change where one begins.
  static bool takes_profiles_at(const time::Rate& rate, const TruthState& truth) {
    return rate.contains(time::Nanoseconds(truth.header.sim_time_ns - truth.interval_ns));
  }
  static std::optional<Output> process(Model& model, const TruthState& truth) { return model.measure(truth); }
  static void hand(RunSink& sink, std::size_t index, const Output& sample) { sink.odometer(index, sample); }
  static auto samples(Output& sample) { return std::tie(sample); }
};

}  // namespace inslab::sim
