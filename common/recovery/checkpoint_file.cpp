#include "recovery/checkpoint_file.hpp"

#include <zlib.h>

#include <atomic>
#include <cstring>

namespace inslab::recovery {

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
    : file_(path, 2 * kFirstSlotBytes), slot_bytes_(file_.size() / 2 / alignof(Slot) * alignof(Slot)) {
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

void CheckpointFile::grow(std::size_t state_bytes) {
  // Slots move when they grow: both states go to memory first.
  const std::size_t old_bytes = slot_bytes_;
  std::vector<std::uint8_t> second(slot(1), slot(1) + old_bytes);
  slot_bytes_ = 2 * (state_bytes + sizeof(Slot)) / alignof(Slot) * alignof(Slot);
  file_.grow(2 * slot_bytes_);
  std::memcpy(slot(1), second.data(), second.size());
}

void CheckpointFile::keep(const std::vector<std::uint8_t>& state) {
  if (state.size() > slot_bytes_ - sizeof(Slot)) grow(state.size());
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

}  // namespace inslab::recovery
