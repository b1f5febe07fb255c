#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "inslab/referee/predict/expected_errors.hpp"
#include "inslab/referee/score/score_log.hpp"

namespace inslab::report {

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

/// Follows along a walk what is to be expected, from the first scored solution on.
class ExpectationOfLog {
 public:
  /// `fixes`: of all the log's receivers, or of the app's alone. `summary` is used until the end.
  ExpectationOfLog(const mcap::McapReader& log, const evidence::LogSummary& summary, std::vector<GnssFix> fixes);

  /// `judged_until_ns` says before which sim time no first solution can lie any more.
  void take_part(log::LogWalk& walk, std::function<std::int64_t()> judged_until_ns);

  /// The first is where it begins: with the sigmas that the app reports there, and where it reports none, the error
  /// that it has. Later ones are passed over.
  void add(const score::ScoredSolution& scored);

  /// When the walk is over; once.
  Expectation finish();

 private:
  void add(const ImuTruth& truth);
  void follow(const ImuTruth& truth);

  Expectation expectation_;
  predict::ExpectedErrors::Setup setup_;
  std::vector<catalog::AnyProfile> profiles_;
  std::vector<GnssFix> fixes_;  ///< in order of sim time
  std::size_t next_fix_ = 0;
  bool begun_ = false;
  std::function<std::int64_t()> judged_until_ns_;
  std::deque<ImuTruth> waiting_;  ///< for the first scored solution
  std::optional<predict::ExpectedErrors> errors_;
};

/// The receiver that the app of a scenario is taken to use; nothing when the scenario has none.
std::optional<std::uint32_t> receiver_of_app(const scenario::Scenario& scenario);

/// Root mean square of the errors in units of the expected sigmas, over solutions and axes: 1 is as good as the
/// sensors and fixes allow.
struct ErrorRatios {
  double position = 0.0;
  double velocity = 0.0;
  double attitude = 0.0;
  std::size_t solutions = 0;
};

}  // namespace inslab::report
