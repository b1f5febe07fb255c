#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "inslab/noise/allan/noise_model.hpp"
#include "inslab/noise/random/gauss_markov.hpp"
#include "inslab/noise/random/white_noise.hpp"

namespace inslab::allan::test {

/// Increments of the integral under `model` without flicker, from the seed's own streams.
class SimulatedNoise {
 public:
  SimulatedNoise(const NoiseModel& model, double dt_s, std::uint64_t seed)
      : dt_s_(dt_s),
        quantization_(model.quantization),
        walk_step_(model.random_walk * std::sqrt(dt_s)),
        white_(model.white, dt_s, random::Stream(seed, "white")),
        bias_({model.gm_sigma, model.gm_correlation_time_s}, dt_s, random::Stream(seed, "bias")),
        phase_(random::Stream(seed, "phase")),
        steps_(random::Stream(seed, "walk")) {}

  double next() {
    const double phase = quantization_ * phase_.at(k_ + 1);
    const double increment =
        white_.increment(k_) + (bias_.value() + walk_) * dt_s_ + phase - quantization_ * phase_.at(k_);
    bias_.advance(k_);
    walk_ += walk_step_ * steps_.at(k_);
    ++k_;
    return increment;
  }

 private:
  double dt_s_;
  double quantization_;
  double walk_step_;
  random::WhiteNoise white_;
  random::GaussMarkov bias_;
  random::NormalCursor phase_;
  random::NormalCursor steps_;
  double walk_ = 0.0;
  std::uint64_t k_ = 0;
};

inline std::vector<double> simulated_increments(const NoiseModel& model, double dt_s, std::uint64_t seed,
                                                std::size_t count) {
  SimulatedNoise noise(model, dt_s, seed);
  std::vector<double> increments(count);
  for (double& increment : increments) increment = noise.next();
  return increments;
}

/// The integral, beginning at 0: one value more than increments.
inline std::vector<double> integrated(const std::vector<double>& increments) {
  std::vector<double> phase{0.0};
  for (const double increment : increments) phase.push_back(phase.back() + increment);
  return phase;
}

}  // namespace inslab::allan::test
