#pragma once

#include <filesystem>

#include "inslab/referee/montecarlo/run_result.hpp"
#include "inslab/referee/montecarlo/study.hpp"

namespace inslab::montecarlo {

/// Where the results of a study stand: study.json, which says what the study is, and run_K.json for each run. Files
/// appear whole or not at all, so that processes may be killed at any time, and several may work in one folder.
class ResultFolder {
 public:
  /// Makes the folder and its study.json when they are not there. Throws files::ReadError, naming what differs, when
  /// the folder belongs to another study; files::WriteError.
  ResultFolder(const std::string& path, const Study& study);

  /// Nothing when there is no result, or one that no program of ours has written: the run is to be done. Throws
  /// files::ReadError for a result of another study.
  std::optional<RunResult> result(std::uint32_t run) const;

  /// Throws files::WriteError.
  void keep(const RunResult& result) const;
  void keep(const std::string& name, const std::string& text) const;

  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  void remove_leftovers() const;
  void claim(const Study& study) const;
  std::string written_aside(const std::string& name, const std::string& text) const;

  std::filesystem::path path_;
  std::string fingerprint_;
};

}  // namespace inslab::montecarlo
