#include "inslab/sim/log_tail.hpp"

#include <atomic>
#include <cstring>

namespace inslab::sim {

/// Begins the file; the messages follow, each with its own head.
struct LogTail::Head {
  std::uint64_t magic;
  std::uint64_t generation;
  std::uint64_t used;
};

namespace {

constexpr std::uint64_t kMagic = 0x32'6c'69'61'74'6c'73'6e;  // "nsltail2"

struct MessageHead {
  std::int64_t received_realtime_ns;
  std::uint64_t size;
  std::uint32_t channel;
  std::uint32_t reserved;
  std::uint64_t number;
  std::array<std::uint8_t, 16> writer;
};

}  // namespace

LogTail::LogTail(const std::string& path) : file_(path, 2 * kLong) {
  Head head;
  std::memcpy(&head, file_.data(), sizeof(head));
  if (head.magic != kMagic || head.used > file_.size() - sizeof(Head)) return;
  generation_ = head.generation;
  used_ = head.used;
}

void LogTail::for_each(std::uint64_t generation, const std::function<void(const Message&)>& visit) {
  if (generation != generation_) return;
  for (std::size_t at = 0; used_ - at >= sizeof(MessageHead);) {
    const std::uint8_t* place = file_.data() + sizeof(Head) + at;
    MessageHead head;
    std::memcpy(&head, place, sizeof(head));
    if (head.size > used_ - at - sizeof(head)) return;
    visit({head.channel, head.received_realtime_ns, place + sizeof(head), static_cast<std::size_t>(head.size),
           head.writer, head.number});
    at += sizeof(head) + static_cast<std::size_t>(head.size);
  }
}

void LogTail::begin(std::uint64_t generation) {
  generation_ = generation;
  used_ = 0;
  publish();
}

void LogTail::add(const Message& message) {
  const MessageHead head{
      message.received_realtime_ns, message.size, message.channel, 0, message.number, message.writer};
  const std::size_t end = sizeof(Head) + used_ + sizeof(head) + message.size;
  if (end > file_.size()) file_.grow(2 * end);
  std::uint8_t* place = file_.data() + sizeof(Head) + used_;
  std::memcpy(place, &head, sizeof(head));
  if (message.size > 0) std::memcpy(place + sizeof(head), message.data, message.size);
  used_ = end - sizeof(Head);
  publish();
}

/// A message counts once its bytes are there: the head is stored after them.
void LogTail::publish() {
  std::atomic_signal_fence(std::memory_order_seq_cst);
  const Head head{kMagic, generation_, used_};
  std::memcpy(file_.data(), &head, sizeof(head));
}

}  // namespace inslab::sim
