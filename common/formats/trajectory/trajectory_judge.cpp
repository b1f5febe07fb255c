#include "inslab/formats/trajectory/trajectory_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "inslab/foundation/fields/limits.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/position_spline.hpp"

namespace inslab::trajectory {

namespace {

/// Short enough to find where, long enough that the rounding of positions (0.1 mm of height, rows 0.5 ms apart) counts
/// for nothing.
constexpr time::Nanoseconds kWindow = std::chrono::seconds(1);

double seconds_between(const TrajectoryFile& file, std::size_t from, std::size_t to) {
  return time::to_seconds(file.rows[to].time - file.rows[from].time);
}

nav::Vector3 displacement_n(const TrajectoryFile& file, std::size_t row) {
  return nav::ned_from(file.rows[row - 1].position, file.rows[row].position);
}

class Judge {
 public:
  Judge(TrajectoryReading& reading, const TrajectoryLimits& limits)
      : reading_(reading), file_(reading.file), limits_(limits) {
    figures_.shortest_interval_s = seconds_between(file_, 0, 1);
  }

  void row(std::size_t k) {
    const double dt = seconds_between(file_, k - 1, k);
    interval(k, dt);
    if (file_.rows[k].v_n) {
      const nav::Vector3 step = unexplained_step_n(file_, k);
      position_step(k, dt, step);
      mismatch(k, step);
      acceleration(k, (*file_.rows[k].v_n - *file_.rows[k - 1].v_n).norm() / dt, "velocity");
      figures_.fastest_m_per_s = std::max(figures_.fastest_m_per_s, file_.rows[k].v_n->norm());
    } else {
      figures_.fastest_m_per_s = std::max(figures_.fastest_m_per_s, displacement_n(file_, k).norm() / dt);
    }
    if (file_.rows[k].rpy) attitude(k, dt);
  }

  /// Without velocities the vehicle follows the curve through the positions, and feels what the curve does between
  /// the rows: its second derivative is linear from row to row, so it is largest at one of them.
  void curve() {
    std::vector<nav::Geodetic> points;
    std::vector<double> intervals_s;
    for (std::size_t k = 0; k < file_.rows.size(); ++k) {
      points.push_back(file_.rows[k].position);
      if (k > 0) intervals_s.push_back(seconds_between(file_, k - 1, k));
    }
    const nav::PositionSpline spline(std::move(points), std::move(intervals_s), {});
    for (std::size_t k = 0; k <= spline.pieces(); ++k) {
      const nav::Vector3 of_curve = curve_at(spline, k);
      acceleration(k, of_curve.norm(), "position");
      largest_of_curve_ = largest_of_curve_.cwiseMax(of_curve.cwiseAbs());
    }
  }

  /// What the decimals of the positions can do, beside what the motion does over a second.
  void rounding() {
    const std::size_t last = file_.rows.size() - 1;
    const double dt = seconds_between(file_, 0, last) / static_cast<double>(last);
    const nav::Vector3 by_rounding = 2.0 * reading_.step_ned_m / (dt * dt);
    const nav::Vector3 of_motion = motion_over_a_second(std::max<std::size_t>(1, std::llround(1.0 / dt)));
    constexpr double kFelt = 0.1;  // m/s^2: 10 mg, which the least of IMUs feels
    for (int i = 0; i < 3; ++i) {
      const double least = std::max(kFelt, of_motion[i]);
      const bool is_more = by_rounding[i] > least && largest_of_curve_[i] > least;  // and the curve does have it
      figures_.rounding_m_per_s2[i] = is_more ? by_rounding[i] : 0.0;
    }
  }

  const TrajectoryFigures& figures() const { return figures_; }

 private:
  void measure(Worst& worst, double value, std::size_t row, double limit, Rule rule, Quantity at,
               const std::string& what, const std::string& unit) {
    if (value > worst.value) worst = {value, row};
    if (value <= limit) return;
    figures_.faults.push_back({rule, at, row});
    reading_.problems.add({rule, reading_.place(row, at),
                           what + " " + rounded(value) + unit + "; expected at most " + rounded(limit) + unit});
  }

  /// As many digits as a person needs.
  static std::string rounded(double value) { return number_text(std::round(value * 1e4) / 1e4); }

  Quantity clock() const { return reading_.columns.has(Quantity::Time) ? Quantity::Time : Quantity::SecondOfWeek; }

  /// The column of the component that is to blame most.
  static Quantity largest(const nav::Vector3& v, Quantity first) {
    Eigen::Index index = 0;
    v.cwiseAbs().maxCoeff(&index);
    return static_cast<Quantity>(static_cast<std::size_t>(first) + static_cast<std::size_t>(index));
  }

  void interval(std::size_t k, double dt) {
    figures_.shortest_interval_s = std::min(figures_.shortest_interval_s, dt);
    measure(figures_.longest_interval_s, dt, k, limits_.max_gap_s, Rule::FileGap, clock(), "follows after a gap of",
            " s");
  }

  void position_step(std::size_t k, double dt, const nav::Vector3& step) {
    const double limit = limits_.max_position_step_m + limits_.max_velocity_mismatch_m_per_s * dt;
    measure(figures_.position_step_m, step.norm(), k, limit, Rule::FileStep, largest(step, Quantity::Latitude),
            "the position jumps against the velocity by", " m");
  }

