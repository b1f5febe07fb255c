#pragma once

#include "inslab/bus/service/service_options.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::service {

/// Gives a scenario the clock that the command line asks for. Throws json::Error when its rules forbid that.
void override_clock(const ClockOptions& options, scenario::LoadedScenario& loaded);

}  // namespace inslab::service
