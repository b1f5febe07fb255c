#include "inslab/noise/allan/likelihood.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "inslab/noise/random/flicker.hpp"

namespace inslab::allan {
namespace {

/// One process that is held over a sample, looked at through means of D successive values: with x its value where a
/// cluster begins, the mean is gain x + e, and x where the next one begins is decay x + w.
struct ClusterState {
  double decay = 0.0;
  double gain = 0.0;
  double drive_variance = 0.0;  ///< of w
  double mean_variance = 0.0;   ///< of e
  double covariance = 0.0;      ///< of w and e
  double initial_variance = 0.0;
};

ClusterState gauss_markov(double sigma, double correlation_time_s, double dt_s, double samples) {
  const double a = dt_s / correlation_time_s;
  const double variance = sigma * sigma;
  ClusterState state;
  state.decay = std::exp(-samples * a);
  state.gain = std::expm1(-samples * a) / (samples * std::expm1(-a));
  state.drive_variance = -variance * std::expm1(-2.0 * samples * a);
  NoiseModel alone;
  alone.gm_sigma = sigma;
  alone.gm_correlation_time_s = correlation_time_s;
  const double tau_s = samples * dt_s;
  const double variance_of_mean =
      -2.0 * generalized_covariance(alone, dt_s, static_cast<std::int64_t>(samples)) / (tau_s * tau_s);
  state.mean_variance = std::max(variance_of_mean - state.gain * state.gain * variance, 0.0);
  state.covariance = -variance * state.gain * std::exp(-a) * std::expm1(-(samples - 1.0) * a);
  state.initial_variance = variance;
  return state;
}

/// Where it begins is a part of the unknown bias, so any initial variance will do that leaves the first mean uncertain.
ClusterState random_walk(double density, double dt_s, double samples) {
  const double step = density * density * dt_s;
  return {1.0,
          1.0,
          step * samples,
          step * (samples - 1.0) * (2.0 * samples - 1.0) / (6.0 * samples),
          step * (samples - 1.0) / 2.0,
          step * samples};
}

/// The state is the error of the integral where the cluster begins.
ClusterState quantization(double deviation, double tau_s) {
  const double variance = deviation * deviation;
  return {0.0, -1.0 / tau_s, variance, variance / (tau_s * tau_s), variance / tau_s, variance};
}

/// Of a Gauss-Markov bias, a random walk, quantization and flicker.
constexpr std::size_t kMaxStates = 3 + random::Flicker::kMostTerms;

std::vector<ClusterState> states_of(const NoiseModel& model, double dt_s, double samples) {
  std::vector<ClusterState> states;
  const double tau_s = samples * dt_s;
  if (model.gm_sigma > 0.0) {
    states.push_back(gauss_markov(model.gm_sigma, model.gm_correlation_time_s, dt_s, samples));
  }
  if (model.random_walk > 0.0) states.push_back(random_walk(model.random_walk, dt_s, samples));
  if (model.quantization > 0.0) states.push_back(quantization(model.quantization, tau_s));
  for_each_flicker_process(model, dt_s, [&](const random::Flicker::Process& process) {
    states.push_back(gauss_markov(process.sigma, process.correlation_time_s, dt_s, samples));
  });
  return states;
}

/// Kalman filter of the sum of the states and white noise, for a record and for the constant 1 side by side. Plain
/// arrays: it takes most of the time of a fit.
class Filter {
 public:
  Filter(const std::vector<ClusterState>& states, double white_variance)
      : size_(states.size()), mean_variance_(white_variance) {
    for (std::size_t i = 0; i < size_; ++i) {
      const ClusterState& state = states[i];
      decay_[i] = state.decay;
      gain_[i] = state.gain;
      covariance_[i] = state.covariance;
      drive_[i] = state.drive_variance;
      P_[i][i] = state.initial_variance;
      mean_variance_ += state.mean_variance;
    }
  }

  void take(double mean) {
    if (!settled_) update_gain();
    double v = mean;
    double u = 1.0;
    for (std::size_t i = 0; i < size_; ++i) {
      v -= gain_[i] * at_record_[i];
      u -= gain_[i] * at_one_[i];
    }
    for (std::size_t i = 0; i < size_; ++i) {
      at_record_[i] = decay_[i] * at_record_[i] + K_[i] * v;
      at_one_[i] = decay_[i] * at_one_[i] + K_[i] * u;
    }
    vv_ += v * v / F_;
    uv_ += u * v / F_;
    uu_ += u * u / F_;
    log_F_ += log_of_F_;
  }

  double log_likelihood() const { return -0.5 * (log_F_ + vv_ - uv_ * uv_ / uu_ + std::log(uu_)); }

