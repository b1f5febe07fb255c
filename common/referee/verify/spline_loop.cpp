#include "inslab/referee/verify/spline_loop.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "inslab/data/samples/nav_state.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/trajectory/row_motion.hpp"
#include "inslab/models/trajectory/smooth_model.hpp"
#include "inslab/referee/verify/loop.hpp"

namespace inslab::verify {

namespace {

constexpr double kLimit_m = 1e-3;
// Latitude and longitude in doubles place a point to 3e-9 m.
constexpr double kOnRow_m = 1e-8;
// A parabola reaches the bound, but for its rounding.
constexpr double kRounding = 1e-9;
const time::Rate kRate(200.0);

/// Holds the rows that the truth's grid meets against the truth.
class RowsPassed {
 public:
  explicit RowsPassed(const TrajectoryFile& file) : file_(file) {}

  void see(const TruthState& truth) {
    const time::Nanoseconds now(truth.header.sim_time_ns);
    while (row_ < file_.rows.size() && file_.rows[row_].time < now) ++row_;
    if (row_ == file_.rows.size() || file_.rows[row_].time != now) return;
    const nav::NavState here = nav_state(truth);
    largest_m_ = std::max(largest_m_, nav::ned_from(file_.rows[row_].position, here.position).norm());
    ++met_;
  }

  double largest_m() const { return largest_m_; }
  std::size_t met() const { return met_; }

 private:
  const TrajectoryFile& file_;
  std::size_t row_ = 0;
  std::size_t met_ = 1;  ///< the start is the first row
  double largest_m_ = 0.0;
};

struct SplineLoop {
  DeviationFigures mechanized;  ///< against the curve
  double off_rows_m = 0.0;
  std::size_t rows_met = 0;
};

SplineLoop close_spline_loop(const TrajectoryFile& file, const nav::Gravity& gravity, bool full_rotation_term) {
  trajectory::SmoothModel truth(trajectory::motion_through(file, {}), "row", gravity, kRate, file.start);
  nav::Strapdown::Options options;
  options.full_rotation_term = full_rotation_term;
  RowsPassed rows(file);
  SplineLoop loop;
  const auto steps = static_cast<std::uint64_t>(file.rows.back().time / kRate.period());
  loop.mechanized = close_loop(truth, gravity, options, kRate, steps, [&rows](const TruthState& now) {
    rows.see(now);
    return nav_state(now);
  });
  loop.off_rows_m = rows.largest_m();
  loop.rows_met = rows.met();
  return loop;
}

nav::Gravity gravity_of(const scenario::Trajectory& trajectory) {
  const scenario::GravityOptions& options = trajectory.gravity;
  return nav::Gravity(options.model,
                      {options.disturbance_mgal, options.deflection_north_arcsec, options.deflection_east_arcsec});
}

std::string minutes(const TrajectoryFile& file) {
  return fmt::format("{:.1f}", time::to_seconds(file.rows.back().time) / 60.0);
}
std::string figure(double value) { return fmt::format("{:.2e}", value); }

/// The largest distance of the curve from the straight lines between its rows, and the largest that the curve's own
/// second derivatives at the rows allow: h^2/8 of the larger of the two, since a cubic's is linear in between.
struct Swing {
  double largest_m = 0.0;
  double bound_m = 0.0;
};
Swing swing_of(const trajectory::Path& path) {
  Swing swing;
  for (std::size_t k = 0; k < path.pieces(); ++k) {
    const trajectory::PathPiece piece = path.piece(k);
    const double h = time::to_seconds(piece.end - piece.start);
    const nav::Vector3 chord = piece.curve.displacement_k(h);
    for (int j = 1; j < 8; ++j) {
      const double x = j / 8.0;
      swing.largest_m = std::max(swing.largest_m, (piece.curve.displacement_k(x * h) - x * chord).norm());
    }
    const double bend = std::max(piece.acceleration_k(0.0).norm(), piece.acceleration_k(h).norm());
    swing.bound_m = std::max(swing.bound_m, h * h / 8.0 * bend * (1.0 + kRounding));
  }
  return swing;
}

}  // namespace

Table spline_table(const std::string& title, const std::vector<LoopCase>& cases, const time::Rate& row_rate) {
  Table table{
      title,
      {"", "rows", "minutes", "off the rows m", "full term m", "limit", "as printed m", "velocity m/s", "attitude deg"},
      {},
      {"Largest distances: of the curve from its rows (limit 1e-8 m), and of mechanized increments from the "
       "curve, with the full rotation term and with (2-32) as printed; velocity and attitude with the full "
       "term."}};
  for (const LoopCase& one : cases) {
    const auto file = rows_as_written(one.trajectory, one.name, row_rate, one.duration);
    const nav::Gravity gravity = gravity_of(one.trajectory);
    const SplineLoop full = close_spline_loop(*file, gravity, true);
    const SplineLoop printed = close_spline_loop(*file, gravity, false);
    table.rows.push_back(
        {{one.name, std::to_string(file->rows.size()), minutes(*file), figure(full.off_rows_m),
          figure(full.mechanized.position_max_m), figure(kLimit_m), figure(printed.mechanized.position_max_m),
          figure(full.mechanized.velocity_max_m_per_s), figure(full.mechanized.attitude_max_rad * units::kDegPerRad)},
         full.rows_met == file->rows.size() && full.off_rows_m <= kOnRow_m &&
             full.mechanized.position_max_m <= kLimit_m});
  }
  return table;
}

Table spline_file_table(const std::vector<std::shared_ptr<const TrajectoryFile>>& files) {
  Table table{"Files as they are, spline",
              {"", "rows", "minutes", "off the lines m", "bound m", "full term m", "as printed m", "attitude deg"},
              {},
              {"Off the lines: the curve's largest distance from the straight lines between the rows; bound: an eighth "
               "of the interval squared times the larger acceleration at its ends. The rest: what mechanized "
               "increments make of noise that a file's rows put between two of our samples."}};
  for (const auto& file : files) {
    const Swing swing = swing_of(*trajectory::motion_through(*file, {}).path);
    const SplineLoop full = close_spline_loop(*file, nav::Gravity(), true);
    const SplineLoop printed = close_spline_loop(*file, nav::Gravity(), false);
    table.rows.push_back(
        {{file->name, std::to_string(file->rows.size()), minutes(*file), figure(swing.largest_m), figure(swing.bound_m),
          figure(full.mechanized.position_max_m), figure(printed.mechanized.position_max_m),
          figure(full.mechanized.attitude_max_rad * units::kDegPerRad)},
         swing.largest_m <= swing.bound_m && full.off_rows_m <= kOnRow_m});
  }
  return table;
}

}  // namespace inslab::verify
