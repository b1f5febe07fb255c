#include "inslab/bus/dds/peers.hpp"

#include <iomanip>
#include <sstream>

namespace inslab::dds {

std::string words_of(const Peer& peer) {
  std::ostringstream words;
  words << "'" << peer.name << "', GUID " << std::hex << std::setfill('0');
  for (std::size_t i = 0; i < peer.key.size(); ++i) words << (i == 0 ? "" : ".") << std::setw(2) << int{peer.key[i]};
  if (!peer.address.empty()) words << ", at " << peer.address;
  return words.str();
}

}  // namespace inslab::dds
