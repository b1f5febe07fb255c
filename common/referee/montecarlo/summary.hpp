#pragma once

#include <string>

#include "inslab/referee/montecarlo/estimate.hpp"
#include "inslab/referee/montecarlo/run_result.hpp"

namespace inslab::montecarlo {

/// One figure over the runs that have it.
struct Distribution {
  std::vector<double> values;  ///< in order of the runs
  Estimate mean;
  Estimate rms;
  Estimate p50;
  Estimate p95;
  Estimate p99;
};

/// At least one value.
Distribution distribution_of(std::vector<double> values);

struct FigureSummary {
  RunFigure figure;  ///< its value is that of the first run
  Distribution over_runs;
};

/// One outage over the runs; there only when every run has as many outages.
struct OutageSummary {
  double begin_s = 0.0;  ///< in the first run
  double end_s = 0.0;
  Distribution horizontal_m;
  Distribution vertical_m;
};

/// Errors of one kind over the runs at one instant, and what the filters believed.
struct Believed {
  Estimate rms;
  double sigma = 0.0;  ///< RMS over the runs of the reported standard deviation
};

struct InstantSummary {
  double time_s = 0.0;
  std::size_t runs = 0;
  Believed horizontal_m;
  Believed vertical_m;
  Believed velocity_m_per_s;
  Believed tilt_deg;
  Believed heading_deg;
  Estimate cep50_m;
  Estimate cep95_m;
  double nees = 0.0;          ///< mean over the runs
  allan::Interval nees_band;  ///< holds `nees` with kConfidence when the filters are honest
};

struct LineSummary {
  std::string line;
  bool judged = true;
  std::string why;  ///< of a line that is not judged, or of the first run that failed it
  std::size_t passed = 0;
  Estimate share;
};

struct FailedRun {
  std::uint32_t run = 0;
  std::uint64_t seed = 0;
  std::string reason;
};

/// What the runs of a study say together.
struct Summary {
  std::string name;
  std::string fingerprint;
  std::uint64_t first_seed = 0;
  std::uint32_t wanted = 0;  ///< runs 0 to wanted - 1
  std::size_t succeeded = 0;
  std::vector<FailedRun> failed;
  std::vector<std::uint32_t> missing;
  std::vector<FigureSummary> figures;
  std::vector<OutageSummary> outages;
  std::vector<InstantSummary> instants;
  std::optional<Estimate> nees;       ///< mean over the runs of each run's mean over its instants; 9 is expected
  std::size_t nees_instants_out = 0;  ///< instants whose mean lies outside its band
  std::vector<LineSummary> acceptance;

  bool complete() const { return failed.empty() && missing.empty(); }
};

/// `results` in order of their runs; those that are not there are missing.
Summary summary_of(const std::string& name, const std::string& fingerprint, std::uint64_t first_seed,
                   std::uint32_t wanted, const std::vector<RunResult>& results);

}  // namespace inslab::montecarlo
