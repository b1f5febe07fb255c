#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include "inslab/noise/random/stream.hpp"

namespace inslab::random {

/// Flicker (1/f) noise, the bias instability of data sheets, as a sum of first-order Gauss-Markov processes whose
/// correlation times lie a factor of 4 apart, 1 s to 65536 s.
///
/// `instability` B gives the two-sided spectral density B^2 / (2 pi f), so that the Allan deviation levels off at
/// sqrt(2 ln 2 / pi) B = 0.664 B (IEEE Std 952-1997, annex C). Processes of standard deviation s with times a factor r
/// apart add up to s^2 / (2 ln r f) between them; equal for s = B sqrt(ln r / pi), which for r = 4 is 0.664 B. Of the
/// Poisson sum's harmonics the first, 2 sech(pi^2 / ln r) = 0.3 %, is the ripple of the density. The Allan deviation
/// stays within 3 % of its level from 14 s to 20000 s, within 11 % from 3 s to 18 h, and falls off outside: the
/// shortest time is where white noise hides the flicker of every common sensor. The sum's own standard deviation is 2
/// B.
///
/// A slow process costs less than a fast one: each is held over the largest power of 2 of samples that is at most 1/64
/// of its correlation time, and steps exactly from one held value to the next.
class Flicker {
 public:
  static constexpr int kTerms = 9;
  static constexpr double kSigmaPerInstability = 0.66428248;  ///< sqrt(ln 4 / pi)
  static double correlation_time_s(int term) { return static_cast<double>(std::uint64_t{1} << (2 * term)); }

  /// Throws std::invalid_argument unless instability >= 0 and dt_s > 0, both finite. Term i draws from the stream's
  /// child "/i".
  Flicker(double instability, double dt_s, const Stream& stream)
      : Flicker(instability, dt_s, stream, std::make_integer_sequence<int, kTerms>()) {}

  /// The noise at the present sample.
  double value() const { return sigma_ * sum_; }

  /// Goes from sample k to sample k + 1. The drives depend on (stream, k) alone; while the instability is 0 nothing is
  /// drawn.
  void advance(std::uint64_t k) {
    if (sigma_ == 0.0 || ((k + 1) & terms_[0].mask) != 0) return;
    for (Term& term : terms_) {
      if (((k + 1) & term.mask) != 0) break;  // the masks grow: no later term steps either
      term.x = term.decay * term.x + term.drive * term.numbers.at((k + 1) >> term.shift);
    }
    add_up();
  }

  /// Takes a new instability between two samples; the states keep their size in units of sigma. Throws as the
  /// constructor does and then changes nothing.
  void retune(double instability) {
    if (!(std::isfinite(instability) && instability >= 0.0)) {
      throw std::invalid_argument("flicker: the instability is below 0");
    }
    sigma_ = kSigmaPerInstability * instability;
  }

  /// The states go to zero; from there each spread grows to its own within a few of its correlation times.
  void reset() {
    for (Term& term : terms_) term.x = 0.0;
    sum_ = 0.0;
  }

  /// Other states of the steady spread, as after switching the sensor off and on. Depends on (stream, k) alone.
  void redraw(std::uint64_t k) {
    for (Term& term : terms_) term.x = term.redraws.normal(k);
    add_up();
  }

  /// What goes on from sample to sample (recovery/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    for (auto& term : self.terms_) visit(term.x);
    visit(self.sum_);
  }

 private:
  struct Term {
    Term(double dt_s, double correlation_time_s, const Stream& stream)
        : numbers(stream), redraws(stream.child("/redraw")), x(stream.normal(0)) {
      constexpr double kHeld = 1.0 / 64.0;
      while (std::ldexp(dt_s, shift + 1) <= kHeld * correlation_time_s) ++shift;
      mask = (std::uint64_t{1} << shift) - 1;
      const double ratio = std::ldexp(dt_s, shift) / correlation_time_s;
      decay = std::exp(-ratio);
      drive = std::sqrt(-std::expm1(-2.0 * ratio));
    }
    NormalCursor numbers;
    Stream redraws;
    int shift = 0;  ///< held over 2^shift samples
    std::uint64_t mask = 0;
    double decay = 1.0;
    double drive = 0.0;
    double x;  ///< in units of sigma
  };

  template <int... i>
  Flicker(double instability, double dt_s, const Stream& stream, std::integer_sequence<int, i...>)
      : terms_{Term(checked(dt_s), correlation_time_s(i), stream.child("/" + std::to_string(i)))...} {
    retune(instability);
    add_up();
  }
  static double checked(double dt_s) {
    if (!(std::isfinite(dt_s) && dt_s > 0.0)) throw std::invalid_argument("flicker: the interval is not above 0 s");
    return dt_s;
  }
  void add_up() {
    sum_ = 0.0;
    for (const Term& term : terms_) sum_ += term.x;
  }

  std::array<Term, kTerms> terms_;
  double sigma_ = 0.0;
  double sum_ = 0.0;  ///< of the terms' states
};

}  // namespace inslab::random
