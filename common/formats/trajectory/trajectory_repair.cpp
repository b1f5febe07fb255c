#include "inslab/formats/trajectory/trajectory_repair.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "inslab/foundation/fields/limits.hpp"
#include "inslab/foundation/units/units.hpp"

namespace inslab::trajectory {

namespace {

std::string rounded(double value) { return number_text(std::round(value * 1e3) / 1e3); }

class Repair {
 public:
  Repair(const TrajectoryReading& reading, const TrajectoryLimits& limits, const RepairBounds& bounds,
         std::vector<RepairNote>& notes)
      : reading_(reading), limits_(limits), bounds_(bounds), notes_(notes) {
    reading_.problems = {};
  }

  TrajectoryReading run() {
    if (rows().front().rpy) attitude_resets();
    if (rows().front().v_n) {
      position_steps();
      velocities();
    }
    gaps();
    return std::move(reading_);
  }

 private:
  std::vector<TrajectoryRow>& rows() { return reading_.file.rows; }
  double seconds(std::size_t from, std::size_t to) { return time::to_seconds(rows()[to].time - rows()[from].time); }
  std::string lines(std::size_t from, std::size_t to) const {
    const std::string unit = reading_.is_log() ? "message" : "line";
    const std::string first = std::to_string(reading_.lines[from]);
    return from == to ? unit + " " + first : unit + "s " + first + " to " + std::to_string(reading_.lines[to]);
  }

  /// The faults of one kind as the rows stand now.
  std::vector<std::size_t> faults(Rule rule, Quantity first, Quantity last) {
    return faults(limits_, rule, first, last);
  }
  std::vector<std::size_t> faults(const TrajectoryLimits& limits, Rule rule, Quantity first, Quantity last) {
    TrajectoryReading judged = reading_;
    std::vector<std::size_t> found;
    for (const TrajectoryFault& fault : judge_trajectory(judged, limits, false).faults) {
      if (fault.rule == rule && fault.at >= first && fault.at <= last) found.push_back(fault.row);
    }
    return found;
  }

  /// The row at which a spread ending at `row` begins: the fault before it, or max_spread_s earlier.
  std::size_t spread_begin(std::size_t after, std::size_t row) {
    std::size_t begin = row - 1;
    while (begin > after && seconds(begin - 1, row) <= bounds_.max_spread_s) --begin;
    return begin;
  }

  void attitude_resets() {
    const std::vector<std::size_t> resets = faults(Rule::FileStep, Quantity::Roll, Quantity::Yaw);
    std::size_t before = 0;
    for (std::size_t i = 0; i < resets.size();) {
      // Resets within a second are one: a filter that finds its attitude.
      const std::size_t first = resets[i];
      std::size_t last = resets[i];
      while (++i < resets.size() && seconds(last, resets[i]) <= 1.0) last = resets[i];
      attitude_reset(before, first, last);
      before = last;
    }
  }

  nav::Quaternion attitude(std::size_t row) { return nav::quaternion_from_rpy(*rows()[row].rpy); }

  void attitude_reset(std::size_t before, std::size_t first, std::size_t last) {
    const nav::Vector3 turn_rad =
        nav::rotation_vector_from_quaternion(attitude(first - 1).conjugate() * attitude(last));
    const std::string turned = rounded(turn_rad.norm() / units::kDeg) + " deg";
    if (first == last && turn_rad.norm() <= bounds_.max_turned_deg * units::kDeg) {
      const std::size_t begin = spread_begin(before, first);
      for (std::size_t k = begin; k < first; ++k) {
        const nav::Vector3 part_rad = share(begin, first, k) * turn_rad;
        rows()[k].rpy = nav::rpy_from_quaternion(attitude(k) * nav::quaternion_from_rotation_vector(part_rad));
      }
      note(true, lines(begin, first - 1) + ": an attitude reset of " + turned + " was spread over them");
      return;
    }
    double fastest = rows()[before].v_n ? 0.0 : std::numeric_limits<double>::infinity();
    for (std::size_t k = before; k < last && rows()[k].v_n; ++k) fastest = std::max(fastest, rows()[k].v_n->norm());
    if (fastest <= bounds_.max_standing_m_per_s) {
      for (std::size_t k = before; k < last; ++k) rows()[k].rpy = rows()[last].rpy;
      note(true, lines(before, last - 1) + ": the attitude before a reset of " + turned +
                     " was replaced by the one after it; the vehicle stood (at most " + rounded(fastest) + " m/s)");
      return;
    }
    note(false, lines(first, last) + ": an attitude reset of " + turned + " of a moving vehicle was left");
  }

  /// 0 at the beginning, 1 at the end, flat at both.
  double share(std::size_t begin, std::size_t end, std::size_t row) {
    return 0.5 * (1.0 - std::cos(units::kPi * seconds(begin, row) / seconds(begin, end)));
  }
  /// Its derivative, 1/s.
  double slope(std::size_t begin, std::size_t end, std::size_t row) {
    const double span_s = seconds(begin, end);
    return 0.5 * units::kPi / span_s * std::sin(units::kPi * seconds(begin, row) / span_s);
  }

  /// In a file with steps the small ones are of the same kind as those above the limit: what would be left of them
  /// would still contradict the velocity.
  void position_steps() {
    if (faults(Rule::FileStep, Quantity::Latitude, Quantity::Height).empty()) return;
    TrajectoryLimits tight = limits_;
    tight.max_position_step_m *= 0.25;
    tight.max_velocity_mismatch_m_per_s *= 0.25;
    std::size_t before = 0;
    for (const std::size_t k : faults(tight, Rule::FileStep, Quantity::Latitude, Quantity::Height)) {
      const nav::Vector3 step_n = unexplained_step_n(reading_.file, k);
      const std::size_t begin = spread_begin(before, k);
      for (std::size_t i = begin; i < k; ++i) {
        rows()[i].position = nav::displaced(rows()[i].position, share(begin, k, i) * step_n);
        *rows()[i].v_n += slope(begin, k, i) * step_n;
      }
      note(true, lines(begin, k - 1) + ": a position step of " + rounded(step_n.norm()) + " m was spread over them (" +
                     rounded(seconds(begin, k)) + " s)");
      before = k;
    }
  }

