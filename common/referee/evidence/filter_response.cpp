#include "inslab/referee/evidence/filter_response.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "inslab/models/imu/bandwidth.hpp"

namespace inslab::evidence {

namespace {

double sum_of_squares(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return sum;
}

/// Of the sequence that this answer makes of white noise.
double sum_of_squared_correlations(const std::vector<double>& answer) {
  const double variance = sum_of_squares(answer);
  double sum = 1.0;
  for (std::size_t lag = 1; lag < answer.size(); ++lag) {
    double covariance = 0.0;
    for (std::size_t k = lag; k < answer.size(); ++k) covariance += answer[k] * answer[k - lag];
    sum += 2.0 * std::pow(covariance / variance, 2);
  }
  return sum;
}

}  // namespace

FilterResponse::FilterResponse(double bandwidth_hz, FilterOrder order, double dt_s)
    : dt_s_(dt_s), low_pass_(std::max(bandwidth_hz, 0.0), order) {
  if (bandwidth_hz < 0.0) throw std::invalid_argument("a bandwidth is 0 or above");
  if (bandwidth_hz == 0.0) return;
  constexpr double kLeft = 1e-6;
  constexpr std::size_t kLongest = 20000;
  imu::TriadParameters parameters;
  parameters.bandwidth_hz.setConstant(bandwidth_hz);
  parameters.bandwidth_order = order;
  imu::Bandwidth filter(parameters, dt_s);
  (void)filter.filtered(Vector3::Zero());  // it starts settled on its first input
  answer_.clear();
  double due = 1.0;  // of the increment that came in
  for (Vector3 input = Vector3::Ones(); answer_.size() < kLongest; input.setZero()) {
    answer_.push_back(filter.filtered(input).x());
    due -= answer_.back();
    if (std::abs(due) < kLeft && std::abs(answer_.back()) < kLeft) break;
  }
}

double FilterResponse::white_gain() const { return sum_of_squares(answer_); }

double FilterResponse::difference_gain() const { return 0.5 * sum_of_squares(differences()); }

double FilterResponse::power_at(double frequency_hz) const {
  std::complex<double> sum;
  for (std::size_t k = 0; k < answer_.size(); ++k) {
    sum += std::polar(answer_[k], -2.0 * units::kPi * frequency_hz * dt_s_ * static_cast<double>(k));
  }
  return std::norm(sum);
}

double FilterResponse::white_correlation() const { return sum_of_squared_correlations(answer_); }

double FilterResponse::difference_correlation() const { return sum_of_squared_correlations(differences()); }

std::vector<double> FilterResponse::differences() const {
  std::vector<double> all = answer_;
  all.push_back(0.0);
  for (std::size_t k = all.size() - 1; k > 0; --k) all[k] -= all[k - 1];
  return all;
}

}  // namespace inslab::evidence
