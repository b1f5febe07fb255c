#include "inslab/referee/check/trajectory_check.hpp"

#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "inslab/data/json/json_reader.hpp"
#include "inslab/formats/recordings/nav_text.hpp"

namespace inslab::check {

namespace {

template <class... Arguments>
void say(std::string& text, fmt::format_string<Arguments...> pattern, Arguments&&... arguments) {
  fmt::format_to(std::back_inserter(text), pattern, std::forward<Arguments>(arguments)...);
}

/// "max_gap_s=5" ... as the scenario's trajectory.file.limits has them.
TrajectoryLimits limits_from(const std::vector<std::string>& settings) {
  json::Json json = json::Json::object();
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) {
      throw json::Error("--limit", {Rule::ValueType, "", "is '" + setting + "'; expected NAME=VALUE"});
    }
    json[setting.substr(0, equals)] = json::parse_json(setting.substr(equals + 1), "--limit " + setting);
  }
  return json::struct_from_json<TrajectoryLimits>(json, "--limit");
}

/// What repairing a broken rule would take.
const char* remedy(Rule rule) {
  switch (rule) {
    case Rule::FileGap:
      return "up to 30 s can be bridged when there are velocities; or raise max_gap_s";
    case Rule::FileVelocity:
      return "velocities can be derived from the positions";
    case Rule::FileStep:
      return "steps of position and small resets of attitude can be spread over the time before; the attitude before a "
             "large reset can be replaced while the vehicle stands";
    case Rule::FileOffTrack:
      return "nothing tells which is right, nose or velocity: raise max_off_track_deg if the vehicle moves so";
    case Rule::FileTime:
    case Rule::ValueType:
    case Rule::ValueRange:
      return "the rows can be left out";
    default:
      return "not repairable: the file must be made anew";
  }
}

void say_problems(std::string& text, const trajectory::TrajectoryProblems& problems) {
  for (const auto& [rule, count] : problems.counts()) {
    say(text, "  {} x {}: {}\n", count, enum_name(rule), remedy(rule));
    std::uint64_t shown = 0;
    for (const Violation& problem : problems.kept()) {
      if (problem.rule != rule) continue;
      say(text, "    {}{}{}\n", problem.path, problem.path.empty() ? "" : ": ", problem.reason);
      ++shown;
    }
    if (shown < count) say(text, "    and {} more\n", count - shown);
  }
}

void say_figures(std::string& text, const trajectory::TrajectoryReading& reading,
                 const trajectory::TrajectoryFigures& figures) {
  const auto at = [&reading](const trajectory::Worst& worst) {
    return fmt::format("({} {})", reading.is_log() ? "message" : "line", reading.lines.at(worst.row));
  };
  const auto& rows = reading.file.rows;
  say(text, "  {} rows over {:.3f} s, {} to {:.6g} s apart {}; velocity: {}; attitude: {}\n", rows.size(),
      time::to_seconds(rows.back().time), fmt::format("{:.6g}", figures.shortest_interval_s),
      figures.longest_interval_s.value, at(figures.longest_interval_s), rows.front().v_n ? "yes" : "no",
      rows.front().rpy ? "yes" : "no");
  say(text, "  fastest {:.4g} m/s; largest acceleration {:.4g} m/s^2 {}\n", figures.fastest_m_per_s,
      figures.acceleration_m_per_s2.value, at(figures.acceleration_m_per_s2));
  if (rows.front().v_n) {
    say(text, "  velocity against positions: {:.4g} m/s over a second {}, {:.4g} m from row to row {}\n",
        figures.velocity_mismatch_m_per_s.value, at(figures.velocity_mismatch_m_per_s), figures.position_step_m.value,
        at(figures.position_step_m));
  }
  if (rows.front().rpy) {
    say(text, "  attitude: {:.4g} deg/s from row to row {}, nose off the track by {:.4g} deg {}\n",
        figures.rate_deg_per_s.value, at(figures.rate_deg_per_s), figures.off_track_deg.value,
        at(figures.off_track_deg));
  }
}

/// Of rows without velocities, where the rounding of their numbers is more than the motion.
void say_rounding(std::string& text, const trajectory::TrajectoryReading& reading,
                  const trajectory::TrajectoryFigures& figures) {
  constexpr const char* kColumns[] = {"latitudes", "longitudes", "heights"};
  for (int i = 0; i < 3; ++i) {
    if (figures.rounding_m_per_s2[i] == 0.0) continue;
    say(text,
        "  WARNING: the {} are rounded to {:.3g} m, which can be up to {:.3g} m/s^2 from row to row, more than the "
        "motion: an IMU will feel it; give more decimals, or rows further apart\n",
        kColumns[i], reading.step_ned_m[i], figures.rounding_m_per_s2[i]);
  }
}

/// Says what the rows are like and what is wrong with them; true when nothing is.
bool judge(std::string& text, trajectory::TrajectoryReading& reading, const TrajectoryLimits& limits) {
  if (reading.file.rows.size() >= 2) {
    const trajectory::TrajectoryFigures figures = trajectory::judge_trajectory(reading, limits, false);
    say_figures(text, reading, figures);
    say_rounding(text, reading, figures);
  }
  say_problems(text, reading.problems);
  return reading.problems.empty();
}

void write_rows(const TrajectoryFile& file, const std::string& destination) {
  recordings::NavTextWriter out(destination);
  for (const TrajectoryRow& row : file.rows) out.write(file.start + row.time, row);
  out.close();
}

bool repair(std::string& text, const trajectory::TrajectoryReading& reading, const TrajectoryLimits& limits,
            const std::string& destination) {
  if (reading.file.rows.size() < 2 || !reading.file.rows.front().v_n || !reading.file.rows.front().rpy) {
    say(text, "not repaired: the 11 columns that are written need two rows or more with velocity and attitude\n");
    return false;
  }
  std::vector<trajectory::RepairNote> notes;
  trajectory::TrajectoryReading mended = trajectory::repaired(reading, limits, trajectory::RepairBounds{}, notes);
  for (const trajectory::RepairNote& note : notes)
    say(text, "{}: {}\n", note.is_repaired ? "changed" : "left", note.text);
  for (const auto& [rule, count] : reading.problems.counts()) {
    if (rule == Rule::FileTime || rule == Rule::ValueType || rule == Rule::ValueRange || rule == Rule::FileColumns) {
      say(text, "changed: {} rows that could not be read were left out ({})\n", count, enum_name(rule));
    }
  }
  write_rows(mended.file, destination);
  say(text, "{}: after the repair\n", destination);
  const bool is_good = judge(text, mended, limits);
  say(text, "{}\n", is_good ? "good" : "NOT good: what is left must be judged by hand");
  return is_good;
}

}  // namespace

TrajectoryChecked check_trajectory(const TrajectoryCheckOptions& options) {
  const TrajectoryLimits limits = limits_from(options.limits);
  trajectory::TrajectoryReading reading =
      trajectory::read_trajectory(options.file, {options.columns, options.topic, false});
  TrajectoryChecked checked;
  say(checked.text, "{}:\n", options.file);
  checked.is_good = judge(checked.text, reading, limits);
  say(checked.text, "{}\n", checked.is_good ? "good" : "NOT good");
  if (!options.repair.empty()) checked.is_good = repair(checked.text, reading, limits, options.repair);
  return checked;
}

}  // namespace inslab::check