  /// Mean over the latest rows that span the window: what the steps of all of them add up to.
  void mismatch(std::size_t k, const nav::Vector3& step) {
    window_sum_ += step;
    window_steps_.push_back(step);
    // Dropped from the front as long as the rest still spans the window.
    while (first_ + 1 < k && file_.rows[k].time - file_.rows[first_ + 1].time >= kWindow) {
      window_sum_ -= window_steps_[first_ - steps_before_];
      ++first_;
    }
    if (first_ - steps_before_ > kSpareSteps) forget_steps();
    const double span = seconds_between(file_, first_, k);
    if (file_.rows[k].time - file_.rows[first_].time < kWindow && k + 1 < file_.rows.size()) return;
    const nav::Vector3 mean = window_sum_ / std::max(span, time::to_seconds(kWindow));
    // One contradiction stays in the window for a second; it is told once, and a fault of all of it.
    const bool is_told = std::exchange(contradicts_, mean.norm() > limits_.max_velocity_mismatch_m_per_s);
    if (is_told && contradicts_) figures_.faults.push_back({Rule::FileVelocity, Quantity::VelocityNorth, k});
    measure(figures_.velocity_mismatch_m_per_s, mean.norm(), k,
            is_told ? std::numeric_limits<double>::infinity() : limits_.max_velocity_mismatch_m_per_s,
            Rule::FileVelocity, largest(mean, Quantity::VelocityNorth),
            "over the last " + rounded(span) + " s the velocity contradicts the positions by", " m/s");
  }

  /// Keeps the memory of the window in proportion to the window, and its sum free of the rounding of all before.
  void forget_steps() {
    window_steps_.erase(window_steps_.begin(),
                        window_steps_.begin() + static_cast<std::ptrdiff_t>(first_ - steps_before_));
    steps_before_ = first_;
    window_sum_.setZero();
    for (const nav::Vector3& step : window_steps_) window_sum_ += step;
  }

  void acceleration(std::size_t k, double value, const std::string& of) {
    measure(figures_.acceleration_m_per_s2, value, k, limits_.max_acceleration_m_per_s2, Rule::FileStep,
            of == "velocity" ? Quantity::VelocityNorth : Quantity::Latitude, "the " + of + " means an acceleration of",
            " m/s^2");
  }

  static nav::Vector3 curve_at(const nav::PositionSpline& spline, std::size_t row) {
    if (row < spline.pieces()) return spline.piece(row).second_k(0.0);
    return spline.piece(row - 1).second_k(spline.interval(row - 1));
  }

  /// The largest change of velocity of each axis over so many rows to each side, for each second: what is left of a
  /// motion when its rows are that far apart.
  nav::Vector3 motion_over_a_second(std::size_t rows) const {
    nav::Vector3 largest = nav::Vector3::Zero();
    for (std::size_t k = rows; k + rows < file_.rows.size(); ++k) {
      const double before_s = seconds_between(file_, k - rows, k), after_s = seconds_between(file_, k, k + rows);
      const nav::Geodetic& here = file_.rows[k].position;
      const nav::Vector3 v_before = -nav::ned_from(here, file_.rows[k - rows].position) / before_s;
      const nav::Vector3 v_after = nav::ned_from(here, file_.rows[k + rows].position) / after_s;
      largest = largest.cwiseMax(((v_after - v_before) / (0.5 * (before_s + after_s))).cwiseAbs());
    }
    return largest;
  }

  void attitude(std::size_t k, double dt) {
    const nav::RollPitchYaw& rpy = *file_.rows[k].rpy;
    const double angle_rad =
        nav::angle_between(nav::quaternion_from_rpy(*file_.rows[k - 1].rpy), nav::quaternion_from_rpy(rpy));
    measure(figures_.rate_deg_per_s, angle_rad / units::kDeg / dt, k, limits_.max_rate_deg_per_s, Rule::FileStep,
            Quantity::Roll, "the attitude turns from the row above at", " deg/s");
    if (!file_.rows[k].v_n || file_.rows[k].v_n->norm() <= kTrackSpeed) return;
    const nav::Vector3 nose_n = nav::matrix_from_rpy(rpy).col(0);
    const double off_rad = std::acos(std::clamp(nose_n.dot(file_.rows[k].v_n->normalized()), -1.0, 1.0));
    // At 180 deg nothing is judged, and the rounding of the cosine must not do it.
    const double limit = limits_.max_off_track_deg >= 180.0 ? 1e9 : limits_.max_off_track_deg;
    measure(figures_.off_track_deg, off_rad / units::kDeg, k, limit, Rule::FileOffTrack, Quantity::Yaw,
            "the nose points away from the velocity by", " deg");
  }

  static constexpr std::size_t kSpareSteps = 4096;

  TrajectoryReading& reading_;
  const TrajectoryFile& file_;
  const TrajectoryLimits& limits_;
  TrajectoryFigures figures_;
  std::size_t first_ = 0;                   ///< the row at which the window begins
  std::size_t steps_before_ = 0;            ///< window_steps_[0] is the step from this row to the next
  std::vector<nav::Vector3> window_steps_;  ///< m
  nav::Vector3 window_sum_ = nav::Vector3::Zero();
  bool contradicts_ = false;
  nav::Vector3 largest_of_curve_ = nav::Vector3::Zero();  ///< of each axis, m/s^2
};

}  // namespace

nav::Vector3 unexplained_step_n(const TrajectoryFile& file, std::size_t row) {
  const nav::Vector3 mean_v_n = 0.5 * (*file.rows[row - 1].v_n + *file.rows[row].v_n);
  return displacement_n(file, row) - mean_v_n * seconds_between(file, row - 1, row);
}

TrajectoryFigures judge_trajectory(TrajectoryReading& reading, const TrajectoryLimits& limits, bool stop_at_first) {
  Judge judge(reading, limits);
  for (std::size_t k = 1; k < reading.file.rows.size(); ++k) {
    judge.row(k);
    if (stop_at_first && !reading.problems.empty()) return judge.figures();
  }
  if (!reading.file.rows.front().v_n) {
    judge.curve();
    judge.rounding();
  }
  return judge.figures();
}

}  // namespace inslab::trajectory
