#pragma once

#include "inslab/models/magnetometer/magnetometer_model.hpp"
#include "inslab/sim/instrument_wiring.hpp"

namespace inslab::sim {

template <>
struct SensorModel<catalog::Magnetometer> : InstrumentWiring<catalog::Magnetometer, magnetometer::MagnetometerModel> {
  static std::optional<Output> process(Model& model, const TruthState& truth) { return model.observe(truth); }
  static void hand(RunSink& sink, std::size_t index, const Output& sample) { sink.magnetometer(index, sample); }
};

}  // namespace inslab::sim
