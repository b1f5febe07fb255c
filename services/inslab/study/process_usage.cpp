#include "inslab/services/inslab/study/process_usage.hpp"

#include <filesystem>
#include <fstream>
#include <string>

namespace inslab::study {

std::optional<ProcessUsage> usage_of(pid_t pid) {
  const std::filesystem::path place = "/proc/" + std::to_string(pid);
  ProcessUsage usage;
  std::ifstream status(place / "status");
  for (std::string word; status >> word;) {
    if (word != "RssAnon:") continue;
    status >> usage.private_bytes;
    usage.private_bytes *= 1024;
  }
  if (usage.private_bytes == 0) return std::nullopt;
  std::error_code gone;
  for (auto entry = std::filesystem::directory_iterator(place / "fd", gone);
       !gone && entry != std::filesystem::directory_iterator(); entry.increment(gone)) {
    ++usage.descriptors;
  }
  if (gone) return std::nullopt;
  return usage;
}

}  // namespace inslab::study
