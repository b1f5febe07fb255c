#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "inslab/noise/allan/confidence.hpp"

/// Many seeded runs of one scenario: one run, the folder of their results, what they say together.
namespace inslab::montecarlo {

/// A figure found from runs that are independent of each other, and the interval that holds its true value with
/// kConfidence. A bound that so few runs cannot give is absent.
struct Estimate {
  double value = 0.0;
  std::optional<double> low;
  std::optional<double> high;
};

inline constexpr double kConfidence = 0.95;

/// The mean, m ± t s / sqrt(n): t is the quantile of Student's distribution of n - 1 degrees of freedom, s the standard
/// deviation of the values. Source: Student, "The probable error of a mean", Biometrika 6 (1908). At least one value; a
/// single one has no interval.
Estimate mean_of(const std::vector<double>& values);

/// The root mean square. The mean M of n squares of variance v has as much spread as a chi-square variable of
/// nu = 2 n M^2 / v degrees (n of them for normal values about 0), so the interval is
/// sqrt(nu M / chi2(0.975, nu)) to sqrt(nu M / chi2(0.025, nu)). Source: Satterthwaite, "An approximate distribution of
/// estimates of variance components", Biometrics Bulletin 2 (1946). At least one value; a single one has no interval.
Estimate rms_of(const std::vector<double>& values);

/// The value that the share `q` in (0, 1) of all does not exceed: the one of rank ceil(q n). The number of values below
/// the true quantile is binomial, so it lies between the values of rank l and u, where l is the largest with
/// P(B < l) <= 0.025 and u the smallest with P(B >= u) <= 0.025; nothing is assumed of the distribution. Source: David
/// and Nagaraja, Order Statistics, 3rd ed. (2003), 7.1. At least one value.
Estimate quantile_of(std::vector<double> values, double q);

/// The share of successes. Source: Clopper and Pearson, "The use of confidence or fiducial limits illustrated in the
/// case of the binomial", Biometrika 26 (1934). At least one trial.
Estimate share_of(std::size_t successes, std::size_t trials);

/// Where the mean over `runs` independent chi-square variables of `degrees` each lies with kConfidence:
/// chi2(0.025, n runs) / runs to chi2(0.975, n runs) / runs. Source: Bar-Shalom, Li, Kirubarajan, Estimation with
/// Applications to Tracking and Navigation (2001), eq. 5.4.2-6 and following.
allan::Interval chi_square_mean_band(double degrees, std::size_t runs);

}  // namespace inslab::montecarlo
