#pragma once

#include "inslab/models/navigation/state_layout.hpp"

namespace inslab::navigation {

/// What a block of errors does by itself: Gauss-Markov, each for itself. Gravity goes on with the way instead
/// (Transition::gravity).
struct Process {
  Vector3 sigma = Vector3::Zero();               ///< steady state, and at the beginning; in the block's unit
  Vector3 correlation_time_s = Vector3::Zero();  ///< 0: a constant
};

/// Of a block behind position, velocity and attitude.
Process process_of(StateBlock block, const NavigationParameters& parameters);

/// Standard deviations of the state at the beginning: what the parameters say.
StateVector initial_sigmas(const NavigationParameters& parameters);

}  // namespace inslab::navigation
