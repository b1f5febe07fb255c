#pragma once

#include <tuple>

#include "inslab/models/gnss/gnss_model.hpp"
#include "inslab/sim/run_sink.hpp"
#include "inslab/sim/sensor.hpp"

namespace inslab::sim {

template <>
struct SensorModel<catalog::Gnss> {
  using Model = gnss::GnssModel;
  using Output = GnssFix;
  using Beside = gnss::Pulse;

  static Model::Setup setup(const scenario::LoadedScenario& scenario, const scenario::LoadedGnss& gnss) {
    return {scenario.stream_seed(), gnss.number,  gnss.rate,         gnss.errors,
            gnss.installation,      gnss.outages, gnss.outage_areas, scenario.end(),
            scenario.fix_recordings};
  }
  static bool takes_profiles_at(const time::Rate&, const TruthState&) { return true; }
  static std::optional<Output> process(Model& model, const TruthState& truth) { return model.observe(truth); }
  static std::optional<Beside> beside(Model& model, const TruthState& truth) { return model.pulse(truth); }
  static void hand(RunSink& sink, std::size_t index, const Output& fix) { sink.gnss(index, fix); }
  static void hand(RunSink& sink, std::size_t index, const Beside& pulse) {
    sink.pulse(index, pulse.sample, pulse.truth);
  }
  static auto samples(Output& fix) { return std::tie(fix); }
  static auto samples(Beside& pulse) { return std::tie(pulse.sample, pulse.truth); }
};

}  // namespace inslab::sim
