#pragma once

#include "inslab/models/air_data/air_data_model.hpp"
#include "inslab/sim/instrument_wiring.hpp"

namespace inslab::sim {

template <>
struct SensorModel<catalog::AirData> : InstrumentWiring<catalog::AirData, air_data::AirDataModel> {
  using Output = Model::Output;

  static std::optional<Output> process(Model& model, const TruthState& truth) { return model.observe(truth); }
  static void hand(RunSink& sink, std::size_t index, const Output& output) {
    sink.air_data(index, output.sample, output.truth);
  }
  static auto samples(Output& output) { return std::tie(output.sample, output.truth); }
};

}  // namespace inslab::sim
