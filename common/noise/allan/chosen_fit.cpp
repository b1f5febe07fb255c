#include "inslab/noise/allan/chosen_fit.hpp"

#include <algorithm>
#include <cmath>

namespace inslab::allan {
namespace {

constexpr double kFewSamples = 4.0;
constexpr double kWhiteFrom = 64.0;  ///< correlation times
constexpr double kClustersOfAPoint = 64.0;

bool is_fast(const Fit& fit, double dt_s) {
  return fit.model.gm_sigma > 0.0 && fit.model.gm_correlation_time_s < kFewSamples * dt_s;
}

/// The same density far above the correlation time: that of a process held over each sample.
void make_white(Fit& fit, double dt_s) {
  const double decay = std::exp(-dt_s / fit.model.gm_correlation_time_s);
  const double density2 = fit.model.gm_sigma * fit.model.gm_sigma * dt_s * (1.0 + decay) / (1.0 - decay);
  fit.model.white = std::sqrt(fit.model.white * fit.model.white + density2);
  fit.model.gm_sigma = fit.model.gm_correlation_time_s = 0.0;
  fit.terms.erase(std::remove(fit.terms.begin(), fit.terms.end(), Term::GaussMarkov), fit.terms.end());
  if (std::find(fit.terms.begin(), fit.terms.end(), Term::White) == fit.terms.end()) {
    fit.terms.push_back(Term::White);
  }
}

}  // namespace

ChosenFit choose_fit(const Record& record, double finest_tau_s) {
  Likelihood likelihood(record, finest_tau_s, Likelihood::Means::Joined);
  Fit fit = select(likelihood);
  ChosenFit chosen{std::move(likelihood), std::move(fit), finest_tau_s, 0.0};
  if (!is_fast(chosen.fit, record.dt_s())) return chosen;
  chosen.fast_process_s = chosen.fit.model.gm_correlation_time_s;
  const double white_from_s = std::max(kWhiteFrom * chosen.fast_process_s, record.dt_s());
  if (white_from_s > finest_tau_s && white_from_s * kClustersOfAPoint < record.span_s()) {
    chosen.finest_tau_s = white_from_s;
    chosen.likelihood = Likelihood(record, white_from_s, Likelihood::Means::Joined);
    chosen.fit = select(chosen.likelihood);
  }
  if (is_fast(chosen.fit, record.dt_s())) {
    make_white(chosen.fit, record.dt_s());
    chosen.fit = maximize([&](const NoiseModel& model) { return chosen.likelihood.log(model); }, chosen.fit.terms,
                          chosen.fit.model);
  }
  return chosen;
}

}  // namespace inslab::allan
