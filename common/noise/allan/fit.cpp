#include "inslab/noise/allan/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "inslab/noise/allan/minimize.hpp"
#include "inslab/noise/allan/search_variables.hpp"

namespace inslab::allan {
namespace {

constexpr double kTolerance = 1e-4;  ///< of a logarithm of likelihood: 1/30000 of what a 99 % interval allows
/// The best model when variable `held` of `variables` keeps its value in `x`.
std::pair<NoiseModel, double> best_with_held(const LogLikelihood& log_likelihood, const SearchVariables& variables,
                                             const std::vector<double>& x, std::size_t held) {
  std::vector<double> rest = x;
  rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(held));
  const auto whole = [&](std::vector<double> others) {
    others.insert(others.begin() + static_cast<std::ptrdiff_t>(held), x[held]);
    return others;
  };
  const auto [place, value] =
      minimize([&](const std::vector<double>& others) { return -log_likelihood(variables.model(whole(others))); }, rest,
               0.05, kTolerance);
  return {variables.model(whole(place)), -value};
}

SearchVariables variables_for(const Fit& fit, Parameter parameter) {
  return {fit.terms, parameter == Parameter::GmSigma ? GmVariable::Sigma : GmVariable::CorrelationTime};
}

/// The largest value of the term's one parameter with which its Allan variance alone stays below the curve.
template <class Unit>
double below_curve(const Likelihood& record, Unit unit) {
  double least = std::numeric_limits<double>::infinity();
  for (const AllanPoint& point : record.rough_curve()) {
    least = std::min(least, point.variance / allan_variance(unit, record.dt_s(), point.m));
  }
  return std::sqrt(least);
}

NoiseModel unit_model(Term term, double correlation_time_s) {
  NoiseModel unit;
  if (term == Term::White) unit.white = 1.0;
  if (term == Term::Quantization) unit.quantization = 1.0;
  if (term == Term::Flicker) unit.flicker = 1.0;
  if (term == Term::RandomWalk) unit.random_walk = 1.0;
  if (term == Term::GaussMarkov) unit.gm_sigma = 1.0;
  unit.gm_correlation_time_s = correlation_time_s;
  return unit;
}

void set_below_curve(const Likelihood& record, Term term, double correlation_time_s, NoiseModel& model) {
  const double value = below_curve(record, unit_model(term, correlation_time_s)) * std::sqrt(0.5);
  switch (term) {
    case Term::White:
      model.white = value;
      break;
    case Term::Quantization:
      model.quantization = value;
      break;
    case Term::Flicker:
      model.flicker = value;
      break;
    case Term::RandomWalk:
      model.random_walk = value;
      break;
    case Term::GaussMarkov:
      model.gm_sigma = value;
      model.gm_correlation_time_s = correlation_time_s;
      break;
  }
}

/// `model` with a Gauss-Markov term put in at that of several correlation times over the record's which suits best.
NoiseModel with_gauss_markov(const Likelihood& record, const NoiseModel& model) {
  NoiseModel best;
  double best_log = -std::numeric_limits<double>::infinity();
  for (double time_s = 4.0 * record.dt_s(); time_s < record.span_s(); time_s *= 3.0) {
    NoiseModel candidate = model;
    set_below_curve(record, Term::GaussMarkov, time_s, candidate);
    const double log = record.log(candidate);
    if (log > best_log) {
      best_log = log;
      best = candidate;
    }
  }
  return best;
}

NoiseModel with_term(const Likelihood& record, NoiseModel model, Term term) {
  if (term == Term::GaussMarkov) return with_gauss_markov(record, model);
  set_below_curve(record, term, 0.0, model);
  return model;
}

}  // namespace

std::vector<Parameter> parameters_of(Term term) {
  switch (term) {
    case Term::White:
      return {Parameter::White};
    case Term::Quantization:
      return {Parameter::Quantization};
    case Term::Flicker:
      return {Parameter::Flicker};
    case Term::RandomWalk:
      return {Parameter::RandomWalk};
    case Term::GaussMarkov:
      return {Parameter::GmSigma, Parameter::GmCorrelationTime};
  }
  return {};
}

double value_of(const NoiseModel& model, Parameter parameter) {
  switch (parameter) {
    case Parameter::White:
      return model.white;
    case Parameter::Quantization:
      return model.quantization;
    case Parameter::Flicker:
      return model.flicker;
    case Parameter::RandomWalk:
      return model.random_walk;
    case Parameter::GmSigma:
      return model.gm_sigma;
    case Parameter::GmCorrelationTime:
      return model.gm_correlation_time_s;
  }
  return 0.0;
}

NoiseModel first_guess(const Likelihood& record, const std::vector<Term>& terms) {
  NoiseModel model;
  bool with_gm = false;
  for (const Term term : terms) {
    with_gm = with_gm || term == Term::GaussMarkov;
    if (term != Term::GaussMarkov) model = with_term(record, model, term);
  }
  return with_gm ? with_gauss_markov(record, model) : model;
}

