#include "inslab/noise/allan/pooled_fit.hpp"

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

#include "inslab/noise/allan/search_variables.hpp"

namespace inslab::allan {
namespace {

using Function = std::function<double(const std::vector<double>&)>;

std::vector<double> moved(std::vector<double> x, std::size_t i, double by) {
  x[i] += by;
  return x;
}

/// For each variable the distance at which `f` has fallen by about 1 from its maximum at `x`.
std::vector<double> unit_steps(const Function& f, const std::vector<double>& x) {
  const double top = f(x);
  std::vector<double> steps(x.size(), 1e-3);
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (int look = 0; look < 3; ++look) {
      const double drop = top - 0.5 * (f(moved(x, i, steps[i])) + f(moved(x, i, -steps[i])));
      steps[i] = std::min(steps[i] / std::sqrt(std::max(drop, 1e-8)), 0.3);
    }
  }
  return steps;
}

Eigen::VectorXd slope(const Function& f, const std::vector<double>& x, const std::vector<double>& steps) {
  Eigen::VectorXd g(static_cast<Eigen::Index>(x.size()));
  for (std::size_t i = 0; i < x.size(); ++i) {
    g[static_cast<Eigen::Index>(i)] = (f(moved(x, i, steps[i])) - f(moved(x, i, -steps[i]))) / (2.0 * steps[i]);
  }
  return g;
}

Eigen::MatrixXd curvature(const Function& f, const std::vector<double>& x, const std::vector<double>& steps) {
  const auto n = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixXd H(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto a = static_cast<std::size_t>(i);
    const Eigen::VectorXd ahead = slope(f, moved(x, a, steps[a]), steps);
    const Eigen::VectorXd behind = slope(f, moved(x, a, -steps[a]), steps);
    H.col(i) = (ahead - behind) / (2.0 * steps[a]);
  }
  return 0.5 * (H + H.transpose());
}

/// How the logarithm of `parameter` follows from the variables of the search.
Eigen::VectorXd direction(const SearchVariables& variables, const std::vector<double>& x, Parameter parameter) {
  constexpr double kStep = 1e-4;
  return slope([&](const std::vector<double>& at) { return std::log(value_of(variables.model(at), parameter)); }, x,
               std::vector<double>(x.size(), kStep));
}

}  // namespace

std::vector<PooledEstimate> pooled_fit(const std::vector<Likelihood>& records, const std::vector<Term>& terms) {
  if (records.size() < 2) throw std::invalid_argument("pooled fit: fewer than two records");
  const LogLikelihood together = [&](const NoiseModel& model) {
    double sum = 0.0;
    for (const Likelihood& record : records) sum += record.log(model);
    return sum;
  };
  const Fit fit = maximize(together, terms, first_guess(records.front(), terms));
  const SearchVariables variables(terms, GmVariable::CorrelationTime);
  const std::vector<double> x = variables.of(fit.model);
  const Function f = [&](const std::vector<double>& at) { return together(variables.model(at)); };
  const std::vector<double> steps = unit_steps(f, x);

  const auto count = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(count, count);
  for (const Likelihood& record : records) {
    const Eigen::VectorXd g =
        slope([&](const std::vector<double>& at) { return record.log(variables.model(at)); }, x, steps);
    spread += g * g.transpose();
  }
  const auto n = static_cast<double>(records.size());
  const Eigen::MatrixXd inverse = curvature(f, x, steps).inverse();
  const Eigen::MatrixXd covariance = inverse * spread * inverse * (n / (n - 1.0));

  std::vector<PooledEstimate> estimates;
  for (const Term term : terms) {
    for (const Parameter parameter : parameters_of(term)) {
      const Eigen::VectorXd along = direction(variables, x, parameter);
      estimates.push_back({parameter, value_of(fit.model, parameter), std::sqrt(along.dot(covariance * along))});
    }
  }
  return estimates;
}

}  // namespace inslab::allan
