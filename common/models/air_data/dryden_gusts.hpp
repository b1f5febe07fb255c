#pragma once

#include "inslab/data/profiles/wind_field.hpp"
#include "inslab/noise/random/stream.hpp"

namespace inslab::air_data {

/// A gust of standard deviation 1 along its spectrum's direction: Dryden's longitudinal form. Over the way s in units
/// of its length it is the first-order process with the correlation
///
///   R(s) = e^-s,    x[k+1] = e^-s x[k] + sqrt(1 - e^-2s) w
class LongitudinalGust {
 public:
  explicit LongitudinalGust(const random::Stream& stream) : numbers_(stream), x_(stream.normal(0)) {}

  double value() const { return x_; }
  /// Goes on by `way` >= 0, in lengths, to sample k >= 1. What is drawn depends on (stream, k) alone.
  void advance(std::uint64_t k, double way);

  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.x_);
  }

 private:
  random::NormalCursor numbers_;
  double x_;
};

/// The same across it, Dryden's transverse form:
///
///   R(s) = e^-s (1 - s/2)
///
/// White noise w through (1 + sqrt(3) p) / (1 + p)^2, p = d/ds: y = z + sqrt(3) z', z'' + 2 z' + z = w. The step is
/// exact for any way: z and z' turn by
///
///   Phi(s) = e^-s [1 + s, s; -s, 1 - s]
///
/// and gain a noise of the covariance (I - Phi Phi^T)/4, as both have the variance 1/4 and no correlation.
class TransverseGust {
 public:
  explicit TransverseGust(const random::Stream& stream)
      : numbers_(stream), z_(0.5 * stream.normal(0)), dz_(0.5 * stream.normal(1)) {}

  double value() const;
  /// As of the other.
  void advance(std::uint64_t k, double way);

  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.z_, self.dz_);
  }

 private:
  random::NormalCursor numbers_;
  double z_;
  double dz_;
};

/// The turbulence of MIL-F-8785C, 3.7.1.2 (Dryden form), through which a vehicle flies: frozen air, so that what counts
/// is the way through it. Gusts have axes along the mean wind, to its right, down. The draws depend on (stream, k)
/// alone: whoever shares stream, rate and way is in the same gusts.
class DrydenGusts {
 public:
  /// Streams "<root>/u", "/v", "/w".
  explicit DrydenGusts(const random::Stream& root) : u_(root.child("/u")), v_(root.child("/v")), w_(root.child("/w")) {}

  /// The gust at sample k >= 1, m/s, after `way_m` through the air since the sample before, at a height above the
  /// ground. Where the wind has no turbulence it is 0, and the states rest.
  Vector3 advance(std::uint64_t k, const WindField& wind, double height_above_ground_m, double way_m);

  /// What goes on from sample to sample (data/state/state_stream.hpp).
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.u_, self.v_, self.w_);
  }

 private:
  LongitudinalGust u_;
  TransverseGust v_;
  TransverseGust w_;
};

}  // namespace inslab::air_data
