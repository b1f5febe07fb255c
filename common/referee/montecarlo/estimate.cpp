#include "inslab/referee/montecarlo/estimate.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace inslab::montecarlo {

namespace {

constexpr double kTail = 0.5 * (1.0 - kConfidence);

struct Moments {
  double mean = 0.0;
  double variance = 0.0;  ///< with n - 1; 0 of a single value
};

Moments moments_of(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  Moments moments;
  for (const double value : values) moments.mean += value / n;
  if (values.size() < 2) return moments;
  for (const double value : values) moments.variance += (value - moments.mean) * (value - moments.mean) / (n - 1.0);
  return moments;
}

}  // namespace

Estimate mean_of(const std::vector<double>& values) {
  const Moments moments = moments_of(values);
  if (values.size() < 2) return {moments.mean, std::nullopt, std::nullopt};
  const auto n = static_cast<double>(values.size());
  const double t = boost::math::quantile(boost::math::students_t(n - 1.0), 1.0 - kTail);
  const double half = t * std::sqrt(moments.variance / n);
  return {moments.mean, moments.mean - half, moments.mean + half};
}

Estimate rms_of(const std::vector<double>& values) {
  std::vector<double> squares = values;
  for (double& square : squares) square *= square;
  const Moments moments = moments_of(squares);
  const double rms = std::sqrt(moments.mean);
  if (values.size() < 2) return {rms, std::nullopt, std::nullopt};
  if (moments.variance == 0.0) return {rms, rms, rms};
  const double degrees = 2.0 * static_cast<double>(values.size()) * moments.mean * moments.mean / moments.variance;
  const allan::Interval square = allan::variance_interval(moments.mean, degrees, kConfidence);
  return {rms, std::sqrt(square.low), std::sqrt(square.high)};
}

Estimate quantile_of(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  const boost::math::binomial below(n, q);
  const auto rank = static_cast<std::size_t>(std::clamp(std::ceil(q * n), 1.0, n));
  Estimate estimate{values[rank - 1], std::nullopt, std::nullopt};
  for (std::size_t l = 1; l <= values.size() && boost::math::cdf(below, static_cast<double>(l - 1)) <= kTail; ++l) {
    estimate.low = values[l - 1];
  }
  for (std::size_t u = values.size();
       u >= 1 && boost::math::cdf(boost::math::complement(below, static_cast<double>(u - 1))) <= kTail; --u) {
    estimate.high = values[u - 1];
  }
  return estimate;
}

Estimate share_of(std::size_t successes, std::size_t trials) {
  using boost::math::binomial;
  const auto k = static_cast<double>(successes);
  const auto n = static_cast<double>(trials);
  return {k / n, binomial::find_lower_bound_on_p(n, k, kTail), binomial::find_upper_bound_on_p(n, k, kTail)};
}

allan::Interval chi_square_mean_band(double degrees, std::size_t runs) {
  const auto n = static_cast<double>(runs);
  return {allan::chi_square_quantile(kTail, degrees * n) / n, allan::chi_square_quantile(1.0 - kTail, degrees * n) / n};
}

}  // namespace inslab::montecarlo
