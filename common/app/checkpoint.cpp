#include "app/checkpoint.hpp"

#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "app/host.hpp"

namespace inslab::app {
namespace {

std::filesystem::path default_folder() {
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  if (runtime != nullptr && *runtime != '\0') return std::filesystem::path(runtime) / "inslab";
  return std::filesystem::temp_directory_path() / ("inslab-" + std::to_string(getuid()));
}

/// In a folder that everybody may write to, somebody else may have made it: then it is not used.
void make_private(const std::filesystem::path& folder) {
  if (std::filesystem::create_directories(folder))
    std::filesystem::permissions(folder, std::filesystem::perms::owner_all);
  struct stat status {};
  if (stat(folder.c_str(), &status) != 0 || status.st_uid != getuid()) {
    throw std::runtime_error(folder.string() + ": is not a folder of this user");
  }
}

}  // namespace

std::string Checkpoint::path(const Context& context, const std::string& kind) {
  const ServiceOptions& options = context.options();
  const std::filesystem::path folder =
      options.state_folder.empty() ? default_folder() : std::filesystem::path(options.state_folder);
  make_private(folder);
  std::string name = context.service() + "-" + std::to_string(options.network.domain);
  if (!options.network.unit.empty()) name += "-" + options.network.unit;
  return (folder / (name + "-" + std::to_string(options.sensor) + "." + kind)).string();
}

Checkpoint::Checkpoint(const Context& context)
    : scenario_(context.scenario().scenario.name), seed_(context.scenario().scenario.seed) {
  try {
    file_ = std::make_unique<recovery::CheckpointFile>(path(context, "state"));
  } catch (const std::exception& error) {
    spdlog::warn("started again in the middle of a run, this service could not go on: {}", error.what());
  }
}

std::int64_t Checkpoint::now() { return realtime_now().count(); }

}  // namespace inslab::app
