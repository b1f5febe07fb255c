#include "inslab/noise/allan/confidence.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace inslab::allan {
namespace {

/// Lower regularized incomplete gamma function P(a, x): the series below a + 1, Lentz's continued fraction above.
/// Source: Abramowitz and Stegun, 6.5.29 and 6.5.31.
double gamma_probability(double a, double x) {
  if (x <= 0.0) return 0.0;
  const double scale = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1.0) {
    double term = 1.0 / a;
    double sum = term;
    for (double n = a + 1.0; term > sum * 1e-17; n += 1.0) {
      term *= x / n;
      sum += term;
    }
    return sum * scale;
  }
  constexpr double kTiny = 1e-300;
  double b = x + 1.0 - a;
  double c = 1.0 / kTiny;
  double d = 1.0 / b;
  double fraction = d;
  for (int i = 1; i < 100000; ++i) {
    const double an = -i * (i - a);
    b += 2.0;
    d = an * d + b;
    d = 1.0 / (std::abs(d) < kTiny ? kTiny : d);
    c = b + an / c;
    if (std::abs(c) < kTiny) c = kTiny;
    fraction *= d * c;
    if (std::abs(d * c - 1.0) < 1e-16) break;
  }
  return 1.0 - scale * fraction;
}

/// The number that a standard normal variable stays below with `probability`, by bisection of erfc.
double normal_quantile(double probability) {
  double low = -40.0;
  double high = 40.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Above so many degrees Wilson and Hilferty's cube is good to 1e-6 and the series of the gamma function is long.
constexpr double kManyDegrees = 2000.0;

}  // namespace

double equivalent_degrees_of_freedom(const AllanPoint& point, const NoiseModel& model, double dt_s) {
  const double variance = second_difference_covariance(model, dt_s, point.m, 0);
  const auto terms = static_cast<double>(point.terms);
  const std::int64_t lags = std::min(point.terms - 1, 64 * point.m / point.stride);
  const auto weighted_square = [&](const NoiseModel& of, std::int64_t i) {
    const double rho = second_difference_covariance(of, dt_s, point.m, i * point.stride) / variance;
    return (1.0 - static_cast<double>(i) / terms) * rho * rho;
  };
  // Of a full overlap there are as many lags as samples. All but quantization is smooth over a cluster's 64th part, so
  // the sum goes in such steps by the trapezoidal rule; quantization has lags 0, m and 2m alone.
  const std::int64_t step = std::max<std::int64_t>(point.m / point.stride / 64, 1);
  double correlated = 0.0;
  if (step == 1) {
    for (std::int64_t i = 1; i <= lags; ++i) correlated += weighted_square(model, i);
    return terms / (1.0 + 2.0 * correlated);
  }
  NoiseModel smooth = model;
  smooth.quantization = 0.0;
  double last = 0.0;
  for (std::int64_t i = step; i <= lags; i += step) {
    last = weighted_square(smooth, i);
    correlated += static_cast<double>(step) * last;
  }
  correlated += 0.5 * static_cast<double>(step - 1) * (weighted_square(smooth, 0) - last);
  if (model.quantization > 0.0 && point.m % point.stride == 0) {
    for (std::int64_t i = point.m / point.stride; i <= 2 * point.m / point.stride && i <= lags;
         i += point.m / point.stride) {
      correlated += weighted_square(model, i) - weighted_square(smooth, i);
    }
  }
  return terms / (1.0 + 2.0 * correlated);
}

double chi_square_probability(double value, double degrees) { return gamma_probability(0.5 * degrees, 0.5 * value); }

double as_normal(double ratio, double degrees) {
  const double k = 2.0 / (9.0 * degrees);
  return (std::cbrt(ratio) - (1.0 - k)) / std::sqrt(k);
}

double chi_square_quantile(double probability, double degrees) {
  if (!(probability > 0.0 && probability < 1.0 && degrees > 0.0)) {
    throw std::invalid_argument("chi-square: a probability in (0, 1) and positive degrees of freedom are needed");
  }
  if (degrees > kManyDegrees) {
    const double k = 2.0 / (9.0 * degrees);
    return degrees * std::pow(1.0 - k + normal_quantile(probability) * std::sqrt(k), 3);
  }
  const double shape = 0.5 * degrees;
  double low = 0.0;
  double high = degrees + 10.0;
  while (gamma_probability(shape, 0.5 * high) < probability) high *= 2.0;
  for (int i = 0; i < 200 && high - low > 1e-13 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (gamma_probability(shape, 0.5 * middle) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Interval variance_interval(double variance, double degrees, double confidence) {
  const double tail = 0.5 * (1.0 - confidence);
  return {variance * degrees / chi_square_quantile(1.0 - tail, degrees),
          variance * degrees / chi_square_quantile(tail, degrees)};
}

}  // namespace inslab::allan
