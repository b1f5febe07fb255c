#include "inslab/bus/dds/endpoint.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace inslab::dds {

namespace {

constexpr int kXcdr1 = 0;  // ids of DDS-XTypes 1.3, 7.6.3.1.1

const char* name_of(ReliabilityKind kind) { return kind == ReliabilityKind::Reliable ? "RELIABLE" : "BEST_EFFORT"; }
const char* name_of(OwnershipKind kind) { return kind == OwnershipKind::Exclusive ? "EXCLUSIVE" : "SHARED"; }
const char* name_of(DestinationOrderKind kind) {
  return kind == DestinationOrderKind::BySourceTimestamp ? "BY_SOURCE_TIMESTAMP" : "BY_RECEPTION_TIMESTAMP";
}
const char* name_of(DurabilityKind kind) {
  constexpr std::array<const char*, 4> kNames{"VOLATILE", "TRANSIENT_LOCAL", "TRANSIENT", "PERSISTENT"};
  return kNames.at(static_cast<std::size_t>(kind));
}
const char* name_of(LivelinessKind kind) {
  constexpr std::array<const char*, 3> kNames{"AUTOMATIC", "MANUAL_BY_PARTICIPANT", "MANUAL_BY_TOPIC"};
  return kNames.at(static_cast<std::size_t>(kind));
}
const char* name_of(PresentationScope scope) {
  constexpr std::array<const char*, 3> kNames{"INSTANCE", "TOPIC", "GROUP"};
  return kNames.at(static_cast<std::size_t>(scope));
}
std::string duration(double seconds) {
  return std::isinf(seconds) ? "infinite" : fmt::format("{:g} ms", seconds * 1e3);
}
std::string representation_name(int id) {
  constexpr std::array<const char*, 3> kNames{"XCDR1", "XML", "XCDR2"};
  return id >= 0 && id < 3 ? kNames.at(static_cast<std::size_t>(id)) : "representation " + std::to_string(id);
}
std::string partition_words(const Endpoint& endpoint) {
  std::string words;
  for (const std::string& name : endpoint.partitions) words += (words.empty() ? "'" : ", '") + name + "'";
  return words.empty() ? "none" : words;
}

bool is_pattern(const std::string& name) { return name.find_first_of("*?[") != std::string::npos; }

/// Two names match when they are the same, or one is a pattern of the other; two patterns do not (DDS 1.4, 2.2.3.13).
bool partitions_match(const std::string& a, const std::string& b) {
  if (is_pattern(a) && is_pattern(b)) return false;
  if (a.empty() || b.empty()) return a == b;  // for Fast DDS no pattern matches what has no name
  if (is_pattern(a)) return fnmatch(a.c_str(), b.c_str(), 0) == 0;
  if (is_pattern(b)) return fnmatch(b.c_str(), a.c_str(), 0) == 0;
  return a == b;
}

/// The vendor's id of Fast DDS is 1.15 (01.0f).
bool is_fast_dds(const Endpoint& endpoint) { return endpoint.guid_prefix.rfind("01.0f", 0) == 0; }

class Comparison {
 public:
  Comparison(const Endpoint& writer, const Endpoint& reader) : writer_(writer), reader_(reader) {}

  std::vector<Mismatch> all() {
    if (writer_.type != reader_.type) differ("type", writer_.type, reader_.type);
    if (!share_a_partition(writer_, reader_)) differ("PARTITION", partition_words(writer_), partition_words(reader_));
    at_least("RELIABILITY", writer_.reliability, reader_.reliability);
    at_least("DURABILITY", writer_.durability, reader_.durability);
    at_most("DEADLINE", "period ", writer_.deadline_s, reader_.deadline_s);
    if (writer_.ownership != reader_.ownership) {
      differ("OWNERSHIP", name_of(writer_.ownership), name_of(reader_.ownership));
    }
    at_least("LIVELINESS", writer_.liveliness, reader_.liveliness);
    at_most("LIVELINESS", "lease ", writer_.liveliness_lease_s, reader_.liveliness_lease_s);
    compare_representations();
    if (is_fast_dds(writer_) && is_fast_dds(reader_)) return found_;
    at_most("LATENCY_BUDGET", "", writer_.latency_budget_s, reader_.latency_budget_s);
    at_least("DESTINATION_ORDER", writer_.destination_order, reader_.destination_order);
    compare_presentations();
    return found_;
  }

