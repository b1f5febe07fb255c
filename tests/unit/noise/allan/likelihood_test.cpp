#include "inslab/noise/allan/likelihood.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "tests/unit/noise/allan/simulated_noise.hpp"

namespace inslab::allan {
namespace likelihood_test {

/// Logarithm of the Gaussian density of the differences of neighbouring clusters, from their whole covariance matrix:
/// what a likelihood restricted to contrasts is, but for a constant that no model changes.
double from_the_covariance(const std::vector<double>& means, const NoiseModel& model, double dt_s,
                           std::int64_t samples) {
  const auto count = static_cast<Eigen::Index>(means.size()) - 1;
  const double tau_s = static_cast<double>(samples) * dt_s;
  Eigen::MatrixXd covariance(count, count);
  Eigen::VectorXd differences(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    differences[i] = means[i + 1] - means[i];
    for (Eigen::Index j = 0; j < count; ++j) {
      covariance(i, j) = second_difference_covariance(model, dt_s, samples, (i - j) * samples) / (tau_s * tau_s);
    }
  }
  const Eigen::LDLT<Eigen::MatrixXd> factors(covariance);
  return -0.5 * (factors.vectorD().array().log().sum() + differences.dot(factors.solve(differences)));
}

/// Differences from `reference` of the logarithm, ours and that of the whole matrix.
void expect_same_differences(const std::vector<NoiseModel>& models, std::size_t samples, std::size_t max_clusters) {
  const double dt_s = 0.5;
  Record record(dt_s, max_clusters);
  for (const double increment : test::simulated_increments({1.0, 0.2, 0.0, 0.1, 0.5, 9.0}, dt_s, 1, samples)) {
    record.add(increment);
  }
  const Likelihood likelihood(record, 1e9);  // no details: the means alone
  const auto exact = [&](const NoiseModel& model) {
    return from_the_covariance(record.cluster_means(), model, dt_s, record.samples_per_cluster());
  };
  const double ours = likelihood.log(models.front());
  const double whole = exact(models.front());
  for (const NoiseModel& model : models) {
    // The gain is frozen where it changes by 1e-9 of itself; 100 clusters of logarithms then agree to 1e-6.
    EXPECT_NEAR(likelihood.log(model) - ours, exact(model) - whole, 1e-6);
  }
}

const std::vector<NoiseModel> kModels{{1.0, 0.0, 0.0, 0.0, 0.0, 0.0},  {2.0, 0.3, 0.0, 0.0, 0.0, 0.0},
                                      {1.0, 0.0, 0.0, 0.3, 0.0, 0.0},  {0.0, 0.0, 0.0, 0.5, 0.0, 0.0},
                                      {0.0, 0.0, 0.0, 0.0, 1.0, 20.0}, {0.7, 0.1, 0.0, 0.2, 0.6, 5.0},
                                      {0.5, 0.0, 0.4, 0.0, 0.0, 0.0}};

TEST(Likelihood, IsThatOfTheWholeCovarianceMatrixSampleBySample) { expect_same_differences(kModels, 60, 128); }

TEST(Likelihood, IsThatOfTheWholeCovarianceMatrixInClusters) { expect_same_differences(kModels, 480, 64); }

TEST(Likelihood, DetailsSayOfWhiteNoiseWhatTheSamplesWouldHaveSaid) {
  // An orthogonal split of white noise loses nothing: clusters and details together are as likely as all samples.
  const double dt_s = 0.5;
  Record split(dt_s, 16), whole(dt_s, 4096);
  for (const double increment : test::simulated_increments({1.0, 0.0, 0.0, 0.0, 0.0, 0.0}, dt_s, 2, 1024)) {
    split.add(increment);
    whole.add(increment);
  }
  const NoiseModel a{1.0, 0.0, 0.0, 0.0, 0.0, 0.0}, b{1.3, 0.0, 0.0, 0.0, 0.0, 0.0};
  EXPECT_NEAR(Likelihood(split).log(a) - Likelihood(split).log(b), Likelihood(whole).log(a) - Likelihood(whole).log(b),
              1e-9);
}

TEST(Likelihood, AConstantBiasChangesNothing) {
  const NoiseModel model{1.0, 0.0, 0.0, 0.1, 0.5, 9.0};
  Record plain(1.0), biased(1.0);
  for (const double increment : test::simulated_increments(model, 1.0, 3, 500)) {
    plain.add(increment);
    biased.add(increment + 64.0);
  }
  EXPECT_NEAR(Likelihood(plain).log(model), Likelihood(biased).log(model), 1e-9);
}

}  // namespace likelihood_test
}  // namespace inslab::allan
