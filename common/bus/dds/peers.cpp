#include "inslab/bus/dds/peers.hpp"

#include <iomanip>
#include <sstream>
#include <string_view>

namespace inslab::dds {

namespace {
constexpr std::string_view kOnlooker = "inslab onlooker 1";
}

std::vector<std::uint8_t> onlooker_announcement() { return {kOnlooker.begin(), kOnlooker.end()}; }

bool looks_on(const Peer& peer) { return peer.user_data == onlooker_announcement(); }

std::string words_of(const Peer& peer) {
  std::ostringstream words;
  words << "'" << peer.name << "', GUID " << std::hex << std::setfill('0');
  for (std::size_t i = 0; i < peer.key.size(); ++i) words << (i == 0 ? "" : ".") << std::setw(2) << int{peer.key[i]};
  if (!peer.address.empty()) words << ", at " << peer.address;
  return words.str();
}

}  // namespace inslab::dds
