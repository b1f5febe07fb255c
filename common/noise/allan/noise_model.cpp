#include "inslab/noise/allan/noise_model.hpp"

#include <cmath>
#include <cstdlib>

namespace inslab::allan {
namespace {

using random::Flicker;

/// sum of c(k) x^k/k! from k = 3, for x small enough that twelve terms are all there is to see in a double.
template <class Coefficient>
double series_from_cube(double x, Coefficient coefficient) {
  double power = x * x * x / 6.0;
  double sum = 0.0;
  for (int k = 3; k < 18; ++k) {
    sum += coefficient(k) * power;
    power *= x / (k + 1);
  }
  return sum;
}

double sign_of_power(int k) { return k % 2 == 0 ? 1.0 : -1.0; }

/// sinh(a) - a.
double sinh_less_argument(double a) {
  if (a > 0.5) return std::sinh(a) - a;
  return series_from_cube(a, [](int k) { return k % 2 == 0 ? 0.0 : 1.0; });
}

/// G(x) = 2x - 3 + 4 exp(-x) - exp(-2x).
double second_difference_of_decay(double x) {
  if (x > 0.5) return 2.0 * x - 3.0 + 4.0 * std::exp(-x) - std::exp(-2.0 * x);
  return series_from_cube(x, [](int k) { return sign_of_power(k) * (4.0 - std::ldexp(1.0, k)); });
}

/// x - 1 + exp(-x).
double decay_less_line(double x) {
  if (x > 0.5) return x - 1.0 + std::exp(-x);
  return 0.5 * x * x + series_from_cube(x, sign_of_power);
}

double gauss_markov_variance(double sigma, double correlation_time_s, double dt_s, double m) {
  const double a = dt_s / correlation_time_s;
  const double u = -std::expm1(-a);
  return sigma * sigma * std::exp(-a) * (second_difference_of_decay(m * a) + 2.0 * m * sinh_less_argument(a)) /
         (m * m * u * u);
}

/// Variance of the sum of n successive values, times dt^2: sigma^2 dt^2 [n (1 - p^2) - 2p (1 - p^n)]/(1 - p)^2.
double gauss_markov_integral_variance(double sigma, double correlation_time_s, double dt_s, double n) {
  const double a = dt_s / correlation_time_s;
  const double u = -std::expm1(-a);
  return 2.0 * std::exp(-a) * (decay_less_line(n * a) + n * sinh_less_argument(a)) * std::pow(sigma * dt_s / u, 2);
}

}  // namespace

double allan_variance(const NoiseModel& model, double dt_s, std::int64_t m) {
  const auto n = static_cast<double>(m);
  const double tau_s = n * dt_s;
  double variance = model.white * model.white / tau_s + 3.0 * std::pow(model.quantization / tau_s, 2) +
                    model.random_walk * model.random_walk * tau_s / 3.0 * (1.0 + 0.5 / (n * n));
  if (model.gm_sigma > 0.0) {
    variance += gauss_markov_variance(model.gm_sigma, model.gm_correlation_time_s, dt_s, n);
  }
  for_each_flicker_process(model, dt_s, [&](const Flicker::Process& process) {
    variance += gauss_markov_variance(process.sigma, process.correlation_time_s, dt_s, n);
  });
  return variance;
}

double generalized_covariance(const NoiseModel& model, double dt_s, std::int64_t n) {
  const auto lag = static_cast<double>(std::llabs(n));
  if (n == 0) return model.quantization * model.quantization;
  const double h = lag * dt_s;
  double covariance = -0.5 * model.white * model.white * h +
                      model.random_walk * model.random_walk * std::pow(dt_s, 3) * (lag * lag * lag - lag) / 12.0;
  if (model.gm_sigma > 0.0) {
    covariance -= 0.5 * gauss_markov_integral_variance(model.gm_sigma, model.gm_correlation_time_s, dt_s, lag);
  }
  for_each_flicker_process(model, dt_s, [&](const Flicker::Process& process) {
    covariance -= 0.5 * gauss_markov_integral_variance(process.sigma, process.correlation_time_s, dt_s, lag);
  });
  return covariance;
}

double second_difference_covariance(const NoiseModel& model, double dt_s, std::int64_t m, std::int64_t lag) {
  const auto k = [&](std::int64_t n) { return generalized_covariance(model, dt_s, n); };
  return 6.0 * k(lag) - 4.0 * (k(lag + m) + k(lag - m)) + k(lag + 2 * m) + k(lag - 2 * m);
}

}  // namespace inslab::allan
