#include "inslab/bus/dds/packet_guard.hpp"

#include <spdlog/spdlog.h>

#include <array>
#include <utility>

namespace inslab::dds {

namespace efr = eprosima::fastdds::rtps;

namespace {

/// Says the first of each kind of fault.
class Teller {
 public:
  void say(DatagramFault fault, const efr::Locator& from) {
    if (said_.at(static_cast<std::size_t>(fault)).exchange(true)) return;
    spdlog::warn("a datagram from {}:{} was not read: it holds {}; more of this kind are counted, not told",
                 efr::IPLocator::toIPv4string(from), from.port, text(fault));
  }

 private:
  std::array<std::atomic<bool>, static_cast<std::size_t>(DatagramFault::UnsoundProtection) + 1> said_{};
};

struct GuardedDescriptor : efr::ChainingTransportDescriptor {
  GuardedDescriptor(std::shared_ptr<efr::TransportDescriptorInterface> transport, Protection guard_protection,
                    std::shared_ptr<std::atomic<std::uint32_t>> counter)
      : ChainingTransportDescriptor(std::move(transport)), protection(guard_protection), refused(std::move(counter)) {}
  efr::TransportInterface* create_transport() const override;

  Protection protection;
  std::shared_ptr<std::atomic<std::uint32_t>> refused;
};

class GuardedTransport : public fast_dds::ChainedTransport {
 public:
  explicit GuardedTransport(const GuardedDescriptor& descriptor)
      : ChainedTransport(descriptor), descriptor_(descriptor) {}

  efr::TransportDescriptorInterface* get_configuration() override { return descriptor_.low_level_descriptor.get(); }
  void shutdown() override { low_level_transport_->shutdown(); }

  void receive(efr::TransportReceiverInterface* receiver, const efr::octet* datagram, std::uint32_t size,
               const efr::Locator& local, const efr::Locator& remote) override {
    const DatagramFault fault = judge(datagram, size, descriptor_.protection);
    if (fault == DatagramFault::None) {
      receiver->OnDataReceived(datagram, size, local, remote);
      return;
    }
    ++*descriptor_.refused;
    teller_.say(fault, remote);
  }

 private:
  GuardedDescriptor descriptor_;
  Teller teller_;
};

efr::TransportInterface* GuardedDescriptor::create_transport() const { return new GuardedTransport(*this); }

}  // namespace

std::shared_ptr<efr::TransportDescriptorInterface> guarded(std::shared_ptr<efr::TransportDescriptorInterface> transport,
                                                           Protection protection,
                                                           std::shared_ptr<std::atomic<std::uint32_t>> refused) {
  return std::make_shared<GuardedDescriptor>(std::move(transport), protection, std::move(refused));
}

}  // namespace inslab::dds
