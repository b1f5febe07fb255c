#pragma once

#include <array>
#include <cmath>
#include <complex>

#include "inslab/data/profiles/imu_error_profile.hpp"
#include "inslab/foundation/units/units.hpp"

namespace inslab::imu {

/// The low-pass filter of one axis in continuous time, from the rate u that the sensor feels to the rate y whose
/// integral it puts out, w = 2 pi bandwidth:
///
///   first order    y' = w (u - y)                    H(f) = 1 / (1 + i f/bandwidth)
///   second order   y'' = w^2 (u - y) - sqrt(2) w y'  Butterworth's damping
class LowPass {
 public:
  /// y, y' and the integral of y since some instant.
  struct State {
    double y = 0.0;
    double slope = 0.0;  ///< second order alone
    double integral = 0.0;
  };

  LowPass() = default;  ///< none
  LowPass(double bandwidth_hz, FilterOrder order)
      : order_(bandwidth_hz == 0.0           ? 0
               : order == FilterOrder::First ? 1
                                             : 2) {
    // Both orders decay with s, and the second turns by s dt: w exp(+-3 pi i/4) are its poles.
    const double w = 2.0 * units::kPi * bandwidth_hz;
    s_ = order_ == 2 ? w * std::sqrt(0.5) : w;
  }

  int order() const { return order_; }
  double s() const { return s_; }  ///< 1/s
  bool operator==(const LowPass& other) const { return order_ == other.order_ && s_ == other.s_; }

  /// H(f), 1 without a filter; f may be negative.
  std::complex<double> response(double frequency_hz) const {
    if (order_ == 0) return 1.0;
    const double x = 2.0 * units::kPi * frequency_hz / s_;
    if (order_ == 1) return 1.0 / std::complex<double>(1.0, x);
    return 2.0 / std::complex<double>(2.0 - x * x, 2.0 * x);
  }

  /// What an input of 0 leaves of a state after `time_s`, with the integral added to that of the state.
  State decayed(const State& from, double time_s) const {
    const double decay = std::exp(-s_ * time_s);
    if (order_ == 1) return {from.y * decay, 0.0, from.integral - from.y * std::expm1(-s_ * time_s) / s_};
    const double cosine = std::cos(s_ * time_s), sine = std::sin(s_ * time_s);
    State to;
    to.y = decay * (from.y * cosine + (from.slope / s_ + from.y) * sine);
    to.slope = decay * (from.slope * cosine - (from.slope + 2.0 * s_ * from.y) * sine);
    to.integral = from.integral - ((to.slope - from.slope) / s_ + 2.0 * (to.y - from.y)) / (2.0 * s_);
    return to;
  }

  /// The state that an impulse of the input of size 1 leaves.
  State after_impulse() const { return order_ == 1 ? State{s_, 0.0, 0.0} : State{0.0, 2.0 * s_ * s_, 0.0}; }

  /// What `slope` P1(x) + `curve` P2(x) over an interval makes of a state of 0, x from -1 to 1, P Legendre's.
  State after_course(double slope, double curve, double dt_s) const {
    return s_ * dt_s < kShort ? by_quadrature(slope, curve, dt_s) : by_polynomials(slope, curve, dt_s);
  }

 private:
  static constexpr double kShort = 0.5;

  /// Gauss's sum of 6 points over the answer to an impulse, which leaves 1e-15 of it while s dt < 0.5.
  State by_quadrature(double slope, double curve, double dt_s) const {
    static constexpr double kPoints[] = {0.23861918608319690863, 0.66120938646626451366, 0.93246951420315202781};
    static constexpr double kWeights[] = {0.46791393457269104739, 0.36076157304813860757, 0.17132449237917034504};
    State sum;
    for (int i = 0; i < 6; ++i) {
      const double x = i < 3 ? kPoints[i] : -kPoints[i - 3];
      const double weight = 0.5 * dt_s * kWeights[i % 3] * (slope * x + curve * (1.5 * x * x - 0.5));
      const State part = decayed(after_impulse(), 0.5 * (1.0 - x) * dt_s);
      sum.y += weight * part.y;
      sum.slope += weight * part.slope;
      sum.integral += weight * part.integral;
    }
    return sum;
  }

