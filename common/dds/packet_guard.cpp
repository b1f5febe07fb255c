#include "dds/packet_guard.hpp"

#include <cstdint>
#include <cstring>
#include <utility>

#include "dds/fast_dds_network.hpp"

namespace inslab::dds {

namespace efr = eprosima::fastdds::rtps;

namespace {

/// Fast DDS's own, which measures its network by it.
constexpr unsigned char kStatisticsSubmessage = 0x80;
constexpr unsigned char kPad = 0x01;
constexpr unsigned char kInfoTimestamp = 0x09;
constexpr unsigned char kVendorFastDds[] = {1, 15};
constexpr std::size_t kHeaderBytes = 20;
constexpr std::size_t kSubmessageHeaderBytes = 4;

class GuardedTransport : public fast_dds::ChainedTransport {
 public:
  explicit GuardedTransport(const efr::ChainingTransportDescriptor& descriptor)
      : ChainedTransport(descriptor), low_level_descriptor_(descriptor.low_level_descriptor) {}

  efr::TransportDescriptorInterface* get_configuration() override { return low_level_descriptor_.get(); }
  void shutdown() override { low_level_transport_->shutdown(); }

  void receive(efr::TransportReceiverInterface* receiver, const efr::octet* buffer, std::uint32_t size,
               const efr::Locator_t& local, const efr::Locator_t& remote) override {
    if (is_harmless(buffer, size)) receiver->OnDataReceived(buffer, size, local, remote);
  }

 private:
  std::shared_ptr<efr::TransportDescriptorInterface> low_level_descriptor_;
};

struct GuardedTransportDescriptor : efr::ChainingTransportDescriptor {
  using ChainingTransportDescriptor::ChainingTransportDescriptor;
  efr::TransportInterface* create_transport() const override { return new GuardedTransport(*this); }
};

}  // namespace

/// Walks the submessages as MessageReceiver::notify_network_statistics does, which stops at the first of that kind.
bool is_harmless(const unsigned char* message, std::size_t size) {
  if (size < kHeaderBytes || std::memcmp(message + 6, kVendorFastDds, sizeof(kVendorFastDds)) != 0) return true;
  std::size_t at = kHeaderBytes;
  while (size - at >= kSubmessageHeaderBytes) {
    const unsigned char kind = message[at];
    const bool little_endian = (message[at + 1] & 1) != 0;
    const std::size_t low = message[at + (little_endian ? 2 : 3)];
    const std::size_t high = message[at + (little_endian ? 3 : 2)];
    const std::size_t length = low + (high << 8);
    at += kSubmessageHeaderBytes;
    if (length > size - at) return true;  // Fast DDS stops reading here, too
    const bool is_last = length == 0 && kind != kInfoTimestamp && kind != kPad;
    if (kind == kStatisticsSubmessage) return is_last || at + length == size;
    if (is_last) return true;
    const std::size_t padded = (length + 3) & ~std::size_t{3};
    if (padded > size - at) return true;
    at += padded;
  }
  return true;
}

std::shared_ptr<efr::TransportDescriptorInterface> guarded(
    std::shared_ptr<efr::TransportDescriptorInterface> transport) {
  return std::make_shared<GuardedTransportDescriptor>(std::move(transport));
}

}  // namespace inslab::dds
