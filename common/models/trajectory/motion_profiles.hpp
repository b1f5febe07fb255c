#pragma once

#include <limits>
#include <variant>
#include <vector>

/// The scalar functions of time that motions are made of, from 0 at a segment's start.
///
/// Each has `value(t)`, an acceleration or an angular rate in whatever unit it was given; `integral(t)`, the
/// closed-form integral of value from 0 to t, so that speeds and angles carry no quadrature error; `corners()`, the
/// times inside the duration where a derivative jumps, where integration has to be split; and `step_s()`, a step within
/// which the value is smooth enough for a fourth-order method (infinity: no limit of its own); `largest()`, a bound of
/// |value|. Times are in s.
namespace inslab::trajectory {

inline constexpr double kNoStepLimit_s = std::numeric_limits<double>::infinity();

/// Types 4 and 8: value(t) = c.
class ConstantProfile {
 public:
  explicit ConstantProfile(double value) : value_(value) {}
  double value(double) const { return value_; }
  double integral(double t_s) const { return value_ * t_s; }
  std::vector<double> corners() const { return {}; }
  double step_s() const { return kNoStepLimit_s; }
  double largest() const;

 private:
  double value_;
};

/// Types 6 and 10: linear between two values.
class RampProfile {
 public:
  RampProfile(double from, double to, double duration_s) : from_(from), to_(to), slope_((to - from) / duration_s) {}
  double value(double t_s) const { return from_ + slope_ * t_s; }
  double integral(double t_s) const { return t_s * (from_ + 0.5 * slope_ * t_s); }
  std::vector<double> corners() const { return {}; }
  double step_s() const { return kNoStepLimit_s; }
  double largest() const;

 private:
  double from_;
  double to_;
  double slope_;
};

/// Types 5, 9 and 91: A sin(2 pi t/T + phase), phase 0 or pi/2.
class SinusoidProfile {
 public:
  enum class Phase { Sine, Cosine };
  SinusoidProfile(Phase phase, double amplitude, double period_s);
  double value(double t_s) const;
  double integral(double t_s) const;
  std::vector<double> corners() const { return {}; }
  double step_s() const;
  double largest() const;

 private:
  Phase phase_;
  double amplitude_;
  double period_s_;
};

/// Types 2 and 3: a trapezoid of the given area; rises in t1 = A t, falls in the last t1.
class TrapezoidProfile {
 public:
  TrapezoidProfile(double area, double duration_s, double ramp_fraction);
  double value(double t_s) const;
  double integral(double t_s) const;
  std::vector<double> corners() const;
  double step_s() const { return kNoStepLimit_s; }
  double largest() const;

 private:
  double integral_of_rise(double t_s) const;

  double area_;
  double duration_s_;
  double ramp_s_;
  double peak_;
};

/// Type 7: the rate of a turn through the given area, whose derivative is two triangles: thesis (3-9)..(3-13).
class TurnProfile {
 public:
  TurnProfile(double area, double duration_s, double ramp_fraction);
  double value(double t_s) const;
  double integral(double t_s) const;
  std::vector<double> corners() const;
  double step_s() const { return kNoStepLimit_s; }
  double largest() const;

 private:
  double integral_of_rise(double t_s) const;

  double area_;
  double duration_s_;
  double ramp_s_;
  double k_;  ///< slope of the triangles
};

using MotionProfile = std::variant<ConstantProfile, RampProfile, SinusoidProfile, TrapezoidProfile, TurnProfile>;

}  // namespace inslab::trajectory