  /// The polynomial that follows the filter's equation, less what its start would leave.
  State by_polynomials(double slope, double curve, double dt_s) const {
    const double per_s = 2.0 / dt_s;  // dx/dt
    const double second = 3.0 * curve * per_s * per_s / (s_ * s_ * (order_ == 2 ? 2.0 : 1.0));
    const auto follows = [&](double x) {
      const double u = slope * x + curve * (1.5 * x * x - 0.5), du = per_s * (slope + 3.0 * curve * x);
      const double slope_y = order_ == 2 ? du - 3.0 * curve * per_s * per_s / s_ : 0.0;
      return State{u - du / s_ + second, slope_y, 0.0};
    };
    const State start = follows(-1.0), end = follows(1.0);
    const State left = decayed(start, dt_s);
    // Its integral: those of P1 and P2 are 0, that of u' is the difference of both ends.
    return {end.y - left.y, end.slope - left.slope, -2.0 * slope / s_ + second * dt_s - left.integral};
  }

  int order_ = 0;
  double s_ = 0.0;
};

/// A low-pass filter over an interval whose length seldom changes: what LowPass says of it, kept for two lengths, since
/// those of a rate such as 300 Hz take turns. A function of filter and length alone: a cache, not a state.
class LowPassSteps {
 public:
  LowPass::State decayed(const LowPass& filter, const LowPass::State& from, double dt_s) {
    const Kept& kept = over(filter, dt_s);
    LowPass::State to = sum(kept.of_y, from.y, kept.of_slope, from.slope);
    to.integral += from.integral;
    return to;
  }
  LowPass::State after_course(const LowPass& filter, double slope, double curve, double dt_s) {
    const Kept& kept = over(filter, dt_s);
    return sum(kept.of_course_slope, slope, kept.of_course_curve, curve);
  }

 private:
  /// The filter is linear: its answers to one of each.
  struct Kept {
    LowPass filter;
    double dt_s = 0.0;
    LowPass::State of_y, of_slope, of_course_slope, of_course_curve;
  };

  static LowPass::State sum(const LowPass::State& a, double x, const LowPass::State& b, double y) {
    return {a.y * x + b.y * y, a.slope * x + b.slope * y, a.integral * x + b.integral * y};
  }
  const Kept& over(const LowPass& filter, double dt_s) {
    for (const Kept& kept : kept_) {
      if (kept.dt_s == dt_s && kept.filter == filter) return kept;
    }
    next_ = 1 - next_;
    kept_[next_] = {filter,
                    dt_s,
                    filter.decayed({1.0, 0.0, 0.0}, dt_s),
                    filter.decayed({0.0, 1.0, 0.0}, dt_s),
                    filter.after_course(1.0, 0.0, dt_s),
                    filter.after_course(0.0, 1.0, dt_s)};
    return kept_[next_];
  }

  std::array<Kept, 2> kept_;
  std::size_t next_ = 0;
};

/// Of the axes of a triad.
using LowPasses = std::array<LowPass, 3>;
using TriadLowPassSteps = std::array<LowPassSteps, 3>;

/// What the part of a triad's input that is not its mean over the interval adds to a filter that is solved for the
/// mean: at the interval's end and to the output's integral. Rates in rad/s | m/s^2.
struct Unsteady {
  Vector3 y = Vector3::Zero();
  Vector3 slope = Vector3::Zero();
  Vector3 integral = Vector3::Zero();  ///< rad | m/s
  Vector3 start_y = Vector3::Zero();   ///< of a filter that begins settled: what a vibration would have left in it
  Vector3 start_slope = Vector3::Zero();

  Unsteady& operator+=(const Unsteady& other) {
    y += other.y;
    slope += other.slope;
    integral += other.integral;
    start_y += other.start_y;
    start_slope += other.start_slope;
    return *this;
  }
  void add(int axis, const LowPass::State& state) {
    y[axis] += state.y;
    slope[axis] += state.slope;
    integral[axis] += state.integral;
  }
};

}  // namespace inslab::imu
