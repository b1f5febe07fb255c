#pragma once

#include <string>

namespace inslab::files {

/// What a process may do to regular files that are there already. Empty ones count as not there.
enum class OutputRule {
  ReplaceAll,      ///< anything: what a library does that nobody has told otherwise
  ReplaceResults,  ///< but not what this process has read (foundation/files/files_read.hpp)
  KeepResults,     ///< nothing: an output must have a place of its own
};

/// Set once by a program, before it works.
void set_output_rule(OutputRule rule);

/// Throws OutputRefused, saying what to do, when the rule forbids to write to this path, or, unless it allows anything,
/// when another process is writing to it (foundation/files/output_file.hpp).
void check_output(const std::string& path);
/// What OutputRefused says then.
std::string being_written(const std::string& path);

/// A file that was not there, made empty so that nobody else gets the name: STEM + ENDING, or else STEM-2 + ENDING, and
/// so on. Folders are made. Throws WriteError.
std::string fresh_file(const std::string& stem, const std::string& ending);

/// Where a result grows until it is whole: a file beside the one that was asked for, which takes its name in commit().
/// Until then, and for ever when something goes wrong, what was there before stays as it was. What is no regular file,
/// such as a pipe or /dev/stdout, is written to as it is.
class OutputPlace {
 public:
  /// Throws OutputRefused when the rule forbids the path.
  explicit OutputPlace(const std::string& path);
  ~OutputPlace();
  OutputPlace(const OutputPlace&) = delete;
  OutputPlace& operator=(const OutputPlace&) = delete;

  /// The path that was asked for, for messages.
  const std::string& path() const { return path_; }
  /// The file to write to.
  const std::string& growing() const { return growing_; }
  /// The result is whole and closed. Throws WriteError.
  void commit();

 private:
  std::string path_;
  std::string growing_;
  bool committed_ = false;
};

}  // namespace inslab::files
