#pragma once

#include "inslab/models/heading/heading_model.hpp"
#include "inslab/sim/instrument_wiring.hpp"

namespace inslab::sim {

template <>
struct SensorModel<catalog::Heading> : InstrumentWiring<catalog::Heading, heading::HeadingModel> {
  static Model::Setup setup(const scenario::LoadedScenario& scenario, const scenario::LoadedHeading& sensor) {
    return {{scenario.stream_seed(), sensor.number, sensor.rate, sensor.errors, sensor.installation},
            sensor.outages,
            sensor.outage_areas};
  }
  static std::optional<Output> process(Model& model, const TruthState& truth) { return model.observe(truth); }
  static void hand(RunSink& sink, std::size_t index, const Output& sample) { sink.heading(index, sample); }
};

}  // namespace inslab::sim
