#include "inslab/sim/emulator.hpp"

#include "inslab/scenario/service_names.hpp"

namespace inslab::gnss {

namespace {

GnssModel::Setup setup_of(const scenario::LoadedScenario& scenario, const scenario::LoadedGnss& gnss) {
  return {scenario.stream_seed(), gnss.number,  gnss.rate,        gnss.errors,
          gnss.installation,      gnss.outages, gnss.outage_areas};
}

}  // namespace

Emulator::Emulator(const scenario::LoadedScenario& scenario, const scenario::LoadedGnss& gnss)
    : model_(setup_of(scenario, gnss)),
      desk_({SensorKind::Gnss, gnss.number}, app::kGnssEmulator, {gnss.errors, gnss.installation}) {}

Emulator::Result Emulator::process(const TruthState& truth) {
  Result result;
  for (const AnyProfile& entry : desk_.take_due(truth.header.sim_time_ns)) {
    std::visit(
        [this](const auto& profile) {
          using Profile = std::decay_t<decltype(profile)>;
          if constexpr (!std::is_same_v<Profile, ImuErrorProfile> && !std::is_same_v<Profile, VibrationProfile>) {
            model_.apply(profile);
          }
        },
        entry);
  }
  result.fix = model_.observe(truth);
  if (result.fix) {
    result.fix->header.run_id = truth.header.run_id;
    result.acks = desk_.acknowledge(result.fix->header);
  }
  return result;
}

}  // namespace inslab::gnss
