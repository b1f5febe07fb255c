#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>

namespace inslab::host {

/// The queue between the threads of DDS, which only put, and the one worker, which computes and writes.
template <class Message>
class Mailbox {
 public:
  explicit Mailbox(std::size_t capacity = 100'000) : capacity_(capacity) {}

  /// False, and counted, when the mailbox is full: the message is lost, the caller never waits.
  bool put(Message message) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (messages_.size() >= capacity_) {
        ++dropped_;
        return false;
      }
      messages_.push_back(std::move(message));
      deepest_ = std::max(deepest_, messages_.size());
    }
    arrived_.notify_one();
    return true;
  }

  /// The next message, or nothing after `timeout`.
  std::optional<Message> take(std::chrono::nanoseconds timeout) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!arrived_.wait_for(lock, timeout, [this] { return !messages_.empty(); })) return std::nullopt;
    std::optional<Message> message(std::move(messages_.front()));
    messages_.pop_front();
    return message;
  }

  bool empty() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_.empty();
  }
  std::size_t deepest() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return deepest_;
  }
  std::uint64_t dropped() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return dropped_;
  }

 private:
  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<Message> messages_;
  std::size_t deepest_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace inslab::host
