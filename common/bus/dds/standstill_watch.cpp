#include "inslab/bus/dds/standstill_watch.hpp"

#include <utility>

namespace inslab::dds {

StandstillWatch::StandstillWatch(std::chrono::nanoseconds longest, std::function<void()> afterwards)
    : longest_(longest), afterwards_(std::move(afterwards)), thread_([this] { watch(); }) {}

StandstillWatch::~StandstillWatch() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ended_ = true;
  }
  ends_.notify_all();
  thread_.join();
}

void StandstillWatch::watch() {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::seconds kLook(1);
  std::unique_lock<std::mutex> lock(mutex_);
  auto looked_at = Clock::now();
  while (!ends_.wait_for(lock, kLook, [this] { return ended_; })) {
    const auto now = Clock::now();
    if (now - looked_at > kLook + longest_) afterwards_();
    looked_at = now;
  }
}

}  // namespace inslab::dds
