#include "inslab/referee/verify/spline_loop.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "inslab/data/samples/nav_state.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/trajectory/smooth_model.hpp"
#include "inslab/referee/verify/loop.hpp"
#include "inslab/referee/verify/row_spline.hpp"
#include "inslab/scenario/terrain_gravity.hpp"

namespace inslab::verify {

namespace {

constexpr double kLimit_m = 1e-3;
// Latitude and longitude in doubles place a point to 3e-9 m.
constexpr double kOnRow_m = 1e-8;
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
  DeviationFigures full;     ///< mechanized with the full rotation term, against the curve
  DeviationFigures printed;  ///< with (2-32) as printed
  double off_rows_m = 0.0;
  std::size_t rows_met = 0;
};

SplineLoop close_spline_loop(const TrajectoryFile& file, const nav::Gravity& gravity, const Subjects& subjects) {
  trajectory::SmoothModel truth(subjects.curve(file), "row", gravity, kRate, file.start);
  RowsPassed rows(file);
  const auto steps = static_cast<std::uint64_t>(file.rows.back().time / kRate.period());
  const std::vector<DeviationFigures> found =
      close_loop(truth, subjects.imu, gravity, {{subjects.mechanization, {true}}, {subjects.mechanization, {false}}},
                 kRate, steps, [&rows](const TruthState& now) {
                   rows.see(now);
                   return nav_state(now);
                 });
  return {found.front(), found.back(), rows.largest_m(), rows.met()};
}

std::string minutes(const TrajectoryFile& file) {
  return fmt::format("{:.1f}", time::to_seconds(file.rows.back().time) / 60.0);
}
std::string figure(double value) { return fmt::format("{:.2e}", value); }

/// The curve, looked at eight times a piece.
struct Shape {
  double swing_m = 0.0;          ///< largest distance from the straight lines between the rows
  double off_reference_m = 0.0;  ///< largest distance from the reference spline
};
Shape shape_of(const trajectory::Path& path, const RowSpline& reference) {
  Shape shape;
  for (std::size_t k = 0; k < path.pieces(); ++k) {
    const trajectory::PathPiece piece = path.piece(k);
    const double h = time::to_seconds(piece.end - piece.start);
    const nav::Vector3 chord = piece.curve.displacement_k(h);
    const RealMatrix C_ek = reference_earth::C_en(piece.curve.origin.latitude_rad, piece.curve.origin.longitude_rad);
    for (int j = 1; j <= 8; ++j) {
      const double x = j / 8.0;
      const nav::Vector3 here = piece.curve.displacement_k(x * h);
      shape.swing_m = std::max(shape.swing_m, (here - x * chord).norm());
      const RealVector expected = reference.displacement_e_m(k, static_cast<Real>(x * h));
      shape.off_reference_m =
          std::max(shape.off_reference_m, static_cast<double>((C_ek * here.cast<Real>() - expected).norm()));
    }
  }
  return shape;
}

}  // namespace

Table spline_table(const std::string& title, const std::vector<LoopCase>& cases, const time::Rate& row_rate,
                   const Subjects& subjects) {
  Table table{
      title,
      {"", "rows", "minutes", "off the rows m", "full term m", "limit", "as printed m", "velocity m/s", "attitude deg"},
      {},
      {"Largest distances: of the curve from its rows (limit 1e-8 m), and of mechanized increments from the "
       "curve, with the full rotation term and with (2-32) as printed; velocity and attitude with the full "
       "term."}};
  for (const LoopCase& one : cases) {
    const auto file = rows_as_written(one.trajectory, one.name, row_rate, one.duration);
    const nav::Gravity gravity = scenario::uniform_gravity(one.trajectory.gravity);
    const SplineLoop loop = close_spline_loop(*file, gravity, subjects);
    table.rows.push_back(
        {{one.name, std::to_string(file->rows.size()), minutes(*file), figure(loop.off_rows_m),
          figure(loop.full.position_max_m), figure(kLimit_m), figure(loop.printed.position_max_m),
          figure(loop.full.velocity_max_m_per_s), figure(loop.full.attitude_max_rad * units::kDegPerRad)},
         loop.rows_met == file->rows.size() && loop.off_rows_m <= kOnRow_m && loop.full.position_max_m <= kLimit_m});
  }
  return table;
}

Table spline_file_table(const std::vector<std::shared_ptr<const TrajectoryFile>>& files, const Subjects& subjects) {
  Table table{"Files as they are, spline",
              {"", "rows", "minutes", "off the rows m", "off the reference m", "off the lines m", "bound m",
               "full term m", "as printed m", "attitude deg"},
              {},
              {"Off the reference: from a spline through the same rows that is solved apart from the product's (limit "
               "1e-8 m, as for the rows). Off the lines: the curve's largest distance from the straight lines between "
               "the rows; bound: what the rows alone allow, whatever the curve. The rest is shown and not judged: what "
               "mechanized increments make of noise that a file's rows put between two of our samples."}};
  for (const auto& file : files) {
    const RowSpline reference(*file);
    const Shape shape = shape_of(*subjects.curve(*file).path, reference);
    const SplineLoop loop = close_spline_loop(*file, nav::Gravity(), subjects);
    const auto bound_m = static_cast<double>(reference.largest_swing_m());
    table.rows.push_back(
        {{file->name, std::to_string(file->rows.size()), minutes(*file), figure(loop.off_rows_m),
          figure(shape.off_reference_m), figure(shape.swing_m), figure(bound_m), figure(loop.full.position_max_m),
          figure(loop.printed.position_max_m), figure(loop.full.attitude_max_rad * units::kDegPerRad)},
         loop.off_rows_m <= kOnRow_m && shape.off_reference_m <= kOnRow_m && shape.swing_m <= bound_m + kOnRow_m});
  }
  return table;
}

}  // namespace inslab::verify