 private:
  void update_gain() {
    std::array<double, kMaxStates> Pg{};
    F_ = mean_variance_;
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t j = 0; j < size_; ++j) Pg[i] += P_[i][j] * gain_[j];
      F_ += gain_[i] * Pg[i];
    }
    log_of_F_ = std::log(F_);
    for (std::size_t i = 0; i < size_; ++i) K_[i] = (decay_[i] * Pg[i] + covariance_[i]) / F_;
    double change = 0.0;
    double largest = 0.0;
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t j = 0; j < size_; ++j) {
        const double next = decay_[i] * decay_[j] * P_[i][j] + (i == j ? drive_[i] : 0.0) - F_ * K_[i] * K_[j];
        change = std::max(change, std::abs(next - P_[i][j]));
        P_[i][j] = next;
      }
      largest = std::max(largest, P_[i][i]);
    }
    settled_ = change <= kSettled * largest;
  }

  /// Where the covariance moves by less of itself, it is taken to have arrived.
  static constexpr double kSettled = 1e-9;

  std::size_t size_;
  double mean_variance_;
  std::array<double, kMaxStates> decay_{}, gain_{}, covariance_{}, drive_{}, K_{}, at_record_{}, at_one_{};
  std::array<std::array<double, kMaxStates>, kMaxStates> P_{};
  bool settled_ = false;
  double F_ = 0.0;
  double log_of_F_ = 0.0;
  double log_F_ = 0.0;
  double vv_ = 0.0, uv_ = 0.0, uu_ = 0.0;
};

/// White noise alone: no state, all in closed form.
double log_of_white(const std::vector<double>& means, double variance) {
  double sum = 0.0, squares = 0.0;
  for (const double mean : means) sum += mean;
  const auto count = static_cast<double>(means.size());
  for (const double mean : means) squares += (mean - sum / count) * (mean - sum / count);
  return -0.5 * ((count - 1.0) * std::log(variance) + squares / variance + std::log(count));
}

}  // namespace

Likelihood::Likelihood(const Record& record, double finest_tau_s, Means means)
    : dt_s_(record.dt_s()),
      span_s_(record.span_s()),
      samples_per_cluster_(record.samples_per_cluster()),
      means_(record.cluster_means()),
      details_(record.details()) {
  while (first_level_ < details_.size() && std::ldexp(dt_s_, static_cast<int>(first_level_)) < finest_tau_s) {
    ++first_level_;
  }
  if (means == Means::AsTheyAre) return;
  constexpr std::size_t kLeastClusters = 16;
  while (static_cast<double>(samples_per_cluster_) * dt_s_ < finest_tau_s && means_.size() >= 2 * kLeastClusters) {
    for (std::size_t i = 0; i < means_.size() / 2; ++i) means_[i] = 0.5 * (means_[2 * i] + means_[2 * i + 1]);
    means_.resize(means_.size() / 2);
    samples_per_cluster_ *= 2;
  }
}

double Likelihood::log(const NoiseModel& model) const {
  if (!(allan_variance(model, dt_s_, 1) > 0.0)) return -std::numeric_limits<double>::infinity();
  return log_of_details(model) + log_of_means(model);
}

double Likelihood::log_of_details(const NoiseModel& model) const {
  double sum = 0.0;
  for (std::size_t l = first_level_; l < details_.size(); ++l) {
    const std::int64_t m = std::int64_t{1} << l;
    const double tau_s = static_cast<double>(m) * dt_s_;
    const double variance = 2.0 * tau_s * tau_s * allan_variance(model, dt_s_, m);
    sum -= 0.5 * (static_cast<double>(details_[l].count) * std::log(variance) + details_[l].squares / variance);
  }
  return sum;
}

double Likelihood::log_of_means(const NoiseModel& model) const {
  const double tau_s = static_cast<double>(samples_per_cluster_) * dt_s_;
  const double white_variance = model.white * model.white / tau_s;
  const auto states = states_of(model, dt_s_, static_cast<double>(samples_per_cluster_));
  if (states.empty()) return log_of_white(means_, white_variance);
  Filter filter(states, white_variance);
  for (const double mean : means_) filter.take(mean);
  return filter.log_likelihood();
}

std::vector<AllanPoint> Likelihood::rough_curve() const {
  std::vector<AllanPoint> curve;
  const auto add = [&](std::int64_t m, double squares, std::int64_t count) {
    const double tau_s = static_cast<double>(m) * dt_s_;
    curve.push_back({m, squares / (2.0 * tau_s * tau_s * static_cast<double>(count)), 2 * m, count});
  };
  for (std::size_t l = first_level_; l < details_.size(); ++l) {
    add(std::int64_t{1} << l, details_[l].squares, details_[l].count);
  }
  std::vector<double> sums = means_;
  for (double& sum : sums) sum *= static_cast<double>(samples_per_cluster_) * dt_s_;
  for (std::int64_t m = samples_per_cluster_; sums.size() >= 4; m *= 2) {
    double squares = 0.0;
    for (std::size_t i = 0; i < sums.size() / 2; ++i) {
      squares += std::pow(sums[2 * i + 1] - sums[2 * i], 2);
      sums[i] = sums[2 * i] + sums[2 * i + 1];
    }
    sums.resize(sums.size() / 2);
    add(m, squares, static_cast<std::int64_t>(sums.size()));
  }
  return curve;
}

}  // namespace inslab::allan
