#pragma once

#include <cstdint>

#include "inslab/noise/random/flicker.hpp"

namespace inslab::allan {

/// The random errors of one sensor axis, in the unit u of its rate (rad/s, m/s^2); a term that is 0 is absent. Every
/// bias is held over a sample, as the IMU model holds it.
struct NoiseModel {
  double white = 0.0;                  ///< N, u sqrt(s): angle or velocity random walk
  double quantization = 0.0;           ///< Q, u s: standard deviation of the white error of the integral
  double flicker = 0.0;                ///< B, u: bias instability; the sum of terms of noise/random/flicker.hpp
  double random_walk = 0.0;            ///< K, u/sqrt(s): rate random walk
  double gm_sigma = 0.0;               ///< u: steady-state standard deviation of a first-order Gauss-Markov bias
  double gm_correlation_time_s = 0.0;  ///< above 0 where gm_sigma is
};

/// Visits the processes that the IMU model makes of the model's flicker; none without.
template <class Visit>
void for_each_flicker_process(const NoiseModel& model, double dt_s, const Visit& visit) {
  const int terms = model.flicker > 0.0 ? random::Flicker::terms(dt_s) : 0;
  for (int term = 0; term < terms; ++term) {
    const random::Flicker::Process process = random::Flicker::process(term, dt_s);
    visit(random::Flicker::Process{process.sigma * model.flicker, process.correlation_time_s});
  }
}

/// The expected Allan variance of `model` sampled every `dt_s` at tau = m dt, u^2:
///
///   white N^2/tau; quantization 3 Q^2/tau^2;
///   flicker (0.6643 B)^2, 0.6643^2 = 2 ln 2/pi, as far as the Gauss-Markov processes that stand for it reach: within
///   1 % of 0.6643 B from one sample to 5000 s (a fit to them is a fit to what a profile gives back);
///   random walk K^2 tau/3 (1 + 1/(2 m^2)), and Gauss-Markov, p = exp(-dt/T),
///   sigma^2 [m - 3p - m p^2 + 4 p^(m+1) - p^(2m+1)] / (m^2 (1-p)^2), both for a bias held over each sample.
///
/// The printed Gauss-Markov form cancels to nothing when m dt/T is small (1 - p at m = 1 comes out of terms of order
/// 1), so it is computed as p [G(m a) + 2 m (sinh a - a)] / (m^2 (1-p)^2) with a = dt/T and
/// G(x) = 2x - 3 + 4 exp(-x) - exp(-2x), which is the same. Sources: IEEE Std 952-1997, annex C; thesis table 4-3, with
/// its flicker coefficient corrected.
double allan_variance(const NoiseModel& model, double dt_s, std::int64_t m);

/// Generalized covariance of the integrated output at a lag of `n` samples, u^2 s^2: whatever combination of values of
/// the integral has coefficients whose sum is 0 and whose first moment is 0 has the variance sum_ij c_i c_j K(i - j).
/// Second differences are such. (Matheron's intrinsic random functions of order 1.)
double generalized_covariance(const NoiseModel& model, double dt_s, std::int64_t n);

/// Covariance of the second differences z_m(k) = x(k + 2m) - 2 x(k + m) + x(k) at k and at k + lag, u^2 s^2.
double second_difference_covariance(const NoiseModel& model, double dt_s, std::int64_t m, std::int64_t lag);

}  // namespace inslab::allan
