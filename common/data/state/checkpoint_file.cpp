#include "inslab/data/state/checkpoint_file.hpp"

#include <zlib.h>

#include <atomic>
#include <cstring>
#include <filesystem>

namespace inslab::state {

/// What begins each slot.
struct CheckpointFile::Slot {
  std::uint64_t number;  ///< 0: empty
  std::uint64_t size;
  std::uint64_t crc;  ///< of the state, begun with the number
};

namespace {

std::uint64_t crc_of(std::uint64_t number, const std::uint8_t* state, std::size_t size) {
  const auto begun = crc32_z(0, reinterpret_cast<const Bytef*>(&number), sizeof(number));
  return crc32_z(begun, state, size);
}

}  // namespace

CheckpointFile::CheckpointFile(const std::string& path)
    : path_(path),
      file_(std::make_unique<files::MappedFile>(path, 2 * kFirstSlotBytes)),
      slot_bytes_(file_->size() / 2 / alignof(Slot) * alignof(Slot)) {
  for (const std::uint64_t place : {0, 1}) {
    const auto number = read(place);
    if (!number || *number <= number_) continue;
    number_ = *number;
    Slot head;
    std::memcpy(&head, slot(place), sizeof(head));
    const std::uint8_t* state = slot(place) + sizeof(Slot);
    last_ = std::vector<std::uint8_t>(state, state + head.size);
  }
}

/// The number of the state in a slot, when it is whole.
std::optional<std::uint64_t> CheckpointFile::read(std::uint64_t place) {
  Slot head;
  std::memcpy(&head, slot(place), sizeof(head));
  if (head.number == 0 || head.number % 2 != place || head.size > slot_bytes_ - sizeof(Slot)) return std::nullopt;
  if (crc_of(head.number, slot(place) + sizeof(Slot), head.size) != head.crc) return std::nullopt;
  return head.number;
}

/// A larger file takes the place of this one once it holds the state: a kill meanwhile leaves this one whole.
void CheckpointFile::keep_in_larger_file(const std::vector<std::uint8_t>& state) {
  const std::string aside = path_ + ".new";
  std::filesystem::remove(aside);
  const std::size_t slot_bytes = 2 * (state.size() + sizeof(Slot)) / alignof(Slot) * alignof(Slot);
  std::unique_ptr<files::MappedFile> larger;
  try {
    larger = std::make_unique<files::MappedFile>(aside, 2 * slot_bytes);
  } catch (...) {
    std::filesystem::remove(aside);
    throw;
  }
  file_ = std::move(larger);
  slot_bytes_ = slot_bytes;
  put(state);
  std::filesystem::rename(aside, path_);
}

void CheckpointFile::keep(const std::vector<std::uint8_t>& state) {
  if (state.size() > slot_bytes_ - sizeof(Slot)) {
    keep_in_larger_file(state);
  } else {
    put(state);
  }
}

void CheckpointFile::put(const std::vector<std::uint8_t>& state) {
  const std::uint64_t number = number_ + 1;
  std::uint8_t* place = slot(number);
  // The kernel sees the stores in the order the program makes them; the compiler must keep it, too.
  const Slot empty{};
  std::memcpy(place, &empty, sizeof(empty));
  std::atomic_signal_fence(std::memory_order_seq_cst);
  std::memcpy(place + sizeof(Slot), state.data(), state.size());
  std::atomic_signal_fence(std::memory_order_seq_cst);
  const Slot head{number, state.size(), crc_of(number, state.data(), state.size())};
  std::memcpy(place, &head, sizeof(head));
  number_ = number;
}

}  // namespace inslab::state
