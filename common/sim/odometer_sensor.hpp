#pragma once

#include "inslab/models/odometer/odometer_model.hpp"
#include "inslab/sim/instrument_wiring.hpp"

namespace inslab::sim {

template <>
struct SensorModel<catalog::Odometer> : InstrumentWiring<catalog::Odometer, odometer::OdometerModel> {
  /// A sample is of a whole interval: profiles change where one begins.
  static bool takes_profiles_at(const time::Rate& rate, const TruthState& truth) {
    return rate.contains(time::Nanoseconds(truth.header.sim_time_ns - truth.interval_ns));
  }
  static std::optional<Output> process(Model& model, const TruthState& truth) { return model.measure(truth); }
  static void hand(RunSink& sink, std::size_t index, const Output& sample) { sink.odometer(index, sample); }
};

}  // namespace inslab::sim
