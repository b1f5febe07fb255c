#pragma once

#include "app/service_options.hpp"
#include "scenario/load.hpp"

namespace inslab::app {

/// Gives a scenario the clock that the command line asks for. Throws config::Error when its rules forbid that.
void override_clock(const ClockOptions& options, scenario::LoadedScenario& loaded);

}  // namespace inslab::app
