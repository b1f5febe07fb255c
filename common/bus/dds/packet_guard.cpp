#include "inslab/bus/dds/packet_guard.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <utility>

#include "inslab/bus/dds/farewells.hpp"

namespace inslab::dds {

namespace efr = eprosima::fastdds::rtps;

namespace {

/// Says the first of each kind of fault.
class Teller {
 public:
  void say(DatagramFault fault, const std::string& from) {
    if (said_.at(static_cast<std::size_t>(fault)).exchange(true)) return;
    spdlog::warn("a datagram from {} was not read: it holds {}; more of this kind are counted, not told", from,
                 text(fault));
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
      if (const auto from = farewells_.belied_by(sender_of(datagram, size), Clock::now())) {
        refuse(DatagramFault::UnprotectedDisposal, *from);
      }
      receiver->OnDataReceived(datagram, size, local, remote);
      return;
    }
    const std::string from = fmt::format("{}:{}", efr::IPLocator::toIPv4string(remote), remote.port);
    if (fault != DatagramFault::DisposalOfTheSender) {
      refuse(fault, from);
    } else if (!farewells_.came(sender_of(datagram, size), from, Clock::now())) {
      refuse(DatagramFault::UnprotectedDisposal, from);
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  static Farewells::GuidPrefix sender_of(const efr::octet* datagram, std::uint32_t size) {
    constexpr std::uint32_t kOffset = 8;
    Farewells::GuidPrefix prefix{};
    if (size >= kOffset + prefix.size()) std::copy_n(datagram + kOffset, prefix.size(), prefix.begin());
    return prefix;
  }

  void refuse(DatagramFault fault, const std::string& from) {
    ++*descriptor_.refused;
    teller_.say(fault, from);
  }

  GuardedDescriptor descriptor_;
  Teller teller_;
  Farewells farewells_;
};

efr::TransportInterface* GuardedDescriptor::create_transport() const { return new GuardedTransport(*this); }

}  // namespace

std::shared_ptr<efr::TransportDescriptorInterface> guarded(std::shared_ptr<efr::TransportDescriptorInterface> transport,
                                                           Protection protection,
                                                           std::shared_ptr<std::atomic<std::uint32_t>> refused) {
  return std::make_shared<GuardedDescriptor>(std::move(transport), protection, std::move(refused));
}

}  // namespace inslab::dds
