#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "inslab/foundation/files/mapped_file.hpp"

namespace inslab::state {

/// The last state of a service, in a file mapped into memory: what was kept before a SIGKILL is there afterwards, at
/// the cost of copying it. Two slots take turns, each with its number and CRC, so that a process killed in the middle
/// of keeping one leaves the other. It does not outlive a power failure: a state is for the run that is going on.
class CheckpointFile {
 public:
  /// Opens or creates `path` and reads what it holds. Throws std::runtime_error when it cannot.
  explicit CheckpointFile(const std::string& path);

  /// The newest whole state; nothing when there is none.
  const std::optional<std::vector<std::uint8_t>>& last() const { return last_; }

  /// Takes the place of the older of the two states kept. Throws std::runtime_error when there is no room for it; the
  /// newest state then stays what it was.
  void keep(const std::vector<std::uint8_t>& state);

 private:
  struct Slot;
  static constexpr std::size_t kFirstSlotBytes = std::size_t{1} << 16;

  std::uint8_t* slot(std::uint64_t number) { return file_->data() + (number % 2) * slot_bytes_; }
  std::optional<std::uint64_t> read(std::uint64_t number);
  void keep_in_larger_file(const std::vector<std::uint8_t>& state);
  void put(const std::vector<std::uint8_t>& state);

  std::string path_;
  std::unique_ptr<files::MappedFile> file_;
  std::size_t slot_bytes_;
  std::uint64_t number_ = 0;  ///< of the newest state; 0: none
  std::optional<std::vector<std::uint8_t>> last_;
};

}  // namespace inslab::state