  void velocities() {
    std::vector<std::size_t> at = faults(Rule::FileVelocity, Quantity::VelocityNorth, Quantity::VelocityDown);
    const auto jumps = faults(Rule::FileStep, Quantity::VelocityNorth, Quantity::VelocityNorth);
    at.insert(at.end(), jumps.begin(), jumps.end());
    if (at.empty()) return;
    std::vector<bool> is_derived(rows().size(), false);
    for (const std::size_t k : at) {
      for (std::size_t i = k + 1; i-- > 0 && (i + 1 >= k || seconds(i, k) <= 1.0);) is_derived[i] = true;
      for (std::size_t i = k; i < rows().size() && seconds(k, i) <= 1.0; ++i) is_derived[i] = true;
    }
    std::size_t derived = 0;
    double largest = 0.0;
    for (std::size_t k = 0; k < rows().size(); ++k) {
      if (!is_derived[k]) continue;
      const std::size_t from = k == 0 ? 0 : k - 1;
      const std::size_t to = std::min(k + 1, rows().size() - 1);
      const nav::Vector3 v_n = nav::ned_from(rows()[from].position, rows()[to].position) / seconds(from, to);
      largest = std::max(largest, (v_n - *rows()[k].v_n).norm());
      rows()[k].v_n = v_n;
      ++derived;
    }
    note(true, std::to_string(derived) + " velocities that contradicted the positions or jumped, or were within a " +
                   "second of such, were derived from the positions; the largest change was " + rounded(largest) +
                   " m/s");
  }

  void gaps() {
    const std::vector<std::size_t> at = faults(Rule::FileGap, Quantity::Time, Quantity::SecondOfWeek);
    if (at.empty()) return;
    const double interval_s = median_interval_s();
    std::vector<TrajectoryRow> filled;
    std::vector<std::uint64_t> numbers;
    std::size_t next = 0;
    for (std::size_t k = 0; k < rows().size(); ++k) {
      if (next < at.size() && at[next] == k) {
        bridge(k, interval_s, filled);
        numbers.resize(filled.size(), reading_.lines[k]);
        ++next;
      }
      filled.push_back(rows()[k]);
      numbers.push_back(reading_.lines[k]);
    }
    rows() = std::move(filled);
    reading_.lines = std::move(numbers);
  }

  double median_interval_s() {
    std::vector<double> intervals;
    for (std::size_t k = 1; k < rows().size(); ++k) intervals.push_back(seconds(k - 1, k));
    const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
    std::nth_element(intervals.begin(), middle, intervals.end());
    return *middle;
  }

  /// Adds the rows between row k - 1 and row k.
  void bridge(std::size_t k, double interval_s, std::vector<TrajectoryRow>& out) {
    const TrajectoryRow& a = rows()[k - 1];
    const TrajectoryRow& b = rows()[k];
    const double gap_s = seconds(k - 1, k);
    const std::string where = lines(k - 1, k) + ": a gap of " + rounded(gap_s) + " s ";
    if (gap_s > bounds_.max_filled_gap_s || !a.v_n) {
      note(false, where + (a.v_n ? "was left: longer than " + rounded(bounds_.max_filled_gap_s) + " s"
                                 : "was left: without velocities nothing tells how the vehicle crossed it"));
      return;
    }
    // A cubic from a to b in NED at a, with the velocities at both ends (Hermite).
    const nav::Vector3 chord_n = nav::ned_from(a.position, b.position);
    const auto count = static_cast<std::int64_t>(std::llround(gap_s / interval_s));
    const nav::Vector3 turn_rad =
        a.rpy ? nav::rotation_vector_from_quaternion(attitude(k - 1).conjugate() * attitude(k)) : nav::Vector3::Zero();
    for (std::int64_t i = 1; i < count; ++i) {
      const double s = static_cast<double>(i) / static_cast<double>(count);
      const double r = 1.0 - s;
      TrajectoryRow row;
      row.time = a.time + time::from_seconds(s * gap_s);
      row.position =
          nav::displaced(a.position, s * s * (3.0 - 2.0 * s) * chord_n + gap_s * s * r * (r * *a.v_n - s * *b.v_n));
      row.v_n = 6.0 * s * r / gap_s * chord_n + r * (1.0 - 3.0 * s) * *a.v_n + s * (3.0 * s - 2.0) * *b.v_n;
      if (a.rpy) {
        row.rpy = nav::rpy_from_quaternion(attitude(k - 1) * nav::quaternion_from_rotation_vector(s * turn_rad));
      }
      out.push_back(row);
    }
    note(true, where + "was filled with " + std::to_string(count - 1) + " rows");
  }

  void note(bool is_repaired, std::string text) { notes_.push_back({is_repaired, std::move(text)}); }

  TrajectoryReading reading_;
  const TrajectoryLimits& limits_;
  const RepairBounds& bounds_;
  std::vector<RepairNote>& notes_;
};

}  // namespace

TrajectoryReading repaired(const TrajectoryReading& reading, const TrajectoryLimits& limits, const RepairBounds& bounds,
                           std::vector<RepairNote>& notes) {
  return Repair(reading, limits, bounds, notes).run();
}

}  // namespace inslab::trajectory
