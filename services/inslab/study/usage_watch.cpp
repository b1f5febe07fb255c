#include "inslab/services/inslab/study/usage_watch.hpp"

#include <fmt/format.h>

namespace inslab::study {

void UsageWatch::add(const std::string& program, double part, const ProcessUsage& usage) {
  Peaks& peaks = peaks_[program];
  ProcessUsage& peak = part < 0.5 ? peaks.first : peaks.last;
  peak.private_bytes = std::max(peak.private_bytes, usage.private_bytes);
  peak.descriptors = std::max(peak.descriptors, usage.descriptors);
}

std::string UsageWatch::text() const {
  std::string text = fmt::format("\n{:<28}{:>14}{:>14}{:>14}{:>14}\n", "most, first and last third", "MB first",
                                 "MB last", "fds first", "fds last");
  const auto mb = [](std::uint64_t bytes) { return static_cast<double>(bytes) * 1e-6; };
  for (const auto& [program, peaks] : peaks_) {
    text += fmt::format("{:<28}{:>14.1f}{:>14.1f}{:>14}{:>14}\n", program, mb(peaks.first.private_bytes),
                        mb(peaks.last.private_bytes), peaks.first.descriptors, peaks.last.descriptors);
  }
  return text;
}

std::vector<std::string> UsageWatch::growth() const {
  constexpr std::uint64_t kMayGrow = 16 << 20;  // the log's own index among it: 0.6 kB a chunk
  constexpr std::uint64_t kDescriptors = 8;     // sockets that come and go with discovery
  std::vector<std::string> words;
  for (const auto& [program, peaks] : peaks_) {
    if (peaks.last.private_bytes > peaks.first.private_bytes + kMayGrow) words.push_back(program + ": its memory grew");
    if (peaks.last.descriptors > peaks.first.descriptors + kDescriptors) {
      words.push_back(program + ": it holds more descriptors");
    }
  }
  return words;
}

}  // namespace inslab::study
