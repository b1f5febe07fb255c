#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "inslab/noise/allan/confidence.hpp"
#include "inslab/noise/allan/likelihood.hpp"

namespace inslab::allan {

enum class Term { White, Quantization, Flicker, RandomWalk, GaussMarkov };
enum class Parameter { White, Quantization, Flicker, RandomWalk, GmSigma, GmCorrelationTime };

/// The parameters of a term, in the order above.
std::vector<Parameter> parameters_of(Term term);
double value_of(const NoiseModel& model, Parameter parameter);

/// A logarithm of likelihood to be maximized, of one record or summed over several.
using LogLikelihood = std::function<double(const NoiseModel&)>;

struct Fit {
  std::vector<Term> terms;
  NoiseModel model;
  double log_likelihood = 0.0;
};

/// A model with these terms that is not far from the Allan curve of the record; where a maximization begins.
NoiseModel first_guess(const Likelihood& record, const std::vector<Term>& terms);

/// The model with these terms that is most likely, searched for from `guess`. The search moves in logarithms, for a
/// Gauss-Markov term in those of T and of its drive 2 sigma^2/T, since a record says much more of the drive than of
/// sigma and T alone.
Fit maximize(const LogLikelihood& log_likelihood, const std::vector<Term>& terms, const NoiseModel& guess);
Fit fit(const Likelihood& record, const std::vector<Term>& terms);

/// The terms that a record speaks for: beginning with white noise, adds the one that raises the likelihood most, then
/// takes away those that others have made superfluous, as long as twice the rise of its logarithm exceeds, and its fall
/// stays below, ln(clusters) for each parameter (Schwarz, Annals of Statistics 6, 1978).
Fit select(const Likelihood& record);

/// By how much the logarithm of the likelihood falls from its maximum when `parameter` is held at `value` and all
/// others are fitted anew; at least 0.
double drop_at(const LogLikelihood& log_likelihood, const Fit& fit, Parameter parameter, double value);

/// The values of `parameter` that the record does not speak against at that confidence: drop_at() at most half the
/// quantile of chi-square with one degree of freedom (Wilks). An end that the record does not bound is 0 or infinite.
Interval likelihood_interval(const LogLikelihood& log_likelihood, const Fit& fit, Parameter parameter,
                             double confidence);

}  // namespace inslab::allan
