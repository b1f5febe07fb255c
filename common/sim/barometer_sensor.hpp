#pragma once

#include <tuple>

#include "inslab/models/barometer/barometer_model.hpp"
#include "inslab/sim/run_sink.hpp"
#include "inslab/sim/sensor.hpp"

namespace inslab::sim {

template <>
struct SensorModel<catalog::Barometer> {
  using Model = barometer::BarometerModel;
  using Output = AirPressure;

  static Model::Setup setup(const scenario::LoadedScenario& scenario, const scenario::LoadedBarometer& sensor) {
    return {scenario.stream_seed(), sensor.number, sensor.rate, sensor.errors, sensor.installation};
  }
  static bool takes_profiles_at(const time::Rate&, const TruthState&) { return true; }
  static std::optional<Output> process(Model& model, const TruthState& truth) { return model.observe(truth); }
  static void hand(RunSink& sink, std::size_t index, const Output& sample) { sink.barometer(index, sample); }
  static auto samples(Output& sample) { return std::tie(sample); }
};

}  // namespace inslab::sim
