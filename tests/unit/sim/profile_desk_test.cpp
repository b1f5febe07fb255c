#include "inslab/sim/profile_desk.hpp"

#include <gtest/gtest.h>

#include "inslab/data/state/state_stream.hpp"

namespace inslab::sim {
namespace profile_desk_test {

const SensorAddress kImu{SensorKind::Imu, 0};
constexpr std::int64_t kMs = 1'000'000;

ImuErrorProfile errors(double arw_deg_per_sqrt_h) {
  ImuErrorProfile profile;
  profile.gyro.arw_deg_per_sqrt_h.setConstant(arw_deg_per_sqrt_h);
  return profile;
}

template <class Profile>
Profile entry(std::uint32_t number, std::int64_t apply_at_ns, Profile profile, SensorAddress target = kImu) {
  profile.target = target;
  profile.request.request_id = 1000 + number;
  profile.request.journal_number = number;
  profile.request.apply_at_ns = apply_at_ns;
  profile.request.requested_at_ns = apply_at_ns;
  return profile;
}

ProfileDesk desk() { return ProfileDesk(kImu, "injector", {errors(0.1), VibrationProfile{}, InstallationProfile{}}); }

TruthState truth(std::int64_t sim_time_ns, std::uint32_t journal_in_effect) {
  TruthState t;
  t.header.sim_time_ns = sim_time_ns;
  t.journal_in_effect = journal_in_effect;
  return t;
}

StreamHeader sample(std::int64_t sim_time_ns, std::uint64_t sequence) {
  StreamHeader h;
  h.run_id.bytes.fill(9);
  h.sim_time_ns = sim_time_ns;
  h.sequence_number = sequence;
  return h;
}

std::vector<std::uint32_t> numbers_of(const std::vector<catalog::AnyProfile>& entries) {
  std::vector<std::uint32_t> numbers;
  for (const catalog::AnyProfile& e : entries) numbers.push_back(catalog::request_of(e).journal_number);
  return numbers;
}

using Numbers = std::vector<std::uint32_t>;

TEST(ProfileDesk, IsReadyWithoutAJournal) { EXPECT_TRUE(desk().complete_for(truth(5 * kMs, 0))); }

TEST(ProfileDesk, WaitsForAnEntryThatIsLate) {
  ProfileDesk d = desk();
  EXPECT_FALSE(d.complete_for(truth(15 * kMs, 1)));
  d.add(entry(1, 10 * kMs, errors(1.0)));
  EXPECT_TRUE(d.complete_for(truth(15 * kMs, 1)));
}

TEST(ProfileDesk, AnEarlyEntryDoesNotStandInForOneThatIsMissing) {
  ProfileDesk d = desk();
  d.add(entry(2, 100 * kMs, errors(2.0)));
  EXPECT_FALSE(d.complete_for(truth(15 * kMs, 1)));
  d.add(entry(1, 10 * kMs, errors(1.0)));
  EXPECT_TRUE(d.complete_for(truth(15 * kMs, 1)));
}

TEST(ProfileDesk, EntriesForOthersCountButDoNotApply) {
  ProfileDesk d = desk();
  d.add(entry(1, 10 * kMs, errors(1.0), {SensorKind::Imu, 1}));
  EXPECT_TRUE(d.complete_for(truth(15 * kMs, 1)));
  EXPECT_TRUE(d.take_due(15 * kMs).empty());
  EXPECT_TRUE(d.acknowledge(sample(15 * kMs, 2)).empty());
}

TEST(ProfileDesk, AnEntryIsTakenOnceHoweverOftenItArrives) {
  ProfileDesk d = desk();
  for (int i = 0; i < 3; ++i) d.add(entry(1, 10 * kMs, errors(1.0)));
  EXPECT_FALSE(d.complete_for(truth(15 * kMs, 2)));
  EXPECT_EQ(numbers_of(d.take_due(15 * kMs)), Numbers{1});
  d.add(entry(1, 10 * kMs, errors(1.0)));
  EXPECT_TRUE(d.take_due(20 * kMs).empty());
}

TEST(ProfileDesk, TakesEffectForTheFirstSampleAfterTheTime) {
  ProfileDesk d = desk();
  d.add(entry(1, 10 * kMs, errors(1.0)));
  EXPECT_TRUE(d.take_due(5 * kMs).empty());
  EXPECT_TRUE(d.take_due(10 * kMs).empty());
  EXPECT_EQ(numbers_of(d.take_due(15 * kMs)), Numbers{1});
}

TEST(ProfileDesk, TheOrderOfArrivalDoesNotMatter) {
  std::vector<catalog::AnyProfile> entries{entry(1, 20 * kMs, errors(1.0)), entry(2, 10 * kMs, errors(2.0)),
                                           entry(3, 10 * kMs, InstallationProfile{}), entry(4, 20 * kMs, errors(4.0))};
  std::get<InstallationProfile>(entries[2]).lever_arm_v_m.x() = 1.0;
  std::vector<std::size_t> order{0, 1, 2, 3};
  do {
    ProfileDesk d = desk();
    for (const std::size_t i : order) d.add(entries[i]);
    ASSERT_EQ(numbers_of(d.take_due(15 * kMs)), (Numbers{2, 3}));
    ASSERT_EQ(numbers_of(d.take_due(25 * kMs)), Numbers{4});
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(ProfileDesk, AcknowledgesWithTheFirstSampleUnderTheProfile) {
  ProfileDesk d = desk();
  ImuErrorProfile late = entry(1, 10 * kMs, errors(1.0));
  late.request.requested_at_ns = 7 * kMs;
  late.request.requested_in_the_past = true;
  d.add(late);
  d.take_due(15 * kMs);
  const auto acks = d.acknowledge(sample(15 * kMs, 2));
  ASSERT_EQ(acks.size(), 1U);
  EXPECT_EQ(acks[0].outcome, AckOutcome::Applied);
  EXPECT_EQ(acks[0].request_id, 1001U);
  EXPECT_EQ(acks[0].journal_number, 1U);
  EXPECT_EQ(acks[0].kind, ProfileKind::ImuError);
  EXPECT_EQ(acks[0].target, kImu);
  EXPECT_EQ(acks[0].service, "injector");
  EXPECT_EQ(acks[0].requested_time_ns, 7 * kMs);
  EXPECT_EQ(acks[0].apply_time_ns, 10 * kMs);
  EXPECT_TRUE(acks[0].requested_in_the_past);
  EXPECT_EQ(acks[0].first_sample_time_ns, 15 * kMs);
  EXPECT_EQ(acks[0].first_sequence, 2U);
  EXPECT_EQ(acks[0].run_id, sample(0, 0).run_id);
  EXPECT_TRUE(d.acknowledge(sample(20 * kMs, 3)).empty());
}

TEST(ProfileDesk, ALaterEntryOfOneInstantSupersedesTheEarlierOfItsKind) {
  ProfileDesk d = desk();
  d.add(entry(1, 10 * kMs, errors(1.0)));
  d.add(entry(2, 10 * kMs, errors(2.0)));
  InstallationProfile arm;
  arm.lever_arm_v_m.x() = 1.0;
  d.add(entry(3, 10 * kMs, arm));
  EXPECT_EQ(numbers_of(d.take_due(15 * kMs)), (Numbers{2, 3}));
  const auto acks = d.acknowledge(sample(15 * kMs, 2));
  ASSERT_EQ(acks.size(), 3U);
  EXPECT_EQ(acks[0].journal_number, 1U);
  EXPECT_EQ(acks[0].outcome, AckOutcome::Superseded);
  EXPECT_EQ(acks[1].outcome, AckOutcome::Applied);
  EXPECT_EQ(acks[2].outcome, AckOutcome::Applied);
}

TEST(ProfileDesk, AnEntryUnderWhichNoSampleCameOutIsSupersededToo) {
  ProfileDesk d = desk();
  d.add(entry(1, 10 * kMs, errors(1.0)));
  d.add(entry(2, 20 * kMs, errors(2.0)));
  EXPECT_EQ(numbers_of(d.take_due(15 * kMs)), Numbers{1});  // no sample: a receiver without a fix
  EXPECT_EQ(numbers_of(d.take_due(25 * kMs)), Numbers{2});
  const auto acks = d.acknowledge(sample(25 * kMs, 4));
  ASSERT_EQ(acks.size(), 2U);
  EXPECT_EQ(acks[0].outcome, AckOutcome::Superseded);
  EXPECT_EQ(acks[1].outcome, AckOutcome::Applied);
}

TEST(ProfileDesk, TheSameParametersAreUnchangedUnlessStatesAreToBeginAfresh) {
  ProfileDesk d = desk();
  d.add(entry(1, 10 * kMs, errors(0.1)));
  EXPECT_TRUE(d.take_due(15 * kMs).empty());
  auto acks = d.acknowledge(sample(15 * kMs, 2));
  ASSERT_EQ(acks.size(), 1U);
  EXPECT_EQ(acks[0].outcome, AckOutcome::Unchanged);

  ImuErrorProfile redrawn = errors(0.1);
  redrawn.request.continuity = Continuity::Redraw;
  d.add(entry(2, 20 * kMs, redrawn));
  EXPECT_EQ(numbers_of(d.take_due(25 * kMs)), Numbers{2});
  acks = d.acknowledge(sample(25 * kMs, 4));
  ASSERT_EQ(acks.size(), 1U);
  EXPECT_EQ(acks[0].outcome, AckOutcome::Applied);
}

TEST(ProfileDesk, ComparesWithWhatIsInUseNow) {
  ProfileDesk d = desk();
  d.add(entry(1, 10 * kMs, errors(1.0)));
  d.add(entry(2, 20 * kMs, errors(0.1)));
  EXPECT_EQ(numbers_of(d.take_due(15 * kMs)), Numbers{1});
  EXPECT_EQ(numbers_of(d.take_due(25 * kMs)), Numbers{2});
}

TEST(ProfileDesk, RejectsAtTheEndWhatNoSampleCameOutUnder) {
  ProfileDesk d = desk();
  d.add(entry(1, 10 * kMs, errors(1.0)));
  d.add(entry(2, 40 * kMs, errors(2.0)));
  d.add(entry(3, 15 * kMs, errors(3.0), {SensorKind::Imu, 7}));
  EXPECT_EQ(numbers_of(d.take_due(15 * kMs)), Numbers{1});  // and no sample comes any more
  RunId run;
  run.bytes.fill(9);
  const std::vector<ProfileAck> acks = d.close(run);
  ASSERT_EQ(acks.size(), 2U) << "those of this sensor";
  for (const ProfileAck& ack : acks) {
    EXPECT_EQ(ack.outcome, AckOutcome::Rejected);
    EXPECT_EQ(ack.field, "request.apply_at_ns");
    EXPECT_EQ(ack.reason, "the run ended before imu0 put out a sample under it");
    EXPECT_EQ(ack.run_id, run);
  }
  EXPECT_EQ(acks[0].journal_number, 1U);
  EXPECT_EQ(acks[1].journal_number, 2U);
  EXPECT_TRUE(d.close(run).empty());
}

/// What a service that was killed goes on with in another process.
ProfileDesk resumed(const ProfileDesk& before) {
  std::vector<std::uint8_t> bytes;
  state::StateWriter writer(bytes);
  writer(before);
  ProfileDesk after = desk();
  state::StateReader reader(bytes.data(), bytes.size());
  reader(after);
  return after;
}

TEST(ProfileDesk, ThatGoesOnNeedsNoEntryThatHasBeenTaken) {
  ProfileDesk before = desk();
  for (std::uint32_t i = 1; i <= 30'000; ++i) before.add(entry(i, i * kMs, errors(i)));
  before.add(entry(30'001, 40'000 * kMs, errors(7.0)));
  before.take_due(30'000 * kMs + 1);
  ProfileDesk after = resumed(before);
  EXPECT_TRUE(after.complete_for(truth(40'000 * kMs, 30'000)));
  EXPECT_FALSE(after.complete_for(truth(40'005 * kMs, 30'001)));
  after.add(entry(30'000, 30'000 * kMs, errors(30'000.0)));  // come again with the journal
  EXPECT_FALSE(after.complete_for(truth(40'005 * kMs, 30'001)));
  after.add(entry(30'001, 40'000 * kMs, errors(7.0)));
  EXPECT_TRUE(after.complete_for(truth(40'005 * kMs, 30'001)));
  EXPECT_EQ(numbers_of(after.take_due(40'005 * kMs)), Numbers{30'001});
}

TEST(ProfileDesk, HoldsNothingOfWhatHasBeenTaken) {
  ProfileDesk d = desk();
  const auto size = [&d] {
    std::vector<std::uint8_t> bytes;
    state::StateWriter writer(bytes);
    writer(d);
    return bytes.size();
  };
  d.add(entry(1, kMs, errors(1.0)));
  d.take_due(2 * kMs);
  d.acknowledge(sample(2 * kMs, 1));
  const std::size_t after_one = size();
  for (std::uint32_t i = 2; i <= 1000; ++i) {
    d.add(entry(i, i * kMs, errors(i)));
    d.take_due(i * kMs + 1);
    d.acknowledge(sample(i * kMs + 1, i));
  }
  EXPECT_EQ(size(), after_one);
}

}  // namespace profile_desk_test
}  // namespace inslab::sim
