#pragma once

#include <cstdint>
#include <optional>

#include "inslab/models/navigation/covariance.hpp"
#include "inslab/models/navigation/measurement.hpp"
#include "inslab/models/navigation/parameters.hpp"
#include "inslab/nav/strapdown.hpp"

namespace inslab::navigation {

/// One interval of the IMU as the filter takes it in, or a part of one.
struct ImuInterval {
  std::int64_t end_ns = 0;
  nav::ImuIncrements increments;   ///< as the IMU gave them, or held over
  double rate_held_over_s = 0.0;   ///< 0: the rate is measured; else for how long it has been held over, at the end
  double force_held_over_s = 0.0;  ///< the same of the specific force
  bool window_begins = false;      ///< of the detector of rest, with this interval
  bool at_rest = false;            ///< it ends a window of rest here
  bool moves = false;              ///< it ends one that is no rest
};

/// Mechanization and error-state Kalman filter at one instant. A value: a copy goes on as the original does, which is
/// how measurements from the past are taken in (NavigationFilter).
class InertialFilter {
 public:
  /// `errors` are those that the start knows of (of blocks that the state lacks they are dropped), `before` is the last
  /// corrected interval, for the mechanization's two-sample terms. Throws as nav::Strapdown does, and
  /// std::invalid_argument unless the covariance is of the layout that the parameters choose.
  InertialFilter(const NavigationParameters& parameters, const nav::Gravity& gravity, const nav::NavState& start,
                 const Estimates& errors, const Covariance& covariance, std::int64_t time_ns,
                 const std::optional<nav::ImuIncrements>& before);
  /// Without knowledge of sensor errors, each error for itself.
  InertialFilter(const NavigationParameters& parameters, const nav::Gravity& gravity, const nav::NavState& start,
                 const StateVector& sigmas, std::int64_t time_ns, const std::optional<nav::ImuIncrements>& before)
      : InertialFilter(parameters, gravity, start, Estimates(), Covariance(sigmas), time_ns, before) {}

  /// Goes on over one interval, which begins where the last ended.
  void advance(const ImuInterval& interval);

  /// What measurements that are valid at time_ns() are predicted from.
  Situation situation() const;

  /// Takes in what was measured at time_ns(), predicted from situation(). Each measurement is refused when it is beyond
  /// its gate, by the state before any of them; those that pass correct the state together.
  UpdateResult update(const std::vector<Measurement>& measurements);

  /// Brings the covariance up to the state's time; advance() does it every covariance interval.
  void settle();

  std::int64_t time_ns() const { return time_ns_; }
  nav::NavState state() const { return strapdown_.state(); }
  const Estimates& estimates() const { return estimates_; }
  const StateLayout& layout() const { return layout_; }
  /// At the last settle().
  const Covariance& covariance() const { return covariance_; }
  /// Of the newest receiver's position that was accepted; the start's time before any.
  std::int64_t last_accepted_ns() const { return last_accepted_ns_; }

  /// The transition that the next settle() would make, for tests.
  Transition transition() const;

 private:
  struct Noise {
    Vector3 gyro_density;        ///< rad^2/s
    Vector3 accel_density;       ///< (m/s)^2/s
    ChosenVector sigma;          ///< of the chosen states
    ChosenVector decay_rate;     ///< 1/T, 1/s; 0: constant
    double unknown_bias = 0.0;   ///< (m/s^2)^2, of accelerometers whose bias the state lacks
    double unknown_scale = 0.0;  ///< the same of their scale factor, of 1
    nav::GravityAlongWay gravity;
  };
  /// Integrals over the time since the covariance was settled.
  struct Sums {
    double dt_s = 0.0;
    Vector3 v_n_start = Vector3::Zero();
    Matrix3 C_nb_dt = Matrix3::Zero();
    Matrix3 C_nb_dtheta = Matrix3::Zero();  ///< columns times the increments' components
    Matrix3 C_nb_dv = Matrix3::Zero();
    Matrix3 attitude_noise = Matrix3::Zero();
    Matrix3 velocity_noise = Matrix3::Zero();
  };

  /// What the mechanization says of a time that feels like rest.
  struct Rest {
    Vector3 window_gain_n = Vector3::Zero();  ///< of velocity, since the detector's window began, m/s
    double window_s = 0.0;
    double window_intervals = 0.0;
    Vector3 window_squares_n = Vector3::Zero();  ///< of the gains of its intervals, (m/s)^2
    Vector3 gain_n = Vector3::Zero();            ///< the same since rest began, or began to be looked at anew
    double span_s = 0.0;
    double updates = 0.0;  ///< taken since it began
    /// Windows since the last update that wait for the next one.
    Vector3 held_gain_n = Vector3::Zero();
    Vector3 held_variance_n = Vector3::Zero();
    double held_s = 0.0;
    double held_windows = 0.0;
    /// What the receiver says of the IMU's velocity meanwhile, forgotten by and by: sums of 1/sigma^2 and v/sigma^2.
    Vector3 information = Vector3::Zero();
    Vector3 weighted_v_n = Vector3::Zero();
    std::optional<nav::Geodetic> first_place;  ///< of the IMU, by the first fix
    Vector3 first_variance = Vector3::Zero();  ///< m^2, n
    double displacement = 0.0;                 ///< of the newest fix from it, squared, over its variance
    double doubted_s = 0.0;                    ///< for so long yet nothing may speak against it
  };

  static Noise noise_of(const NavigationParameters& parameters, const StateLayout& layout);
  void note_motion(const Vector3& v_b_begin, std::int64_t end_ns);
  nav::ImuIncrements corrected(const nav::ImuIncrements& increments) const;
  nav::ImuIncrements felt(const nav::ImuIncrements& increments, const nav::Quaternion& q_nb) const;
  void go_along(const nav::WayStep& way);
  double squared_normalised(const Measurement& measurement) const;
  void take(const Measurement& measurement, StateVector& x);
  void rest();
  bool is_contradicted() const;
  void doubt_rest();
  void hear_at_rest(const Measurement& measurement);
  Measurement gain_of_velocity(const Vector3& gain_n, double span_s) const;
  bool gains_velocity(const Vector3& gain_n, double span_s) const;
  bool waits_for_the_next_window();
  void correct(const StateVector& x);
  void recover(const Measurement& position, const Measurement* velocity);

  // The parts of the parameters that every step needs.
  StateLayout layout_;
  Noise noise_;
  Vector3 lever_arm_b_m_;
  InnovationTest innovation_test_;
  ZeroVelocity zero_velocity_;
  Coasting coasting_;
  double covariance_interval_s_;

  nav::Gravity gravity_;
  nav::Strapdown strapdown_;
  Covariance covariance_;
  Estimates estimates_;
  nav::ImuIncrements newest_;           ///< corrected
  std::optional<RecentMotion> recent_;  ///< where a measurement of an interval may ask for it
  Sums sums_;
  Rest rest_;
  std::int64_t time_ns_;
  std::int64_t last_accepted_ns_;
  std::uint32_t rejections_ = 0;
};

}  // namespace inslab::navigation
