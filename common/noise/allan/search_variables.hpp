#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "inslab/noise/allan/fit.hpp"

namespace inslab::allan {

/// Which of sigma and T stands beside the drive as a variable of the search: the one that may be held.
enum class GmVariable { Sigma, CorrelationTime };

/// The variables of a search, logarithms all.
class SearchVariables {
 public:
  SearchVariables(std::vector<Term> terms, GmVariable gm) : terms_(std::move(terms)), gm_(gm) {}

  std::vector<double> of(const NoiseModel& model) const {
    std::vector<double> x;
    for (const Term term : terms_) {
      if (term == Term::GaussMarkov) {
        const double log_sigma = std::log(model.gm_sigma);
        const double log_time = std::log(model.gm_correlation_time_s);
        x.push_back(gm_ == GmVariable::Sigma ? log_sigma : log_time);
        x.push_back(log_sigma - 0.5 * log_time);
      } else {
        x.push_back(std::log(value_of(model, parameters_of(term).front())));
      }
    }
    return x;
  }

  /// Correlation times beyond exp(+-25) s stay there: nothing distinguishes them any more.
  NoiseModel model(const std::vector<double>& x) const {
    NoiseModel model;
    std::size_t i = 0;
    for (const Term term : terms_) {
      const double first = x[i++];
      switch (term) {
        case Term::White:
          model.white = std::exp(first);
          break;
        case Term::Quantization:
          model.quantization = std::exp(first);
          break;
        case Term::Flicker:
          model.flicker = std::exp(first);
          break;
        case Term::RandomWalk:
          model.random_walk = std::exp(first);
          break;
        case Term::GaussMarkov: {
          const double half_log_drive = x[i++];
          const double log_time = gm_ == GmVariable::Sigma ? 2.0 * (first - half_log_drive) : first;
          const double bounded = std::clamp(log_time, -25.0, 25.0);
          model.gm_correlation_time_s = std::exp(bounded);
          model.gm_sigma = gm_ == GmVariable::Sigma ? std::exp(first) : std::exp(half_log_drive + 0.5 * bounded);
          break;
        }
      }
    }
    return model;
  }

  /// Where `parameter` stands; it is a variable.
  std::size_t index(Parameter parameter) const {
    std::size_t i = 0;
    for (const Term term : terms_) {
      const auto parameters = parameters_of(term);
      if (std::find(parameters.begin(), parameters.end(), parameter) != parameters.end()) return i;
      i += parameters.size();
    }
    return i;
  }

 private:
  std::vector<Term> terms_;
  GmVariable gm_;
};

}  // namespace inslab::allan