Fit maximize(const LogLikelihood& log_likelihood, const std::vector<Term>& terms, const NoiseModel& guess) {
  const SearchVariables variables(terms, GmVariable::CorrelationTime);
  const auto cost = [&](const std::vector<double>& x) { return -log_likelihood(variables.model(x)); };
  // A simplex may end on a slope; one that begins anew from there does not end on the same.
  const auto rough = minimize(cost, variables.of(guess), 0.5, 0.1);
  const auto [place, value] = minimize(cost, rough.first, 0.05, kTolerance);
  return {terms, variables.model(place), -value};
}

Fit fit(const Likelihood& record, const std::vector<Term>& terms) {
  return maximize([&](const NoiseModel& model) { return record.log(model); }, terms, first_guess(record, terms));
}

Fit select(const Likelihood& record) {
  constexpr Term kAll[] = {Term::White, Term::Quantization, Term::Flicker, Term::RandomWalk, Term::GaussMarkov};
  const auto log_likelihood = [&](const NoiseModel& model) { return record.log(model); };
  const auto score = [&](const Fit& fit) {
    std::size_t parameters = 0;
    for (const Term term : fit.terms) parameters += parameters_of(term).size();
    return fit.log_likelihood -
           0.5 * std::log(static_cast<double>(record.clusters())) * static_cast<double>(parameters);
  };
  Fit best = fit(record, {Term::White});
  const auto try_terms = [&](const std::vector<Term>& terms, const NoiseModel& guess) {
    const Fit candidate = maximize(log_likelihood, terms, guess);
    // A correlation time that the record is too short to see is a random walk's, which is a term of its own.
    if (candidate.model.gm_correlation_time_s > 10.0 * record.span_s()) return false;
    // Of values near the end of the numbers the likelihood is none, and no choice is better than another.
    if (!(score(candidate) > score(best))) return false;
    best = candidate;
    return true;
  };
  for (bool better = true; better;) {
    better = false;
    const Fit basis = best;  // NOLINT(performance-unnecessary-copy-initialization): try_terms changes best
    for (const Term term : kAll) {
      if (std::find(basis.terms.begin(), basis.terms.end(), term) != basis.terms.end()) continue;
      std::vector<Term> terms = basis.terms;
      terms.push_back(term);
      better = try_terms(terms, with_term(record, basis.model, term)) || better;
    }
    for (bool leaner = better; leaner;) {
      leaner = false;
      const Fit whole = best;  // NOLINT(performance-unnecessary-copy-initialization): as above
      for (std::size_t i = 0; i + 1 < whole.terms.size(); ++i) {  // not the one that was just added
        std::vector<Term> terms = whole.terms;
        terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(i));
        leaner = try_terms(terms, whole.model) || leaner;
      }
    }
  }
  return best;
}

double drop_at(const LogLikelihood& log_likelihood, const Fit& fit, Parameter parameter, double value) {
  const SearchVariables variables = variables_for(fit, parameter);
  std::vector<double> x = variables.of(fit.model);
  const std::size_t held = variables.index(parameter);
  x[held] = std::log(value);
  return std::max(fit.log_likelihood - best_with_held(log_likelihood, variables, x, held).second, 0.0);
}

Interval likelihood_interval(const LogLikelihood& log_likelihood, const Fit& fit, Parameter parameter,
                             double confidence) {
  const SearchVariables variables = variables_for(fit, parameter);
  const std::vector<double> best = variables.of(fit.model);
  const std::size_t held = variables.index(parameter);
  const double limit = 0.5 * chi_square_quantile(confidence, 1.0);
  constexpr double kUnbounded = 7.0;  // a factor of 1000
  const auto end = [&](double direction) {
    std::vector<double> x = best;
    // sqrt(drop) is nearly linear in the distance: a secant through 0 and the last look, kept inside what is known.
    double inside = 0.0, outside = std::numeric_limits<double>::infinity(), distance = 0.02;
    for (int look = 0; look < 40; ++look) {
      x[held] = best[held] + direction * distance;
      const auto [model, log] = best_with_held(log_likelihood, variables, x, held);
      const double drop = std::max(fit.log_likelihood - log, 1e-12);
      (drop < limit ? inside : outside) = distance;
      if (std::abs(drop / limit - 1.0) < 0.01) break;
      if (inside > kUnbounded) return direction * std::numeric_limits<double>::infinity();
      if (drop < limit) x = variables.of(model);  // the others' values are a good start for the next look
      double next = distance * std::clamp(std::sqrt(limit / drop), 0.1, 4.0);
      if (!(next < outside && next > inside)) {
        next = std::isfinite(outside) ? 0.5 * (inside + outside) : 2.0 * inside;
      }
      distance = next;
    }
    return best[held] + direction * distance;
  };
  return {std::exp(end(-1.0)), std::exp(end(1.0))};
}

}  // namespace inslab::allan
