#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "inslab/foundation/files/mapped_file.hpp"

namespace inslab::sim {

/// The messages that a logger has taken and that are not in its log file yet, in a file mapped into memory: a logger
/// that is killed leaves them to the one that goes on. Each flush of the log begins a new generation.
class LogTail {
 public:
  /// Opens or creates the file. Throws std::runtime_error.
  explicit LogTail(const std::string& path);

  struct Message {
    std::uint32_t channel;
    std::int64_t received_realtime_ns;
    const std::uint8_t* data;
    std::size_t size;
    std::array<std::uint8_t, 16> writer{};  ///< its GUID
    std::uint64_t number = 0;               ///< its count there
  };
  /// The messages of `generation`, in order; none when the file holds another one.
  void for_each(std::uint64_t generation, const std::function<void(const Message&)>& visit);

  /// Forgets all and begins `generation`.
  void begin(std::uint64_t generation);
  /// Keeps one message.
  void add(const Message& message);
  /// Whether it is time to flush the log.
  bool is_long() const { return used_ > kLong; }

 private:
  struct Head;
  static constexpr std::size_t kLong = std::size_t{1} << 20;

  void publish();

  files::MappedFile file_;
  std::uint64_t generation_ = 0;
  std::uint64_t used_ = 0;  ///< bytes of messages
};

}  // namespace inslab::sim
