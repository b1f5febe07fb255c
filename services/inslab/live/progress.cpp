#include "inslab/services/inslab/live/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "inslab/foundation/text/shown.hpp"

namespace inslab::live {

Progress::Progress(const std::string& name, time::Nanoseconds duration)
    : name_(text::shown(name)), duration_s_(time::to_seconds(duration)), terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (terminal_ && shown_ >= 0) std::fprintf(stderr, "\r\033[K");
}

void Progress::show(time::Nanoseconds sim_time) {
  constexpr int kWidth = 40;
  const double share = std::clamp(time::to_seconds(sim_time) / duration_s_, 0.0, 1.0);
  const int step = static_cast<int>(share * (terminal_ ? 200 : 10));
  if (step == shown_) return;
  shown_ = step;
  if (terminal_) {
    const int done = static_cast<int>(share * kWidth);
    std::fprintf(
        stderr, "\r%s [%s%s] %5.1f %%  %.1f s", name_.c_str(), std::string(static_cast<std::size_t>(done), '#').c_str(),
        std::string(static_cast<std::size_t>(kWidth - done), '.').c_str(), share * 100.0, time::to_seconds(sim_time));
  } else {
    std::fprintf(stderr, "%s: %.1f of %.1f s\n", name_.c_str(), time::to_seconds(sim_time), duration_s_);
  }
}

void Progress::say(const std::string& line) const {
  std::fprintf(stderr, "%s%s\n", terminal_ ? "\r\033[K" : "", line.c_str());
}

}  // namespace inslab::live
