#include "inslab/foundation/files/output_place.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>

#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/files_read.hpp"
#include "inslab/foundation/files/unfinished.hpp"

namespace inslab::files {

namespace {

std::atomic<OutputRule> rule_in_force{OutputRule::ReplaceAll};

/// Follows links: the file that a link names is the one to be replaced, and the link stays.
std::string resolved(const std::string& path) {
  std::error_code error;
  const auto target = std::filesystem::canonical(path, error);
  return error ? path : target.string();
}

bool is_something_else(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
}

/// Whoever writes a file holds its lock.
bool is_being_written(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool locked = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  return locked;
}

}  // namespace

void set_output_rule(OutputRule rule) { rule_in_force = rule; }

void check_output(const std::string& path) {
  const OutputRule rule = rule_in_force;
  struct stat status {};
  if (rule == OutputRule::ReplaceAll || ::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return;
  if (is_file_read(path)) {
    throw OutputRefused(path +
                        ": is an input of this command and is not replaced; expected another name for the output");
  }
  if (is_being_written(path)) throw OutputRefused(being_written(path));
  if (rule == OutputRule::ReplaceResults || status.st_size == 0) return;
  throw OutputRefused(path + ": is there already and is kept; --overwrite replaces it, another name leaves it");
}

std::string being_written(const std::string& path) {
  return path + ": another process is writing to it; expected another name for the output";
}

std::string fresh_file(const std::string& stem, const std::string& ending) {
  const std::filesystem::path folder = std::filesystem::path(stem).parent_path();
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) throw WriteError(folder.string(), "make the folder", error.value());
  for (unsigned count = 1;; ++count) {
    const std::string path = stem + (count == 1 ? "" : "-" + std::to_string(count)) + ending;
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    if (descriptor < 0 && errno == EEXIST) continue;
    if (descriptor < 0) throw WriteError(path, "create", errno);
    ::close(descriptor);
    return path;
  }
}

OutputPlace::OutputPlace(const std::string& path) : path_(path) {
  check_output(path);
  growing_ = resolved(path);
  if (is_something_else(growing_)) {
    committed_ = true;  // a pipe or a device takes no other name
    return;
  }
  static std::atomic<unsigned> count{0};
  const std::filesystem::path whole(growing_);
  growing_ = (whole.parent_path() / ("." + whole.filename().string() + "." + std::to_string(::getpid()) + "." +
                                     std::to_string(++count) + ".part"))
                 .string();
  note_unfinished(growing_);
}

OutputPlace::~OutputPlace() {
  if (committed_) return;
  std::remove(growing_.c_str());
  forget_unfinished(growing_);
}

void OutputPlace::commit() {
  if (committed_) return;
  const auto lock = hold_unfinished();
  if (std::rename(growing_.c_str(), resolved(path_).c_str()) != 0)
    throw WriteError(path_, "give the file its name", errno);
  forget_unfinished(growing_);
  committed_ = true;
}

}  // namespace inslab::files
