#include "inslab/bus/service/checkpoint.hpp"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <functional>

#include "inslab/foundation/host/host.hpp"

namespace inslab::service {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const std::string& state_folder) {
  if (!state_folder.empty()) return state_folder;
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  if (runtime != nullptr && *runtime != '\0') return fs::path(runtime) / "inslab";
  return fs::temp_directory_path() / ("inslab-" + std::to_string(getuid()));
}

/// In a folder that everybody may write to, somebody else may have made it: then it is not used.
void make_private(const fs::path& folder) {
  if (fs::create_directories(folder)) fs::permissions(folder, fs::perms::owner_all);
  struct stat status {};
  if (stat(folder.c_str(), &status) != 0 || status.st_uid != getuid()) {
    throw std::runtime_error(folder.string() + ": is not a folder of this user");
  }
}

constexpr std::size_t kRunIdDigits = 32;

/// The run that a file is of, as its name says: NAME-RUN.KIND, or NAME-RUN.KIND.new while it grows. Empty when it is
/// none of ours.
std::string run_of(const fs::path& file) {
  const std::string stem = (file.extension() == ".new" ? file.stem() : file).stem().string();
  if (stem.size() <= kRunIdDigits || stem[stem.size() - kRunIdDigits - 1] != '-') return "";
  const std::string run = stem.substr(stem.size() - kRunIdDigits);
  return run.find_first_not_of("0123456789abcdef") == std::string::npos ? run : "";
}

void for_each_file(const fs::path& folder, const std::function<void(const fs::path&)>& visit) {
  std::error_code failed;
  for (auto entry = fs::directory_iterator(folder, failed); !failed && entry != fs::directory_iterator();
       entry.increment(failed)) {
    if (!run_of(entry->path()).empty()) visit(entry->path());
  }
}

/// Whether the process that a file belongs to lives: it holds the lock (files::MappedFile).
bool is_in_use(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0) return true;
  const bool in_use = flock(descriptor, LOCK_EX | LOCK_NB) != 0;
  close(descriptor);
  return in_use;
}

/// Of runs that nobody ended in order. One that goes on is started again within seconds, not after a day.
void remove_old_files(const fs::path& folder) {
  for_each_file(folder, [](const fs::path& file) {
    std::error_code failed;
    const auto age = fs::file_time_type::clock::now() - fs::last_write_time(file, failed);
    if (!failed && age > std::chrono::hours(24) && !is_in_use(file)) fs::remove(file, failed);
  });
}

}  // namespace

Checkpoint::Checkpoint(const Context& context)
    : scenario_(context.scenario().scenario.name), seed_(context.scenario().scenario.seed) {
  const ServiceOptions& options = context.options();
  name_ = context.service() + "-" + std::to_string(options.network.domain);
  if (!options.network.unit.empty()) name_ += "-" + options.network.unit;
  name_ += "-" + std::to_string(options.sensor) + "-";
  try {
    const fs::path folder = folder_of(options.state_folder);
    make_private(folder);
    folder_ = folder;
    remove_old_files(folder_);
  } catch (const std::exception& error) {
    say_that_there_is_none(error.what());
  }
}

void Checkpoint::say_that_there_is_none(const std::string& why) {
  spdlog::warn("started again in the middle of a run, this service could not go on: {}", why);
}

bool Checkpoint::is_of_this_service(const fs::path& file) const {
  const std::string name = file.filename().string();
  return name.size() > name_.size() + kRunIdDigits && name.compare(0, name_.size(), name_) == 0 &&
         name[name_.size() + kRunIdDigits] == '.';
}

bool Checkpoint::left_behind() const {
  bool found = false;
  if (!folder_.empty())
    for_each_file(folder_, [&](const fs::path& file) { found |= is_of_this_service(file) && !is_in_use(file); });
  return found;
}

std::string Checkpoint::path(const std::string& kind) const {
  if (folder_.empty()) throw std::runtime_error("there is no folder for it");
  return (folder_ / (name_ + host::run_id_text(run_) + "." + kind)).string();
}

void Checkpoint::begin(const RunId& run) {
  if (run == run_) return;
  if (run_ != RunId{}) forget();
  run_ = run;
  if (folder_.empty()) return;
  try {
    file_ = std::make_unique<state::CheckpointFile>(path("state"));
  } catch (const std::exception& error) {
    say_that_there_is_none(error.what());
  }
}

void Checkpoint::forget() {
  file_.reset();
  if (folder_.empty()) return;
  const std::string of_this_run = name_ + host::run_id_text(run_) + ".";
  for_each_file(folder_, [&](const fs::path& file) {
    std::error_code failed;
    if (file.filename().string().compare(0, of_this_run.size(), of_this_run) == 0) fs::remove(file, failed);
  });
}

bool Checkpoint::keep(const std::vector<std::uint8_t>& state) {
  if (!file_) return false;
  try {
    file_->keep(state);
    no_room_was_said_ = false;
    return true;
  } catch (const std::exception& error) {
    if (!no_room_was_said_) say_that_there_is_none(error.what());
    no_room_was_said_ = true;
    return false;
  }
}

std::int64_t Checkpoint::now() { return host::realtime_now().count(); }

void remove_checkpoints(const std::string& state_folder, const RunId& run) {
  for_each_file(folder_of(state_folder), [&run](const fs::path& file) {
    std::error_code failed;
    if (run_of(file) == host::run_id_text(run) && !is_in_use(file)) fs::remove(file, failed);
  });
}

}  // namespace inslab::service
