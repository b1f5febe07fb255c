#pragma once

#include <vector>

#include "inslab/data/samples/airflow_truth.hpp"
#include "inslab/referee/evidence/swap_evidence.hpp"
#include "inslab/referee/evidence/swap_window.hpp"

namespace inslab::evidence {

/// What a profile leaves of a sample's impact pressure, static pressure (Pa) and angle of attack (deg) when the air at
/// the probe, the lines and all scale factors are taken off: offset and noise.
Vector3 left_of_airflow(const Airflow& sample, const AirflowTruth& perfect, const AirDataErrorProfile& errors);

/// What a swap of an air data probe's errors or place promises: noise and offset of both pressures and of the angle of
/// attack.
std::vector<EvidenceLine> air_data_lines(const LogSummary& summary, const SwapWindows& swap, double period_s);

}  // namespace inslab::evidence
