#pragma once

#include "inslab/noise/allan/allan_stream.hpp"
#include "inslab/noise/allan/noise_model.hpp"

namespace inslab::allan {

struct Interval {
  double low = 0.0;
  double high = 0.0;

  bool contains(double value) const { return low <= value && value <= high; }
};

/// Equivalent degrees of freedom of a point whose record is Gaussian noise of `model` (of its shape: its scale does not
/// matter). The estimate is the mean of the squares of M second differences whose correlation at a lag of i strides is
/// rho_i, so
///
///   edf = 2 E^2/Var = M / (1 + 2 sum_{i=1}^{M-1} (1 - i/M) rho_i^2),
///
/// exactly, with rho from second_difference_covariance(); where clusters overlap more than 64fold the sum takes every
/// 64th part of a cluster, which moves it by less than 0.1 % (a test holds that). The sum ends at 64 m, beyond which
/// rho^2 is below 1e-6 for all terms. Source: Greenhall and Riley, "Uncertainty of stability variances based on finite
/// differences", PTTI 2003.
double equivalent_degrees_of_freedom(const AllanPoint& point, const NoiseModel& model, double dt_s);

/// The probability that a chi-square variable of `degrees` stays below `value`.
double chi_square_probability(double value, double degrees);

/// The normal variable that is about as seldom as a chi-square variable of `degrees` at `ratio` times its mean (Wilson
/// and Hilferty, PNAS 17, 1931: within 0.1 from 3 degrees on).
double as_normal(double ratio, double degrees);

/// The value that a chi-square variable of `degrees` (any positive number) stays below with `probability` in (0, 1).
double chi_square_quantile(double probability, double degrees);

/// Interval of the true Allan variance at that confidence: edf * estimate over the quantiles of chi-square.
Interval variance_interval(double variance, double degrees, double confidence);

}  // namespace inslab::allan
