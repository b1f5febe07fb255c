#pragma once

#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "inslab/noise/random/stream.hpp"

namespace inslab::random {

/// First-order Gauss-Markov process sampled every `dt`.
///
///   x[k+1] = exp(-dt/T) x[k] + w[k],   w ~ N(0, sigma^2 (1 - exp(-2 dt/T))),   x[0] ~ N(0, sigma^2)
///
/// `sigma` is the steady-state standard deviation, in the unit of the quantity; `T` the correlation time.
/// Number 0 of the stream draws x[0], number k + 1 draws w[k].
/// Source: thesis (2-63)..(2-65); (2-64) lacks the factor x[k] and calls the drive's strength sigma.
class GaussMarkov {
 public:
  struct Parameters {
    double sigma = 0.0;
    double correlation_time_s = 0.0;
  };

  /// Throws std::invalid_argument when dt_s <= 0, when sigma < 0, when sigma > 0 and correlation_time_s <= 0, or when
  /// one of them is not finite.
  GaussMarkov(const Parameters& parameters, double dt_s, Stream stream)
      : dt_s_(dt_s), numbers_(stream), redraws_(stream.child("/redraw")), x_over_sigma_(stream.normal(0)) {
    if (!(std::isfinite(dt_s) && dt_s > 0.0))
      throw std::invalid_argument("Gauss-Markov: the interval is not above 0 s");
    retune(parameters);
  }

  /// x at the present sample; before the first call of advance() that is x[0].
  double value() const { return sigma_ * x_over_sigma_; }

  /// Goes from sample k to sample k + 1 and returns x[k+1]. The drive depends on (stream, k) alone. While sigma is 0
  /// the process rests and nothing is drawn.
  double advance(std::uint64_t k) {
    if (sigma_ == 0.0) return 0.0;
    x_over_sigma_ = decay_ * x_over_sigma_ + drive_ * numbers_.at(k + 1);
    return value();
  }

  /// Takes new parameters between two samples; the state keeps its size in units of sigma. Throws as the constructor
  /// does and then changes nothing.
  void retune(const Parameters& parameters) {
    const auto [sigma, correlation_time_s] = parameters;
    if (!(std::isfinite(sigma) && sigma >= 0.0)) throw std::invalid_argument("Gauss-Markov: sigma is below 0");
    if (sigma > 0.0 && !(std::isfinite(correlation_time_s) && correlation_time_s > 0.0)) {
      throw std::invalid_argument("Gauss-Markov: the correlation time is not above 0 s");
    }
    sigma_ = sigma;
    if (sigma == 0.0) return;
    const double ratio = dt_s_ / correlation_time_s;
    decay_ = std::exp(-ratio);
    drive_ = std::sqrt(-std::expm1(-2.0 * ratio));  // 1 - exp(-2 dt/T) cancels when T is long
  }

  /// The state goes to zero; from there the spread grows to sigma within a few correlation times.
  void reset() { x_over_sigma_ = 0.0; }

  /// Another state of the steady spread, as after switching the sensor off and on. Depends on (stream, k) alone.
  void redraw(std::uint64_t k) { x_over_sigma_ = redraws_.normal(k); }

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.x_over_sigma_);
  }

 private:
  double dt_s_;
  double sigma_ = 0.0;
  double decay_ = 1.0;
  double drive_ = 0.0;
  NormalCursor numbers_;
  Stream redraws_;
  double x_over_sigma_;
};

}  // namespace inslab::random
