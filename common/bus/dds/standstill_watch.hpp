#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace inslab::dds {

/// Notices that this process stood still (stopped by a signal, by a debugger, by a host without a processor to give)
/// for longer than `longest`, and calls `afterwards` as soon as it goes on, from a thread of its own.
class StandstillWatch {
 public:
  StandstillWatch(std::chrono::nanoseconds longest, std::function<void()> afterwards);
  ~StandstillWatch();
  StandstillWatch(const StandstillWatch&) = delete;
  StandstillWatch& operator=(const StandstillWatch&) = delete;

 private:
  void watch();

  std::chrono::nanoseconds longest_;
  std::function<void()> afterwards_;
  std::mutex mutex_;
  std::condition_variable ends_;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace inslab::dds
