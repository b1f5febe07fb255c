#include "inslab/bus/dds/wire_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "inslab/data/catalog/topics.hpp"

namespace inslab::dds {

namespace {

std::string name_of(const Endpoint& endpoint) {
  return endpoint.participant.empty() ? "a participant without a name, GUID prefix " + endpoint.guid_prefix
                                      : "'" + endpoint.participant + "'";
}

/// Whether somebody writes what a reader of this partition reads, or reads what its writer writes.
bool has_counterpart(const Endpoint& endpoint, const std::vector<Endpoint>& endpoints) {
  return std::any_of(endpoints.begin(), endpoints.end(), [&endpoint](const Endpoint& other) {
    return other.is_writer != endpoint.is_writer && other.topic == endpoint.topic && share_a_partition(endpoint, other);
  });
}

std::string cure_of(const Mismatch& mismatch, const Endpoint& writer, const Endpoint& reader) {
  const auto at = [&mismatch](const Endpoint& endpoint) {
    const std::string& value = endpoint.is_writer ? mismatch.for_writer : mismatch.for_reader;
    const char* end = endpoint.is_writer ? "writer" : "reader";
    return fmt::format("in {} set {} of the {} to {}", name_of(endpoint), mismatch.policy, end, value);
  };
  if (mismatch.policy == "type" && writer.is_ours() != reader.is_ours()) {
    return "generate the app's types anew from idl/ and build it again (docs/running.md, \"Versions of the types\")";
  }
  const std::string unit = mismatch.policy == "PARTITION" ? ", the unit's name (--unit)" : "";
  if (writer.is_ours() != reader.is_ours()) return at(writer.is_ours() ? reader : writer) + unit;
  if (writer.is_ours()) return "start both ends from one build of the set";
  return at(reader) + unit + "; or " + at(writer) + unit;
}

/// Whether a pair in two partitions is as it is meant: both ends ours, or the app at home in another unit.
bool are_of_two_units(const Endpoint& writer, const Endpoint& reader, const std::vector<Endpoint>& endpoints) {
  if (share_a_partition(writer, reader)) return false;
  const auto at_home = [&endpoints](const Endpoint& end) { return end.is_ours() || has_counterpart(end, endpoints); };
  return at_home(writer) && at_home(reader);
}

}  // namespace

std::vector<WireFinding> wire_findings(const std::vector<Endpoint>& endpoints) {
  std::vector<WireFinding> findings;
  std::set<std::string> said;
  for (const Endpoint& writer : endpoints) {
    for (const Endpoint& reader : endpoints) {
      if (!writer.is_writer || reader.is_writer || writer.topic != reader.topic) continue;
      if (are_of_two_units(writer, reader, endpoints)) continue;
      for (const Mismatch& mismatch : mismatches(writer, reader)) {
        std::string what = fmt::format(
            "{}: writer in {} and reader in {} do not match: {}: the writer has {}, the "
            "reader wants {}",
            writer.topic, name_of(writer), name_of(reader), mismatch.policy, mismatch.of_writer, mismatch.of_reader);
        if (said.insert(what).second) findings.push_back({std::move(what), cure_of(mismatch, writer, reader)});
      }
    }
  }
  return findings;
}

std::vector<std::string> units_among(const std::vector<Endpoint>& endpoints) {
  std::set<std::string> units;
  for (const Endpoint& endpoint : endpoints) {
    // A command looks at a unit, which need not be there; the trajectory server makes one.
    if (!endpoint.is_ours() || !endpoint.is_writer || endpoint.topic != catalog::kSimStatus.name) continue;
    units.insert(endpoint.partitions.empty() ? "" : endpoint.partitions.front());
  }
  return {units.begin(), units.end()};
}

}  // namespace inslab::dds
