#include "inslab/referee/verify/written_rows.hpp"

#include <unistd.h>

#include "inslab/data/json/config_error.hpp"
#include "inslab/formats/trajectory/trajectory_reader.hpp"

namespace inslab::verify {

WrittenRows::WrittenRows(const std::string& name)
    : name_(name),
      path_(std::filesystem::temp_directory_path() / ("inslab_" + std::to_string(getpid()) + "_" + name + ".nav")),
      text_(path_.string()) {}

WrittenRows::~WrittenRows() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

std::shared_ptr<const TrajectoryFile> WrittenRows::read() {
  text_.close();
  trajectory::TrajectoryReading reading = trajectory::read_trajectory(path_.string());
  if (!reading.problems.empty()) throw json::Error(path_.string(), reading.problems.kept().front());
  reading.file.name = name_;
  return std::make_shared<const TrajectoryFile>(std::move(reading.file));
}

}  // namespace inslab::verify
