#pragma once

#include <vector>

#include "inslab/noise/allan/allan_stream.hpp"
#include "inslab/noise/allan/noise_model.hpp"
#include "inslab/noise/allan/record.hpp"

namespace inslab::allan {

/// How likely a record is under a noise model, with an unknown constant bias.
///
/// The sum of two parts, as Record splits the data:
///  - the means of its clusters: the exact Gaussian likelihood, from a Kalman filter of the held processes summed over
///  a
///    cluster, restricted to what does not depend on the bias (Patterson and Thompson, Biometrika 58, 1971). Restricted
///    because a bias that is fitted instead makes correlation times come out short by a third when the record has
///    eleven of them, and because the restricted likelihood ratio keeps the chi-square distribution even then (Chen
///    and Deo, Econometric Theory 25, 2009);
///  - the differences of neighbours at the finer cluster sizes, taken as independent of each other and of the means:
///    exact for white noise, within one size exact for a random walk, and close for what lies between.
class Likelihood {
 public:
  /// `finest_tau_s`: differences at a smaller tau are left out (what a sensor's filter or vibration shapes is not
  /// noise of the model). `Joined`: so are means of clusters shorter than that, joined until they are as long while 16
  /// of them remain. The record is copied as far as needed.
  enum class Means { AsTheyAre, Joined };
  explicit Likelihood(const Record& record, double finest_tau_s = 0.0, Means means = Means::AsTheyAre);

  /// Logarithm of the likelihood, without its constant; minus infinity for a model without any term.
  double log(const NoiseModel& model) const;

  double dt_s() const { return dt_s_; }
  double span_s() const { return span_s_; }
  std::size_t clusters() const { return means_.size(); }
  std::int64_t samples_per_cluster() const { return samples_per_cluster_; }

  /// Allan variance of the record at tau = 2^l dt from pairs of clusters that do not overlap, from the smallest tau in
  /// use: its points are nearly independent.
  std::vector<AllanPoint> rough_curve() const;

 private:
  double log_of_means(const NoiseModel& model) const;
  double log_of_details(const NoiseModel& model) const;

  double dt_s_;
  double span_s_;
  std::int64_t samples_per_cluster_;
  std::vector<double> means_;
  std::vector<Record::Details> details_;
  std::size_t first_level_ = 0;
};

}  // namespace inslab::allan
