#pragma once

#include <optional>
#include <tuple>

#include "inslab/sim/run_sink.hpp"
#include "inslab/sim/sensor.hpp"

namespace inslab::sim {

/// What the wirings of instruments (models/sensing/instrument.hpp) with one stream have in common; each adds process()
/// and hand().
template <class Kind, class ModelOfKind>
struct InstrumentWiring {
  using Model = ModelOfKind;
  using Output = catalog::FirstSampleOf<Kind>;

  static typename Model::Setup setup(const scenario::LoadedScenario& scenario, const scenario::Loaded<Kind>& sensor) {
    return {scenario.stream_seed(), sensor.number, sensor.rate, sensor.errors, sensor.installation};
  }
  /// A sample shows an instant.
  static bool takes_profiles_at(const time::Rate&, const TruthState&) { return true; }
  static auto samples(Output& sample) { return std::tie(sample); }
};

}  // namespace inslab::sim
