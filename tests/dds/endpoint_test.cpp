#include "inslab/bus/dds/endpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "inslab/bus/dds/wire_findings.hpp"

namespace inslab::dds {
namespace endpoint_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kFastDds = "01.0f.1a.2b.3c.4d.5e.6f.01.00.00.00";
constexpr const char* kCyclone = "01.10.1a.2b.3c.4d.5e.6f.01.00.00.00";

Endpoint our_writer(const std::string& unit = "") {
  Endpoint writer;
  writer.is_writer = true;
  writer.topic = "inslab/imu/0";
  writer.type = "inslab::ImuSample";
  writer.participant = "inslab-imu-injector";
  writer.guid_prefix = kFastDds;
  writer.reliability = ReliabilityKind::Reliable;
  if (!unit.empty()) writer.partitions = {unit};
  return writer;
}

Endpoint apps_reader(const std::string& unit = "") {
  Endpoint reader = our_writer(unit);
  reader.is_writer = false;
  reader.participant = "app";
  reader.guid_prefix = kCyclone;
  return reader;
}

Endpoint our_status_writer(const std::string& unit) {
  Endpoint writer = our_writer(unit);
  writer.topic = "inslab/sim/status";
  writer.participant = "inslab-trajectory-server";
  return writer;
}

struct Case {
  const char* policy;
  const char* of_writer;
  const char* of_reader;
  const char* for_reader;
  void (*change)(Endpoint& writer, Endpoint& reader);
};

/// One for each policy that DDS compares, by its requested-against-offered rule (DDS 1.4, 2.2.3).
const Case kCases[] = {
    {"RELIABILITY", "BEST_EFFORT", "RELIABLE", "BEST_EFFORT",
     [](Endpoint& w, Endpoint&) { w.reliability = ReliabilityKind::BestEffort; }},
    {"DURABILITY", "VOLATILE", "TRANSIENT_LOCAL", "VOLATILE",
     [](Endpoint&, Endpoint& r) { r.durability = DurabilityKind::TransientLocal; }},
    {"DURABILITY", "TRANSIENT_LOCAL", "TRANSIENT", "TRANSIENT_LOCAL",
     [](Endpoint& w, Endpoint& r) {
       w.durability = DurabilityKind::TransientLocal;
       r.durability = DurabilityKind::Transient;
     }},
    {"DEADLINE", "period infinite", "period 50 ms", "period infinite, the default",
     [](Endpoint&, Endpoint& r) { r.deadline_s = 0.05; }},
    {"DEADLINE", "period 100 ms", "period 50 ms", "period 100 ms or more",
     [](Endpoint& w, Endpoint& r) {
       w.deadline_s = 0.1;
       r.deadline_s = 0.05;
     }},
    {"LATENCY_BUDGET", "10 ms", "0 ms", "10 ms or more", [](Endpoint& w, Endpoint&) { w.latency_budget_s = 0.01; }},
    {"OWNERSHIP", "SHARED", "EXCLUSIVE", "SHARED",
     [](Endpoint&, Endpoint& r) { r.ownership = OwnershipKind::Exclusive; }},
    {"OWNERSHIP", "EXCLUSIVE", "SHARED", "EXCLUSIVE",
     [](Endpoint& w, Endpoint&) { w.ownership = OwnershipKind::Exclusive; }},
    {"LIVELINESS", "AUTOMATIC", "MANUAL_BY_TOPIC", "AUTOMATIC",
     [](Endpoint&, Endpoint& r) { r.liveliness = LivelinessKind::ManualByTopic; }},
    {"LIVELINESS", "lease infinite", "lease 1000 ms", "lease infinite, the default",
     [](Endpoint&, Endpoint& r) { r.liveliness_lease_s = 1.0; }},
    {"DESTINATION_ORDER", "BY_RECEPTION_TIMESTAMP", "BY_SOURCE_TIMESTAMP", "BY_RECEPTION_TIMESTAMP",
     [](Endpoint&, Endpoint& r) { r.destination_order = DestinationOrderKind::BySourceTimestamp; }},
    {"PRESENTATION", "INSTANCE", "GROUP", "INSTANCE",
     [](Endpoint&, Endpoint& r) { r.presentation = PresentationScope::Group; }},
    {"PRESENTATION", "INSTANCE", "INSTANCE, coherent access", "INSTANCE",
     [](Endpoint&, Endpoint& r) { r.coherent_access = true; }},
    {"PRESENTATION", "INSTANCE", "INSTANCE, ordered access", "INSTANCE",
     [](Endpoint&, Endpoint& r) { r.ordered_access = true; }},
    {"PARTITION", "none", "'truck'", "none", [](Endpoint&, Endpoint& r) { r.partitions = {"truck"}; }},
    {"DATA_REPRESENTATION", "XCDR1", "XCDR2", "XCDR1", [](Endpoint&, Endpoint& r) { r.representations = {2}; }},
    {"type", "inslab::ImuSample", "my::Imu", "inslab::ImuSample", [](Endpoint&, Endpoint& r) { r.type = "my::Imu"; }},
};

TEST(Endpoints, MatchWithTheDefaultsOfDds) { EXPECT_THAT(mismatches(our_writer(), apps_reader()), IsEmpty()); }

TEST(Endpoints, ThatDoNotMatchAreToldByPolicyBothValuesAndWhatToSet) {
  for (const Case& expected : kCases) {
    Endpoint writer = our_writer();
    Endpoint reader = apps_reader();
    expected.change(writer, reader);
    const auto found = mismatches(writer, reader);
    ASSERT_EQ(found.size(), 1U) << expected.policy << " " << expected.of_reader;
    EXPECT_EQ(found[0].policy, expected.policy);
    EXPECT_EQ(found[0].of_writer, expected.of_writer);
    EXPECT_EQ(found[0].of_reader, expected.of_reader);
    EXPECT_EQ(found[0].for_reader, expected.for_reader);
  }
}

TEST(Endpoints, MayOfferMoreThanIsAskedFor) {
  Endpoint writer = our_writer();
  writer.durability = DurabilityKind::Persistent;
  writer.deadline_s = 0.01;
  writer.liveliness = LivelinessKind::ManualByTopic;
  writer.liveliness_lease_s = 0.5;
  writer.destination_order = DestinationOrderKind::BySourceTimestamp;
  writer.presentation = PresentationScope::Group;
  writer.coherent_access = writer.ordered_access = true;
  Endpoint reader = apps_reader();
  reader.reliability = ReliabilityKind::BestEffort;
  reader.deadline_s = 0.02;
  reader.liveliness_lease_s = 0.5;
  reader.representations = {2, 0};
  EXPECT_THAT(mismatches(writer, reader), IsEmpty());
}

TEST(Endpoints, OfFastDdsMatchWhateverPoliciesItDoesNotCompare) {
  Endpoint reader = apps_reader();
  reader.guid_prefix = kFastDds;
  reader.presentation = PresentationScope::Group;
  reader.destination_order = DestinationOrderKind::BySourceTimestamp;
  Endpoint writer = our_writer();
  writer.latency_budget_s = 1.0;
  EXPECT_THAT(mismatches(writer, reader), IsEmpty());
  reader.deadline_s = 0.05;
  EXPECT_EQ(mismatches(writer, reader).size(), 1U);
}

TEST(Endpoints, ShareAPartitionByNameOrPattern) {
  EXPECT_TRUE(share_a_partition(our_writer("truck"), apps_reader("truck")));
  EXPECT_TRUE(share_a_partition(our_writer("truck"), apps_reader("tr*")));
  EXPECT_FALSE(share_a_partition(our_writer("truck"), apps_reader("car")));
  EXPECT_FALSE(share_a_partition(our_writer("truck"), apps_reader()));
  EXPECT_FALSE(share_a_partition(our_writer(), apps_reader("*"))) << "Fast DDS matches no pattern with no partition";
}

TEST(Policies, HaveTheNamesOfTheirNumbers) {
  EXPECT_EQ(policy_name(4), "DEADLINE");
  EXPECT_EQ(policy_name(11), "RELIABILITY");
  EXPECT_EQ(policy_name(23), "DATA_REPRESENTATION");
  EXPECT_EQ(policy_name(0), "policy 0");
  EXPECT_EQ(policy_name(99), "policy 99");
}

TEST(WireFindings, SayWhatToSetAtTheEndThatIsNotOurs) {
  Endpoint reader = apps_reader();
  reader.deadline_s = 0.05;
  const auto found = wire_findings({our_writer(), reader});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].what,
            "inslab/imu/0: writer in 'inslab-imu-injector' and reader in 'app' do not match: DEADLINE: the writer has "
            "period infinite, the reader wants period 50 ms");
  EXPECT_EQ(found[0].cure, "in 'app' set DEADLINE of the reader to period infinite, the default");
}

TEST(WireFindings, NameAParticipantWithoutAName) {
  Endpoint reader = apps_reader();
  reader.participant = "";
  reader.ownership = OwnershipKind::Exclusive;
  const auto found = wire_findings({our_writer(), reader});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found[0].cure, HasSubstr(std::string("GUID prefix ") + kCyclone));
}

TEST(WireFindings, AreNoneBetweenTwoUnits) {
  Endpoint logger = apps_reader("car");
  logger.participant = "inslab-truth-logger";
  const std::vector<Endpoint> two{our_writer("truck"),        our_writer("car"),       apps_reader("truck"), logger,
                                  our_status_writer("truck"), our_status_writer("car")};
  EXPECT_THAT(wire_findings(two), IsEmpty());
  EXPECT_THAT(units_among(two), ElementsAre("car", "truck"));
}

TEST(WireFindings, TellAnAppThatBelongsToNoUnit) {
  const auto found = wire_findings({our_writer("truck"), apps_reader()});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found[0].what, HasSubstr("PARTITION: the writer has 'truck', the reader wants none"));
  EXPECT_EQ(found[0].cure, "in 'app' set PARTITION of the reader to 'truck', the unit's name (--unit)");
}

}  // namespace endpoint_test
}  // namespace inslab::dds
