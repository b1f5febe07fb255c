#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace inslab::dds {

// The kinds of the policies of DDS 1.4 (2.2.3) in their order there: a writer may offer more than a reader asks for.
enum class ReliabilityKind { BestEffort, Reliable };
enum class DurabilityKind { Volatile, TransientLocal, Transient, Persistent };
enum class OwnershipKind { Shared, Exclusive };
enum class LivelinessKind { Automatic, ManualByParticipant, ManualByTopic };
enum class DestinationOrderKind { ByReceptionTimestamp, BySourceTimestamp };
enum class PresentationScope { Instance, Topic, Group };

/// A writer or a reader that somebody has on the network, as its announcement describes it. The defaults are those of
/// DDS: what is not announced.
struct Endpoint {
  bool is_writer = false;
  std::string topic;
  std::string type;
  std::string participant;  ///< its name; empty when it has none
  std::string guid_prefix;  ///< of the participant: 12 hexadecimal pairs with dots, the vendor's two first
  ReliabilityKind reliability = ReliabilityKind::BestEffort;
  DurabilityKind durability = DurabilityKind::Volatile;
  double deadline_s = std::numeric_limits<double>::infinity();
  double latency_budget_s = 0.0;
  OwnershipKind ownership = OwnershipKind::Shared;
  LivelinessKind liveliness = LivelinessKind::Automatic;
  double liveliness_lease_s = std::numeric_limits<double>::infinity();
  DestinationOrderKind destination_order = DestinationOrderKind::ByReceptionTimestamp;
  PresentationScope presentation = PresentationScope::Instance;
  bool coherent_access = false;
  bool ordered_access = false;
  std::vector<std::string> partitions;
  std::vector<int> representations;  ///< ids of DDS-XTypes offered or accepted; empty: XCDR1

  /// Whether it is a service or a command of this product, by its participant's name.
  bool is_ours() const { return participant.rfind("inslab-", 0) == 0; }
};

/// One reason why a writer and a reader of one topic do not match.
struct Mismatch {
  std::string policy;      ///< as DDS spells it, such as "DEADLINE"; "type" for the type's name
  std::string of_writer;   ///< the writer's value
  std::string of_reader;   ///< the reader's
  std::string for_writer;  ///< what to set at the writer
  std::string for_reader;  ///< or at the reader
};

/// Every reason; empty when they match. Source: DDS 1.4, 2.2.3 (requested against offered), DDS-XTypes 1.3, 7.6.3.1
/// (data representation), and the type's name. What two participants of Fast DDS do not compare (latency budget,
/// destination order, presentation) keeps none of its own from matching.
std::vector<Mismatch> mismatches(const Endpoint& writer, const Endpoint& reader);

/// Whether their partitions match: names, or patterns that match the other's name.
bool share_a_partition(const Endpoint& a, const Endpoint& b);

/// The name of a policy by its number in DDS (QosPolicyId_t); "policy N" for one that DDS and DDS-XTypes do not know.
std::string policy_name(int id);

}  // namespace inslab::dds
