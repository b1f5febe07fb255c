#pragma once

#include "inslab/referee/score/quantiles.hpp"
#include "inslab/referee/score/true_pose.hpp"

namespace inslab::score {

/// Sums of a vector's three components over all solutions.
struct VectorSums {
  Vector3 sum = Vector3::Zero();
  Vector3 sum_of_squares = Vector3::Zero();
  Vector3 largest = Vector3::Zero();  ///< magnitudes

  void add(const Vector3& value) {
    sum += value;
    sum_of_squares += value.cwiseProduct(value);
    largest = largest.cwiseMax(value.cwiseAbs());
  }
  Vector3 mean(std::uint64_t count) const { return sum / static_cast<double>(count); }
  Vector3 rms(std::uint64_t count) const { return (sum_of_squares / static_cast<double>(count)).cwiseSqrt(); }
};

/// Normalised estimation error squared by the diagonal sigmas that an app reports: sum over three axes of
/// (error/sigma)^2, whose expectation is 3. What correlates between the axes is not in it.
struct Nees {
  double sum = 0.0;
  std::uint64_t count = 0;  ///< of solutions that give all three sigmas

  void add(const Vector3& error, const Vector3& sigma) {
    if (!sigma.allFinite() || !(sigma.minCoeff() > 0.0)) return;
    sum += error.cwiseQuotient(sigma).squaredNorm();
    ++count;
  }
  std::optional<double> mean() const {
    return count == 0 ? std::nullopt : std::optional<double>(sum / static_cast<double>(count));
  }
};

/// The errors of the solutions of one phase.
class ErrorStatistics {
 public:
  void add(const SolutionError& error, const NavSolution& solution);
  /// An interval of the truth that belongs to the phase, and whether a solution covered it.
  void add_time(double seconds, bool covered) {
    time_s_ += seconds;
    if (covered) covered_s_ += seconds;
  }

  std::uint64_t count() const { return count_; }
  double time_s() const { return time_s_; }
  double covered_s() const { return covered_s_; }
  const VectorSums& position() const { return position_; }
  const VectorSums& velocity() const { return velocity_; }
  const VectorSums& phi() const { return phi_; }
  const Quantiles& horizontal_m() const { return horizontal_m_; }
  const Quantiles& vertical_m() const { return vertical_m_; }
  const Nees& position_nees() const { return position_nees_; }
  const Nees& velocity_nees() const { return velocity_nees_; }
  const Nees& attitude_nees() const { return attitude_nees_; }

 private:
  std::uint64_t count_ = 0;
  double time_s_ = 0.0;
  double covered_s_ = 0.0;
  VectorSums position_;
  VectorSums velocity_;
  VectorSums phi_;
  Quantiles horizontal_m_;
  Quantiles vertical_m_;
  Nees position_nees_;
  Nees velocity_nees_;
  Nees attitude_nees_;
};

}  // namespace inslab::score
