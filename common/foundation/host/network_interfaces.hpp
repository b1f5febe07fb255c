#pragma once

#include <optional>
#include <string>
#include <vector>

namespace inslab::host {

/// An IPv4 address of this host and the interface that has it.
struct NetworkInterface {
  std::string name;     ///< such as "eth0"
  std::string address;  ///< such as "192.168.1.7"
};

/// Those of this host that are up, the loopback among them. One with several addresses comes several times.
std::vector<NetworkInterface> network_interfaces();

/// The address that `wanted` means among `interfaces`: itself when one has it, or the first address of the interface of
/// that name. Nothing when there is none.
std::optional<std::string> address_on(const std::vector<NetworkInterface>& interfaces, const std::string& wanted);

/// "lo (127.0.0.1), eth0 (192.168.1.7)", for messages.
std::string words_of(const std::vector<NetworkInterface>& interfaces);

}  // namespace inslab::host
