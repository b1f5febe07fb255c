#pragma once

#include "inslab/models/barometer/barometer_model.hpp"
#include "inslab/sim/instrument_wiring.hpp"

namespace inslab::sim {

template <>
struct SensorModel<catalog::Barometer> : InstrumentWiring<catalog::Barometer, barometer::BarometerModel> {
  static std::optional<Output> process(Model& model, const TruthState& truth) { return model.observe(truth); }
  static void hand(RunSink& sink, std::size_t index, const Output& sample) { sink.barometer(index, sample); }
};

}  // namespace inslab::sim
