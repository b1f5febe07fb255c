#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace inslab::test {

/// Overlapped Allan variance at m * dt of a rate given by its integral `angle` (one value more than samples):
/// mean of (angle[k+2m] - 2 angle[k+m] + angle[k])^2 over 2 (m dt)^2. IEEE Std 952, annex C.
inline double allan_variance(const std::vector<double>& angle, std::size_t m, double dt_s) {
  const std::size_t terms = angle.size() - 2 * m;
  double sum = 0.0;
  for (std::size_t k = 0; k < terms; ++k) {
    const double d = angle[k + 2 * m] - 2.0 * angle[k + m] + angle[k];
    sum += d * d;
  }
  const double tau_s = static_cast<double>(m) * dt_s;
  return sum / (2.0 * tau_s * tau_s * static_cast<double>(terms));
}

/// The expected Allan variance, over sigma^2, of a Gauss-Markov rate held over each sample (not the continuous one,
/// which is 1.5 times off at m = 1): with p = exp(-dt/T),
/// [m - 3p - m p^2 + 4 p^(m+1) - p^(2m+1)] / (m^2 (1-p)^2).
inline double gauss_markov_allan_variance(std::size_t m, double dt_s, double correlation_time_s) {
  const double p = std::exp(-dt_s / correlation_time_s);
  const auto n = static_cast<double>(m);
  return (n - 3.0 * p - n * p * p + 4.0 * std::pow(p, n + 1.0) - std::pow(p, 2.0 * n + 1.0)) /
         (n * n * (1.0 - p) * (1.0 - p));
}

}  // namespace inslab::test
