#include "inslab/bus/service/clock_override.hpp"

#include "inslab/data/json/config_error.hpp"

namespace inslab::service {

void override_clock(const ClockOptions& options, scenario::LoadedScenario& loaded) {
  scenario::Clock& clock = loaded.scenario.clock;
  if (!options.mode.empty()) clock.mode = options.mode == "lockstep" ? ClockMode::Lockstep : ClockMode::RealTime;
  if (options.rate > 0.0) clock.rate = options.rate;
  if (options.paused) clock.start_paused = true;
  if (const auto broken = scenario::violation(loaded.scenario)) throw json::Error(loaded.file.string(), *broken);
}

}  // namespace inslab::service
