#pragma once

#include "inslab/noise/allan/fit.hpp"

namespace inslab::allan {

/// What a record speaks for, where a process faster than a few samples is white noise.
struct ChosenFit {
  Likelihood likelihood;  ///< what the fit is of: of the record from `finest_tau_s` on
  Fit fit;
  double finest_tau_s = 0.0;
  double fast_process_s = 0.0;  ///< correlation time of a process taken for white noise; 0: there is none
};

/// select(), but a Gauss-Markov process that is faster than four samples is not kept as one: it is how a sensor's
/// filter shapes its white noise, and a twin with it would lack the random walk. The fit then begins at 64 of its
/// correlation times, from where its Allan deviation is that of white noise to 1.2 %. A record too short for that keeps
/// what select() says, with the process's density as white noise.
ChosenFit choose_fit(const Record& record, double finest_tau_s);

}  // namespace inslab::allan
