#pragma once

#include <string>
#include <vector>

#include "inslab/referee/predict/expected_errors.hpp"
#include "inslab/referee/score/score_log.hpp"

namespace inslab::cli {

/// What is to be expected of the app of a log: predict::ExpectedErrors along the run as it was, with its profiles, its
/// journal and its fixes. docs/error_theory.md says what they take for granted.
struct Expectation {
  std::string of;  ///< "the best filter of the fixes of gnss 0", "free inertial navigation"
  std::vector<predict::PredictedError> curve;
  std::vector<std::string> left_out;  ///< what the profiles ask for and the curve does not have
  std::string missing;                ///< why there is no curve

  /// The last one not after this sim time; null before the first.
  const predict::PredictedError* at(double time_s) const;
  /// The same strictly before it: before the fix that ends an outage.
  const predict::PredictedError* before(double time_s) const;
};

/// What is known where an app begins: the sigmas that it reports with its first scored solution, and where it reports
/// none, the error that it has.
predict::PredictedError beginning_of(const score::ScoredSolution& first);

/// Throws io::ReadError.
Expectation expectation_of(const io::McapReader& log, const LogSummary& summary, const predict::PredictedError& start);

/// Root mean square of the errors in units of the expected sigmas, over solutions and axes: 1 is as good as the
/// sensors and fixes allow.
struct ErrorRatios {
  double position = 0.0;
  double velocity = 0.0;
  double attitude = 0.0;
  std::size_t solutions = 0;
};

}  // namespace inslab::cli
