#include "inslab/foundation/host/network_interfaces.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include <memory>

namespace inslab::host {

std::vector<NetworkInterface> network_interfaces() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return {};
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(first, &freeifaddrs);
  std::vector<NetworkInterface> interfaces;
  for (const ifaddrs* at = first; at != nullptr; at = at->ifa_next) {
    if (at->ifa_addr == nullptr || at->ifa_addr->sa_family != AF_INET || (at->ifa_flags & IFF_UP) == 0) continue;
    char text[INET_ADDRSTRLEN] = {};
    inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(at->ifa_addr)->sin_addr, text, sizeof(text));
    interfaces.push_back({at->ifa_name, text});
  }
  return interfaces;
}

std::optional<std::string> address_on(const std::vector<NetworkInterface>& interfaces, const std::string& wanted) {
  for (const NetworkInterface& interface : interfaces) {
    if (interface.address == wanted || interface.name == wanted) return interface.address;
  }
  return std::nullopt;
}

std::string words_of(const std::vector<NetworkInterface>& interfaces) {
  std::string words;
  for (const NetworkInterface& interface : interfaces) {
    words += (words.empty() ? "" : ", ") + interface.name + " (" + interface.address + ")";
  }
  return words.empty() ? "none that is up" : words;
}

}  // namespace inslab::host
