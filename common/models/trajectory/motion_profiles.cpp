#include "inslab/models/trajectory/motion_profiles.hpp"

#include <algorithm>
#include <cmath>

namespace inslab::trajectory {

namespace {
constexpr double kTwoPi = 2.0 * 3.14159265358979323846;
}  // namespace

double ConstantProfile::largest() const { return std::abs(value_); }

double RampProfile::largest() const { return std::max(std::abs(from_), std::abs(to_)); }

SinusoidProfile::SinusoidProfile(Phase phase, double amplitude, double period_s)
    : phase_(phase), amplitude_(amplitude), period_s_(period_s) {}

double SinusoidProfile::value(double t_s) const {
  const double angle = kTwoPi * t_s / period_s_;
  return amplitude_ * (phase_ == Phase::Sine ? std::sin(angle) : std::cos(angle));
}

double SinusoidProfile::integral(double t_s) const {
  const double angle = kTwoPi * t_s / period_s_;
  if (phase_ == Phase::Cosine) return amplitude_ * period_s_ / kTwoPi * std::sin(angle);
  const double half = std::sin(0.5 * angle);  // 1 - cos(angle) without its cancellation
  return amplitude_ * period_s_ / kTwoPi * 2.0 * half * half;
}

// Simpson's rule over a hundredth of a period errs by (2 pi/100)^4/2880 = 5e-9 of the step's integral.
double SinusoidProfile::step_s() const { return period_s_ / 100.0; }
double SinusoidProfile::largest() const { return std::abs(amplitude_); }

// The area of a trapezoid with two ramps of t1 is peak (t - t1).
TrapezoidProfile::TrapezoidProfile(double area, double duration_s, double ramp_fraction)
    : area_(area),
      duration_s_(duration_s),
      ramp_s_(ramp_fraction * duration_s),
      peak_(area / (duration_s * (1.0 - ramp_fraction))) {}

double TrapezoidProfile::value(double t_s) const {
  const double from_nearer_end = std::max(0.0, std::min(t_s, duration_s_ - t_s));
  return from_nearer_end < ramp_s_ ? peak_ * from_nearer_end / ramp_s_ : peak_;
}

double TrapezoidProfile::integral_of_rise(double t_s) const {
  return t_s < ramp_s_ ? 0.5 * peak_ * t_s * t_s / ramp_s_ : peak_ * (t_s - 0.5 * ramp_s_);
}

double TrapezoidProfile::integral(double t_s) const {
  if (t_s <= 0.5 * duration_s_) return integral_of_rise(t_s);
  return area_ - integral_of_rise(std::max(0.0, duration_s_ - t_s));
}

std::vector<double> TrapezoidProfile::corners() const { return {ramp_s_, duration_s_ - ramp_s_}; }
double TrapezoidProfile::largest() const { return std::abs(peak_); }

TurnProfile::TurnProfile(double area, double duration_s, double ramp_fraction)
    : area_(area),
      duration_s_(duration_s),
      ramp_s_(ramp_fraction * duration_s),
      k_(4.0 * area / (duration_s * ramp_s_ * ramp_s_ * (1.0 - ramp_fraction))) {}

double TurnProfile::value(double t_s) const {
  // The rate is symmetric about the middle, so (3-10) is needed for its rising half alone.
  const double u = std::max(0.0, std::min(t_s, duration_s_ - t_s));
  if (u < 0.5 * ramp_s_) return 0.5 * k_ * u * u;
  const double to_top = ramp_s_ - u;
  const double top = 0.25 * k_ * ramp_s_ * ramp_s_;
  return u < ramp_s_ ? top - 0.5 * k_ * to_top * to_top : top;
}

double TurnProfile::integral_of_rise(double t_s) const {
  if (t_s < 0.5 * ramp_s_) return k_ * t_s * t_s * t_s / 6.0;
  const double top = 0.25 * k_ * ramp_s_ * ramp_s_;
  const double to_top = std::max(0.0, ramp_s_ - t_s);
  // Half of the ramp's time at the top rate is lost on the way up; what is left of the rise comes back as a cube.
  return top * (t_s - 0.5 * ramp_s_) + k_ * to_top * to_top * to_top / 6.0;
}

double TurnProfile::integral(double t_s) const {
  if (t_s <= 0.5 * duration_s_) return integral_of_rise(t_s);
  return area_ - integral_of_rise(std::max(0.0, duration_s_ - t_s));
}

std::vector<double> TurnProfile::corners() const {
  return {0.5 * ramp_s_, ramp_s_, duration_s_ - ramp_s_, duration_s_ - 0.5 * ramp_s_};
}
double TurnProfile::largest() const { return std::abs(0.25 * k_ * ramp_s_ * ramp_s_); }

}  // namespace inslab::trajectory
