#include "inslab/referee/verify/closed_loop_block.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "inslab/data/json/config_error.hpp"
#include "inslab/formats/trajectory/trajectory_reader.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/trajectory/file_states.hpp"
#include "inslab/models/trajectory/inverse_mechanization_model.hpp"
#include "inslab/referee/verify/catalogue.hpp"
#include "inslab/referee/verify/loop.hpp"
#include "inslab/referee/verify/spline_loop.hpp"
#include "inslab/scenario/terrain_gravity.hpp"

namespace inslab::verify {

namespace {

constexpr double kVelocityLimit_m_per_s = 1e-5;
constexpr double kAttitudeLimit_deg = 1e-6;
constexpr double kSmallestPositionLimit_m = 3e-5;
const time::Rate kRate(200.0);
const time::Rate kContradictoryRate(10.0);
constexpr time::Nanoseconds kHour = std::chrono::hours(1);

struct Published {
  const char* name;
  double position_m;
};
constexpr Published kTable42[] = {{"static", 0.0003}, {"basic", 0.0015},    {"vehicle", 0.0022},
                                  {"ship", 0.0003},   {"aircraft", 0.0005}, {"projectile", 0.0}};

std::string minutes(time::Nanoseconds duration) { return fmt::format("{:.1f}", time::to_seconds(duration) / 60.0); }
std::string figure(double value) { return fmt::format("{:.2e}", value); }

/// What the feedback leaves of a file's own contradiction, by the file alone: the largest solution of
/// e' = v - p' - feedback * e, without any mechanization.
double bound_of(const std::shared_ptr<const TrajectoryFile>& file, double feedback_per_s) {
  trajectory::FileStates rows(file);
  nav::NavState before = rows.at(time::Nanoseconds(0));
  nav::Vector3 error_m = nav::Vector3::Zero();
  double largest_m = 0.0;
  for (std::uint64_t k = 1; kRate.at(k) <= rows.end(); ++k) {
    const nav::NavState now = rows.at(kRate.at(k));
    error_m += kRate.period_s() * (0.5 * (before.v_n + now.v_n) - feedback_per_s * error_m) -
               nav::ned_from(before.position, now.position);
    largest_m = std::max(largest_m, error_m.norm());
    before = now;
  }
  return largest_m;
}

bool comes_back(const DeviationFigures& found, double limit_m) {
  return found.position_rms_m <= limit_m && (found.settled() || found.position_last_third_rms_m <= limit_m) &&
         found.velocity_max_m_per_s <= kVelocityLimit_m_per_s &&
         found.attitude_max_rad * units::kDegPerRad <= kAttitudeLimit_deg;
}

bool stays_within(const DeviationFigures& found, double bound_m) {
  return found.position_max_m <= bound_m && found.attitude_max_rad * units::kDegPerRad <= kAttitudeLimit_deg;
}

}  // namespace

double position_limit_m(const LoopCase& one) {
  return std::max(0.1 * one.published_position_m, kSmallestPositionLimit_m);
}

std::vector<LoopCase> loop_cases() {
  std::vector<LoopCase> cases;
  for (const Published& published : kTable42) {
    const scenario::Scenario scenario = catalogue_scenario(published.name);
    cases.push_back(
        {published.name, scenario.trajectory, published.position_m, time::from_seconds(scenario.duration_s)});
  }
  return cases;
}

Table inverse_mechanization_table(const std::string& title, const std::vector<LoopCase>& cases,
                                  const Subjects& subjects) {
  Table table{title,
              {"", "minutes", "RMS m", "independent m", "limit", "published", "largest m", "middle third", "last third",
               "velocity m/s", "attitude deg"},
              {},
              {"RMS, largest and thirds (RMS) of the position's error against the file; largest of velocity "
               "(limit 1e-5 m/s) and attitude (limit 1e-6 deg).",
               "Independent: the same increments by the two-sample algorithm written a second time, in long double, "
               "with an ellipsoid and gravity of its own; every limit holds for both. The inverse and the app's "
               "mechanization are of one class, and a wrong term of it would cancel between them."}};
  for (const LoopCase& one : cases) {
    const auto file = rows_as_written(one.trajectory, one.name, kRate, one.duration);
    const FileLoop loop = close_file_loop(file, scenario::uniform_gravity(one.trajectory.gravity), kRate, subjects);
    const DeviationFigures& found = loop.app;
    const double limit_m = position_limit_m(one);
    table.rows.push_back({{one.name, minutes(file->rows.back().time), figure(found.position_rms_m),
                           figure(loop.independent.position_rms_m), fmt::format("{:.1e}", limit_m),
                           fmt::format("{:.4f}", one.published_position_m), figure(found.position_max_m),
                           figure(found.position_middle_third_rms_m), figure(found.position_last_third_rms_m),
                           figure(found.velocity_max_m_per_s), figure(found.attitude_max_rad * units::kDegPerRad)},
                          comes_back(found, limit_m) && comes_back(loop.independent, limit_m)});
  }
  return table;
}

std::vector<LoopCase> for_an_hour(std::vector<LoopCase> cases) {
  std::vector<LoopCase> repeated;
  for (LoopCase& one : cases) {
    if (one.published_position_m == 0.0) continue;  // the projectile lands
    const std::vector<scenario::Segment> once = one.trajectory.segments;
    for (time::Nanoseconds length = one.duration; length < kHour; length += one.duration) {
      one.trajectory.segments.insert(one.trajectory.segments.end(), once.begin(), once.end());
    }
    one.duration = kHour;
    repeated.push_back(std::move(one));
  }
  return repeated;
}

std::shared_ptr<const TrajectoryFile> contradictory_rows(const LoopCase& one, time::Nanoseconds duration) {
  auto file =
      std::make_shared<TrajectoryFile>(*rows_as_written(one.trajectory, one.name, kContradictoryRate, duration));
  file->name += ", made to contradict itself";
  const std::size_t half_way = file->rows.size() / 2;
  for (std::size_t i = 0; i < file->rows.size(); ++i) {
    TrajectoryRow& row = file->rows[i];
    *row.v_n += nav::Vector3(0.03, -0.02, 0.01);
    const double jitter_m = i % 2 == 0 ? 0.02 : -0.02, step_m = i < half_way ? 0.0 : 0.5;
    row.position = nav::displaced(row.position, {jitter_m, step_m, -jitter_m});
  }
  return file;
}

Table contradiction_table(const std::vector<std::shared_ptr<const TrajectoryFile>>& files, const Subjects& subjects) {
  const double feedback_per_s = trajectory::InverseMechanizationModel::Options().position_feedback_per_s;
  Table table{
      "Files whose position and velocity contradict each other, inverse_mechanization",
      {"", "rows", "minutes", "RMS m", "largest m", "independent m", "bound m", "middle third", "last third",
       "velocity m/s", "attitude deg"},
      {},
      {fmt::format("Bound: what the position feedback of {}/s leaves of the file's own contradiction, "
                   "e' = v - p' - feedback e, and 1 % and 1 mm for the mechanization. Independent: the largest by the "
                   "second mechanization.",
                   feedback_per_s)}};
  for (const auto& file : files) {
    const FileLoop loop = close_file_loop(file, nav::Gravity(), kRate, subjects);
    const DeviationFigures& found = loop.app;
    const double bound_m = 1.01 * bound_of(file, feedback_per_s) + 1e-3;
    table.rows.push_back(
        {{file->name, std::to_string(file->rows.size()), minutes(file->rows.back().time), figure(found.position_rms_m),
          figure(found.position_max_m), figure(loop.independent.position_max_m), figure(bound_m),
          figure(found.position_middle_third_rms_m), figure(found.position_last_third_rms_m),
          figure(found.velocity_max_m_per_s), figure(found.attitude_max_rad * units::kDegPerRad)},
         stays_within(found, bound_m) && stays_within(loop.independent, bound_m)});
  }
  return table;
}

std::shared_ptr<const TrajectoryFile> real_rows(const std::string& path) {
  trajectory::TrajectoryReading reading = trajectory::read_trajectory(path);
  if (!reading.problems.empty()) throw json::Error(path, reading.problems.kept().front());
  const TrajectoryRow& first = reading.file.rows.front();
  if (!first.v_n || !first.rpy) {
    throw json::Error(path, {Rule::MethodNeeds, "", "has rows without velocity or attitude; expected both"});
  }
  reading.file.name = std::filesystem::path(path).filename().string();
  return std::make_shared<const TrajectoryFile>(std::move(reading.file));
}

std::vector<Table> closed_loop(const std::vector<std::string>& paths) {
  const std::vector<LoopCase> cases = loop_cases();
  const auto vehicle =
      std::find_if(cases.begin(), cases.end(), [](const LoopCase& one) { return one.name == "vehicle"; });
  std::vector<std::shared_ptr<const TrajectoryFile>> contradictory{contradictory_rows(*vehicle, vehicle->duration)};
  std::transform(paths.begin(), paths.end(), std::back_inserter(contradictory), real_rows);
  Table contradiction = contradiction_table(contradictory);
  if (paths.empty()) contradiction.notes.push_back("No real files: name them after --files.");
  return {inverse_mechanization_table("Files at 200 Hz, inverse_mechanization (thesis table 4-2)", cases),
          inverse_mechanization_table("The same for an hour, segments repeated", for_an_hour(cases)),
          spline_table("Files at 10 Hz, spline, mechanized at 200 Hz", cases, time::Rate(10.0)),
          spline_table("Files at 1 Hz, spline, mechanized at 200 Hz", cases, time::Rate(1.0)),
          contradiction,
          spline_file_table(contradictory)};
}

}  // namespace inslab::verify
