#pragma once

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "inslab/noise/random/stream.hpp"

namespace inslab::random {

/// Flicker (1/f) noise, the bias instability of data sheets, as a sum of first-order Gauss-Markov processes whose
/// correlation times lie a factor of 4 apart, from 1.18 samples to at least 65536 s.
///
/// `instability` B gives the two-sided spectral density B^2 / (2 pi f), so that the Allan deviation levels off at
/// sqrt(2 ln 2 / pi) B = 0.664 B (IEEE Std 952-1997, annex C). Processes of standard deviation s with times a factor r
/// apart add up to s^2 / (2 ln r f) between them; equal for s = B sqrt(ln r / pi), which for r = 4 is 0.664 B. Of the
/// Poisson sum's harmonics the first, 2 sech(pi^2 / ln r) = 0.3 %, is the ripple of the density.
///
/// The bias is held over a sample, whose mean the noise of all frequencies above half the sample rate takes part in:
/// the fastest process stands for the faster ones that are left out. Its time and its variance, 1.18 samples and 1.295
/// times that of the others, are those that give the Allan deviation of exact flicker over one sample and over three.
/// So it is within 1 % of its level from one sample to 5000 s, within 3 % to 20000 s and within 11 % to 18 h, and falls
/// off beyond.
///
/// A slow process costs less than a fast one: each is held over the largest power of 2 of samples that is at most 1/64
/// of its correlation time, and steps exactly from one held value to the next.
class Flicker {
 public:
  static constexpr double kSigmaPerInstability = 0.66428248;  ///< sqrt(ln 4 / pi)
  static constexpr double kSlowest_s = 65536.0;
  /// No more at any interval of a nanosecond or longer.
  static constexpr int kMostTerms = 24;

  /// One of the processes, of instability 1.
  struct Process {
    double sigma;
    double correlation_time_s;
  };
  static Process process(int term, double dt_s) {
    constexpr double kFastestTimeInSamples = 1.1799254, kFastestVariance = 1.2946742;
    const double sigma = term == 0 ? kSigmaPerInstability * std::sqrt(kFastestVariance) : kSigmaPerInstability;
    return {sigma, std::ldexp(kFastestTimeInSamples * dt_s, 2 * term)};
  }
  /// How many there are at an interval; one at least.
  static int terms(double dt_s) {
    int terms = 1;
    while (terms < kMostTerms && process(terms - 1, dt_s).correlation_time_s < kSlowest_s) ++terms;
    return terms;
  }

  /// Throws std::invalid_argument unless instability >= 0 and dt_s > 0, both finite. Term i draws from the stream's
  /// child "/i".
  Flicker(double instability, double dt_s, const Stream& stream) {
    if (!(std::isfinite(dt_s) && dt_s > 0.0)) throw std::invalid_argument("flicker: the interval is not above 0 s");
    const int count = terms(dt_s);
    terms_.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) terms_.emplace_back(process(i, dt_s), dt_s, stream.child("/" + std::to_string(i)));
    retune(instability);
    add_up();
  }

  /// The noise at the present sample.
  double value() const { return instability_ * sum_; }

  /// Goes from sample k to sample k + 1. The drives depend on (stream, k) alone; while the instability is 0 nothing is
  /// drawn.
  void advance(std::uint64_t k) {
    if (instability_ == 0.0) return;
    for (Term& term : terms_) {
      if (((k + 1) & term.mask) != 0) break;  // the masks grow: no later term steps either
      term.x = term.decay * term.x + term.drive * term.numbers.at((k + 1) >> term.shift);
    }
    add_up();
  }

  /// Takes a new instability between two samples; the states keep their size in units of it. Throws as the
  /// constructor does and then changes nothing.
  void retune(double instability) {
    if (!(std::isfinite(instability) && instability >= 0.0)) {
      throw std::invalid_argument("flicker: the instability is below 0");
    }
    instability_ = instability;
  }

  /// The states go to zero; from there each spread grows to its own within a few of its correlation times.
  void reset() {
    for (Term& term : terms_) term.x = 0.0;
    sum_ = 0.0;
  }

  /// Other states of the steady spread, as after switching the sensor off and on. Depends on (stream, k) alone.
  void redraw(std::uint64_t k) {
    for (Term& term : terms_) term.x = term.sigma * term.redraws.normal(k);
    add_up();
  }

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    for (auto& term : self.terms_) visit(term.x);
    visit(self.sum_);
  }

 private:
  struct Term {
    Term(const Process& process, double dt_s, const Stream& stream)
        : numbers(stream), redraws(stream.child("/redraw")), sigma(process.sigma), x(process.sigma * stream.normal(0)) {
      constexpr double kHeld = 1.0 / 64.0;
      while (std::ldexp(dt_s, shift + 1) <= kHeld * process.correlation_time_s) ++shift;
      mask = (std::uint64_t{1} << shift) - 1;
      const double ratio = std::ldexp(dt_s, shift) / process.correlation_time_s;
      decay = std::exp(-ratio);
      drive = sigma * std::sqrt(-std::expm1(-2.0 * ratio));
    }
    NormalCursor numbers;
    Stream redraws;
    int shift = 0;  ///< held over 2^shift samples
    std::uint64_t mask = 0;
    double decay = 1.0;
    double drive = 0.0;
    double sigma;
    double x;  ///< of instability 1
  };

  void add_up() {
    sum_ = 0.0;
    for (const Term& term : terms_) sum_ += term.x;
  }

  std::vector<Term> terms_;
  double instability_ = 0.0;
  double sum_ = 0.0;  ///< of the terms' states
};

}  // namespace inslab::random