 private:
  void add(const char* policy, const std::string& writer, const std::string& reader, const std::string& for_writer,
           const std::string& for_reader) {
    found_.push_back({policy, writer, reader, for_writer, for_reader});
  }
  /// Both must have the same.
  void differ(const char* policy, const std::string& writer, const std::string& reader) {
    add(policy, writer, reader, reader, writer);
  }
  template <class Kind>
  void at_least(const char* policy, Kind offered, Kind requested) {
    if (offered < requested) differ(policy, name_of(offered), name_of(requested));
  }
  void at_most(const char* policy, const char* what, double offered_s, double requested_s) {
    if (offered_s <= requested_s) return;
    add(policy, what + duration(offered_s), what + duration(requested_s),
        fmt::format("{}{} or less", what, duration(requested_s)),
        std::isinf(offered_s) ? fmt::format("{}infinite, the default", what)
                              : fmt::format("{}{} or more", what, duration(offered_s)));
  }
  void compare_presentations() {
    const auto words = [](const Endpoint& endpoint) {
      return fmt::format("{}{}{}", name_of(endpoint.presentation), endpoint.coherent_access ? ", coherent access" : "",
                         endpoint.ordered_access ? ", ordered access" : "");
    };
    const bool enough = writer_.presentation >= reader_.presentation &&
                        (writer_.coherent_access || !reader_.coherent_access) &&
                        (writer_.ordered_access || !reader_.ordered_access);
    if (!enough) differ("PRESENTATION", words(writer_), words(reader_));
  }
  /// A writer uses the first of its representations.
  void compare_representations() {
    const int offered = writer_.representations.empty() ? kXcdr1 : writer_.representations.front();
    const std::vector<int> accepted =
        reader_.representations.empty() ? std::vector<int>{kXcdr1} : reader_.representations;
    if (std::find(accepted.begin(), accepted.end(), offered) != accepted.end()) return;
    std::string words;
    for (const int id : accepted) words += (words.empty() ? "" : ", ") + representation_name(id);
    differ("DATA_REPRESENTATION", representation_name(offered), words);
  }

  const Endpoint& writer_;
  const Endpoint& reader_;
  std::vector<Mismatch> found_;
};

}  // namespace

bool share_a_partition(const Endpoint& a, const Endpoint& b) {
  // None is the same as the one without a name.
  const std::vector<std::string> none{""};
  const auto& of_a = a.partitions.empty() ? none : a.partitions;
  const auto& of_b = b.partitions.empty() ? none : b.partitions;
  return std::any_of(of_a.begin(), of_a.end(), [&of_b](const std::string& name) {
    return std::any_of(of_b.begin(), of_b.end(),
                       [&name](const std::string& other) { return partitions_match(name, other); });
  });
}

std::vector<Mismatch> mismatches(const Endpoint& writer, const Endpoint& reader) {
  return Comparison(writer, reader).all();
}

std::string policy_name(int id) {
  constexpr std::array<const char*, 25> kNames{"",
                                               "USER_DATA",
                                               "DURABILITY",
                                               "PRESENTATION",
                                               "DEADLINE",
                                               "LATENCY_BUDGET",
                                               "OWNERSHIP",
                                               "OWNERSHIP_STRENGTH",
                                               "LIVELINESS",
                                               "TIME_BASED_FILTER",
                                               "PARTITION",
                                               "RELIABILITY",
                                               "DESTINATION_ORDER",
                                               "HISTORY",
                                               "RESOURCE_LIMITS",
                                               "ENTITY_FACTORY",
                                               "WRITER_DATA_LIFECYCLE",
                                               "READER_DATA_LIFECYCLE",
                                               "TOPIC_DATA",
                                               "GROUP_DATA",
                                               "TRANSPORT_PRIORITY",
                                               "LIFESPAN",
                                               "DURABILITY_SERVICE",
                                               "DATA_REPRESENTATION",
                                               "TYPE_CONSISTENCY_ENFORCEMENT"};
  const bool known = id > 0 && static_cast<std::size_t>(id) < kNames.size();
  return known ? kNames.at(static_cast<std::size_t>(id)) : "policy " + std::to_string(id);
}

}  // namespace inslab::dds
