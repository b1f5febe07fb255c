#include "inslab/formats/trajectory/trajectory_reader.hpp"

#include <array>

#include "inslab/formats/trajectory/trajectory_log.hpp"
#include "inslab/formats/trajectory/trajectory_nmea.hpp"
#include "inslab/formats/trajectory/trajectory_text.hpp"
#include "inslab/foundation/files/input_file.hpp"
#include "inslab/foundation/files/text_lines.hpp"

namespace inslab::trajectory {

void TrajectoryProblems::add(Violation problem) {
  if (++counts_[problem.rule] <= kKeptPerRule) kept_.push_back(std::move(problem));
}

std::string TrajectoryReading::place(std::size_t row, Quantity quantity) const {
  const std::string number = std::to_string(lines.at(row));
  if (is_log()) return "message " + number;
  const auto column = columns.find(quantity);
  if (!column) return "line " + number;
  return "line " + number + ", column " + std::to_string(*column + 1) + " (" + columns[*column].name + ")";
}

namespace {

/// Among the first lines that say something; the first one may have been cut where the recording began.
bool is_nmea(const std::string& path) {
  constexpr std::uint64_t kLinesLookedAt = 5;
  files::TextLines lines(path);
  for (std::string_view line; lines.number() < kLinesLookedAt && lines.next(line);) {
    if (is_nmea_sentence(files::trimmed(line))) return true;
  }
  return false;
}

TrajectoryReading read_text(const std::string& path, const TrajectoryReadOptions& options) {
  return is_nmea(path) ? read_trajectory_nmea(path, options) : read_trajectory_text(path, options);
}

}  // namespace

TrajectoryReading read_trajectory(const std::string& path, const TrajectoryReadOptions& options) {
  // The MCAP specification's magic, without the version.
  constexpr std::array<std::uint8_t, 5> kMcap{0x89, 'M', 'C', 'A', 'P'};
  std::array<std::uint8_t, kMcap.size()> beginning{};
  {
    const files::InputFile file(path);
    if (file.size() >= beginning.size()) file.read(0, beginning.data(), beginning.size());
  }
  TrajectoryReading reading = beginning == kMcap ? read_trajectory_log(path, options) : read_text(path, options);
  reading.file.name = path;
  if (reading.file.rows.size() < 2 && reading.problems.empty()) {
    reading.problems.add(
        {Rule::NotEmpty, "", "has " + std::to_string(reading.file.rows.size()) + " rows; expected at least 2"});
  }
  return reading;
}

}  // namespace inslab::trajectory
