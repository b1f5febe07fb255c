#include "inslab/referee/montecarlo/result_folder.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>

#include "inslab/data/json/json_reader.hpp"
#include "inslab/data/json/json_writer.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/output_file.hpp"
#include "inslab/foundation/host/host.hpp"

namespace inslab::montecarlo {

namespace {

namespace fs = std::filesystem;
using json::Json;

constexpr const char* kStudyFile = "study.json";

std::string run_file(std::uint32_t run) { return fmt::format("run_{:06}.json", run); }

/// "scenario.duration_s is 60 there and 30 here": the first place where two descriptions differ.
std::string first_difference(const Json& there, const Json& here) {
  const Json patch = Json::diff(there, here);
  if (patch.empty()) return "the order of keys differs";
  const auto path = patch.front().at("path").get<std::string>();
  const Json::json_pointer place(path);
  const auto shown = [&](const Json& json) {
    if (!json.contains(place)) return std::string("absent");
    const std::string text = json[place].dump();
    constexpr std::size_t kMost = 60;
    return text.size() > kMost ? text.substr(0, kMost) + "..." : text;
  };
  return fmt::format("{} is {} there and {} here", path.substr(1), shown(there), shown(here));
}

}  // namespace

ResultFolder::ResultFolder(const std::string& path, const Study& study) : path_(path), fingerprint_(study.fingerprint) {
  std::error_code error;
  fs::create_directories(path_, error);
  if (error) throw files::WriteError(path, "making the folder", error.value());
  remove_leftovers();
  claim(study);
}

/// What processes of this host were writing when they were killed.
void ResultFolder::remove_leftovers() const {
  const std::string of_this_host = "." + host::host_name() + ".";
  for (const fs::directory_entry& entry : fs::directory_iterator(path_)) {
    const std::string name = entry.path().filename().string();
    const std::size_t host = name.rfind(of_this_host);
    if (name.front() != '.' || host == std::string::npos) continue;
    const int pid = std::atoi(name.c_str() + host + of_this_host.size());
    std::error_code ignored;
    if (pid > 0 && kill(pid, 0) != 0 && errno == ESRCH) fs::remove(entry.path(), ignored);
  }
}

/// The first process to come says what the folder is for; all others find that.
void ResultFolder::claim(const Study& study) const {
  const std::string name = file(kStudyFile);
  if (!fs::exists(name)) {
    const std::string aside = written_aside(kStudyFile, study.description.dump(2) + "\n");
    std::error_code error;
    fs::create_hard_link(aside, name, error);  // unlike a rename it never replaces another's
    fs::remove(aside);
    if (error && error != std::errc::file_exists) throw files::WriteError(name, "making the file", error.value());
  }
  const Json there = json::read_json_file(name);
  if (there == study.description) return;
  throw files::ReadError(path_.string() +
                         ": holds the results of another study: " + first_difference(there, study.description) +
                         "; expected a folder of this study, or a new one");
}

std::optional<RunResult> ResultFolder::result(std::uint32_t run) const {
  const std::string name = file(run_file(run));
  if (!fs::exists(name)) return std::nullopt;
  RunResult result;
  try {
    result = json::read_file<RunResult>(name);
  } catch (const json::Error&) {
    return std::nullopt;
  }
  if (result.fingerprint == fingerprint_ && result.run == run) return result;
  throw files::ReadError(fmt::format("{}: is run {} of study {}; expected run {} of study {}", name, result.run,
                                     result.fingerprint, run, fingerprint_));
}

void ResultFolder::keep(const RunResult& result) const {
  keep(run_file(result.run), json::json_from_struct(result).dump() + "\n");
}

void ResultFolder::keep(const std::string& name, const std::string& text) const {
  const std::string aside = written_aside(name, text);
  std::error_code error;
  fs::rename(aside, file(name), error);
  if (error) throw files::WriteError(file(name), "renaming the file", error.value());
}

std::string ResultFolder::written_aside(const std::string& name, const std::string& text) const {
  const std::string aside = file(fmt::format(".{}.{}.{}", name, host::host_name(), host::process_id()));
  files::write_file(aside, text);
  return aside;
}

}  // namespace inslab::montecarlo
