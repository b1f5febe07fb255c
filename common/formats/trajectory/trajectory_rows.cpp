#include "inslab/formats/trajectory/trajectory_rows.hpp"

#include "inslab/foundation/fields/limits.hpp"
#include "inslab/foundation/files/input_limits.hpp"

namespace inslab::trajectory {

void TrajectoryRows::add(std::uint64_t line, time::Nanoseconds time, const time::GpsTime& start, TrajectoryRow row) {
  TrajectoryFile& file = reading_->file;
  if (file.rows.size() == files::kMaxRowsInMemory) {
    if (!is_full_) {
      reading_->problems.add({Rule::BoundedSize, (reading_->is_log() ? "message " : "line ") + std::to_string(line),
                              "is one row too many; expected at most " + std::to_string(files::kMaxRowsInMemory)});
    }
    is_full_ = true;
    return;
  }
  if (file.rows.empty()) {
    first_ = time;
    file.start = start;
  }
  row.time = time - first_;
  file.rows.push_back(row);
  reading_->lines.push_back(line);
  if (file.rows.size() < 2) return;
  const std::size_t last = file.rows.size() - 1;
  const time::Nanoseconds before = file.rows[last - 1].time;
  if (row.time > before) return;
  const Quantity clock = reading_->columns.has(Quantity::Time) ? Quantity::Time : Quantity::SecondOfWeek;
  reading_->problems.add({Rule::FileTime, reading_->place(last, clock),
                          "lies " + number_text(time::to_seconds(before - row.time)) +
                              " s before the row above it; expected time to increase"});
  file.rows.pop_back();
  reading_->lines.pop_back();
}

}  // namespace inslab::trajectory
