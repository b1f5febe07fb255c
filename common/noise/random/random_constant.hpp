#pragma once

#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "inslab/noise/random/stream.hpp"

namespace inslab::random {

/// A constant drawn once, x ~ N(0, sigma^2): what differs from one switch-on of a sensor to the next (thesis (2-59)).
class RandomConstant {
 public:
  /// Throws std::invalid_argument unless sigma >= 0 and finite.
  RandomConstant(double sigma, Stream stream) : redraws_(stream.child("/redraw")), x_over_sigma_(stream.normal(0)) {
    retune(sigma);
  }

  double value() const { return sigma_ * x_over_sigma_; }

  /// Takes a new sigma; the constant keeps its size in units of sigma. Throws as the constructor does and then changes
  /// nothing.
  void retune(double sigma) {
    if (!(std::isfinite(sigma) && sigma >= 0.0)) throw std::invalid_argument("random constant: sigma is below 0");
    sigma_ = sigma;
  }

  /// Another constant, as after switching the sensor off and on. Depends on (stream, k) alone.
  void redraw(std::uint64_t k) { x_over_sigma_ = redraws_.normal(k); }

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.x_over_sigma_);
  }

 private:
  double sigma_ = 0.0;
  Stream redraws_;
  double x_over_sigma_;
};

}  // namespace inslab::random
