#include "inslab/data/streams/identity.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <tuple>

#include "inslab/data/wire/cdr.hpp"
#include "inslab/foundation/host/host.hpp"

namespace inslab::streams {

namespace {

/// Begins the announcement, so that nobody else's is taken for one; its number goes up with every change of Identity.
constexpr char kBegin[] = "inslab identity 1";

}  // namespace

std::vector<std::uint8_t> announced(const Identity& identity) {
  std::vector<std::uint8_t> cdr;
  wire::encode(identity, cdr);
  std::vector<std::uint8_t> bytes(sizeof(kBegin) + cdr.size());
  std::copy(cdr.begin(), cdr.end(), std::copy(std::begin(kBegin), std::end(kBegin), bytes.begin()));
  return bytes;
}

std::optional<Identity> identity_in(const std::vector<std::uint8_t>& announcement) {
  if (announcement.size() < sizeof(kBegin) || std::memcmp(announcement.data(), kBegin, sizeof(kBegin)) != 0) {
    return std::nullopt;
  }
  Identity identity;
  const std::size_t size = announcement.size() - sizeof(kBegin);
  if (!wire::decode(announcement.data() + sizeof(kBegin), size, identity)) return std::nullopt;
  return identity;
}

std::string words_of(const Identity& identity) {
  return identity.service + " " + std::to_string(identity.sensor_number) + " (host " + identity.host + ", process " +
         std::to_string(identity.pid) + ", since " + host::utc_words(time::Nanoseconds(identity.since_realtime_ns)) +
         (identity.scenario.empty() ? "" : ", scenario '" + identity.scenario + "'") + ")";
}

std::string difference(const Identity& own, const Identity& other) {
  if (!own.scenario_hash.empty() && own.scenario_hash != other.scenario_hash) {
    const bool one_name = own.scenario == other.scenario;
    return one_name ? "both scenarios are called '" + own.scenario + "', but they or what they name differ"
                    : "one has the scenario '" + own.scenario + "', the other '" + other.scenario + "'";
  }
  if (!own.version.empty() && own.version != other.version)
    return "one is inslab " + own.version + ", the other " + other.version;
  if (own.run_id != RunId{} && other.run_id != RunId{} && own.run_id != other.run_id)
    return "they were started for different runs";
  return "";
}

bool must_yield(const Identity& beginning, const Identity& other) {
  constexpr std::int64_t kTogether_ns = 2'000'000'000;
  const bool other_is_later = std::tie(beginning.since_realtime_ns, beginning.host, beginning.pid) <
                              std::tie(other.since_realtime_ns, other.host, other.pid);
  return !other_is_later || other.since_realtime_ns - beginning.since_realtime_ns > kTogether_ns;
}

}  // namespace inslab::streams
