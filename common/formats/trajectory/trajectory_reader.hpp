#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/data/samples/trajectory_file.hpp"
#include "inslab/formats/trajectory/trajectory_columns.hpp"
#include "inslab/foundation/fields/violation.hpp"

namespace inslab::trajectory {

/// What is wrong with a file: how often each rule is broken, and the first few places of each.
class TrajectoryProblems {
 public:
  static constexpr std::uint64_t kKeptPerRule = 20;

  void add(Violation problem);
  bool empty() const { return kept_.empty(); }
  /// In the order in which they were found.
  const std::vector<Violation>& kept() const { return kept_; }
  const std::map<Rule, std::uint64_t>& counts() const { return counts_; }

 private:
  std::vector<Violation> kept_;
  std::map<Rule, std::uint64_t> counts_;
};

/// The rows of a file with where they stand in it.
struct TrajectoryReading {
  TrajectoryFile file;
  TextColumns columns;               ///< of a text; none for a log
  std::vector<std::uint64_t> lines;  ///< of each row: the line of a text, the message of a log, from 1
  TrajectoryProblems problems;
  nav::Vector3 step_ned_m = nav::Vector3::Zero();  ///< one in the last decimal of a text's positions; 0: not rounded

  bool is_log() const { return columns.size() == 0; }
  /// "line 12, column 6 (vn_mps)" for the column that holds the quantity; without one "line 12".
  std::string place(std::size_t row, Quantity quantity) const;
};

struct TrajectoryReadOptions {
  std::string columns;                       ///< names of the columns of a text that does not begin with them
  std::string topic = catalog::kTruth.name;  ///< of a log: TruthState or NavSolution
  bool stop_at_first = true;                 ///< false: bad rows are left out, and the problems say which
};

/// Reads a trajectory in one pass, in memory and time proportional to its rows; the kind is seen from the content:
///
/// - text with 11 columns (.nav): week, seconds of week, latitude deg, longitude deg, height m, v_N v_E v_D m/s,
///   roll pitch yaw deg; week 0 is an unknown one
/// - text with 7 columns (GNSS): seconds of week, latitude deg, longitude deg, height m, three standard deviations m;
///   with 13, velocity and its standard deviations follow
/// - text with named columns (formats/trajectory/trajectory_columns.hpp), separated by commas or spaces; the line of
/// names may be a
///   comment. Velocity and attitude may be missing.
/// - a receiver's log of NMEA 0183 sentences (formats/trajectory/trajectory_nmea.hpp)
/// - a log of a run (MCAP): the truth, or the solution of a navigation app while it navigates
///
/// Lines that are empty or begin with # or % are comments. Where no week is known, seconds of week that fall by more
/// than half a week begin the next one. Numbers, ranges, columns and the order of time are judged here, the rest by
/// formats/trajectory/trajectory_judge.hpp. Throws ReadError when the file cannot be read at all.
TrajectoryReading read_trajectory(const std::string& path, const TrajectoryReadOptions& options = {});

}  // namespace inslab::trajectory
