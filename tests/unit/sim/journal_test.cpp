#include "inslab/sim/journal.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "inslab/foundation/fields/limits.hpp"

namespace inslab::sim {
namespace journal_test {

using namespace std::chrono_literals;

const SensorAddress kImu{SensorKind::Imu, 0};
const SensorAddress kGnss{SensorKind::Gnss, 0};

/// A 200 Hz grid: 5 ms.
constexpr time::Nanoseconds kEnd = 2h;
Journal journal() { return Journal({kImu, kGnss}, time::Rate(200.0), kEnd); }

ImuErrorProfile imu_errors(std::int64_t apply_at_ns = -1) {
  ImuErrorProfile profile;
  profile.target = kImu;
  profile.request.request_id = 42;
  profile.request.apply_at_ns = apply_at_ns;
  return profile;
}

ProfileRequest accepted(const std::variant<catalog::AnyProfile, ProfileAck>& verdict) {
  const auto* entry = std::get_if<catalog::AnyProfile>(&verdict);
  if (entry == nullptr) {
    ADD_FAILURE() << "rejected: " << std::get<ProfileAck>(verdict).field << " " << std::get<ProfileAck>(verdict).reason;
    return {};
  }
  return catalog::request_of(*entry);
}

ProfileAck rejected(const std::variant<catalog::AnyProfile, ProfileAck>& verdict) {
  const auto* ack = std::get_if<ProfileAck>(&verdict);
  if (ack == nullptr) {
    ADD_FAILURE() << "accepted";
    return {};
  }
  EXPECT_EQ(ack->outcome, AckOutcome::Rejected);
  EXPECT_EQ(ack->journal_number, 0U);
  return *ack;
}

TEST(Journal, NumbersEntriesFromOneAcrossTheKinds) {
  Journal j = journal();
  EXPECT_EQ(accepted(j.submit(imu_errors(), 0ns)).journal_number, 1U);
  GnssErrorProfile gnss;
  gnss.fix_type = FixType::Single;
  EXPECT_EQ(accepted(j.submit(gnss, 0ns)).journal_number, 2U);
  InstallationProfile arm;
  arm.target = kGnss;
  EXPECT_EQ(accepted(j.submit(arm, 0ns)).journal_number, 3U);
  EXPECT_EQ(j.size(), 3U);
}

TEST(Journal, IgnoresANumberThatTheRequestBrings) {
  Journal j = journal();
  ImuErrorProfile profile = imu_errors();
  profile.request.journal_number = 99;
  profile.request.requested_at_ns = 99;
  profile.request.requested_in_the_past = true;
  const ProfileRequest entry = accepted(j.submit(profile, 0ns));
  EXPECT_EQ(entry.journal_number, 1U);
  EXPECT_EQ(entry.requested_at_ns, -1);
  EXPECT_FALSE(entry.requested_in_the_past);
}

TEST(Journal, SettlesTheTimeOnTheGridAtOrAfterTheRequest) {
  Journal j = journal();
  EXPECT_EQ(accepted(j.submit(imu_errors(10'000'000), 0ns)).apply_at_ns, 10'000'000);
  EXPECT_EQ(accepted(j.submit(imu_errors(10'000'001), 0ns)).apply_at_ns, 15'000'000);
  EXPECT_EQ(accepted(j.submit(imu_errors(14'999'999), 0ns)).apply_at_ns, 15'000'000);
  EXPECT_EQ(accepted(j.submit(imu_errors(1), 0ns)).requested_at_ns, 1);
}

TEST(Journal, AppliesAtOnceWhatIsAskedForThePastAndSaysSo) {
  Journal j = journal();
  const ProfileRequest late = accepted(j.submit(imu_errors(10'000'000), 20ms));
  EXPECT_EQ(late.apply_at_ns, 20'000'000);
  EXPECT_EQ(late.requested_at_ns, 10'000'000);
  EXPECT_TRUE(late.requested_in_the_past);
  const ProfileRequest at_once = accepted(j.submit(imu_errors(-1), 20ms));
  EXPECT_EQ(at_once.apply_at_ns, 20'000'000);
  EXPECT_FALSE(at_once.requested_in_the_past);
  EXPECT_FALSE(accepted(j.submit(imu_errors(20'000'000), 20ms)).requested_in_the_past);
}

TEST(Journal, IsInEffectForTheSamplesAfterTheTime) {
  Journal j = journal();
  j.submit(imu_errors(30'000'000), 0ns);
  j.submit(imu_errors(10'000'000), 0ns);
  j.submit(imu_errors(10'000'000), 0ns);
  EXPECT_EQ(j.in_effect(0ns), 0U);
  EXPECT_EQ(j.in_effect(10ms), 0U);
  EXPECT_EQ(j.in_effect(15ms), 2U);
  EXPECT_EQ(j.in_effect(30ms), 2U);
  EXPECT_EQ(j.in_effect(35ms), 3U);
}

TEST(Journal, ARejectionNamesTheFieldAndChangesNothing) {
  Journal j = journal();
  ImuErrorProfile broken = imu_errors(10'000'000);
  broken.gyro.arw_deg_per_sqrt_h.y() = std::nan("");
  const ProfileAck ack = rejected(j.submit(broken, 0ns));
  EXPECT_EQ(ack.field, "gyro.arw_deg_per_sqrt_h[1]");
  EXPECT_EQ(ack.reason, "is nan; expected 0 to 1000");
  EXPECT_EQ(ack.request_id, 42U);
  EXPECT_EQ(ack.kind, ProfileKind::ImuError);
  EXPECT_EQ(ack.target, kImu);
  EXPECT_EQ(ack.requested_time_ns, 10'000'000);
  EXPECT_EQ(j.size(), 0U);
  EXPECT_EQ(j.in_effect(1h), 0U);
  EXPECT_EQ(accepted(j.submit(imu_errors(), 0ns)).journal_number, 1U);
}

TEST(Journal, RejectsWhatBreaksARuleOfSeveralFields) {
  Journal j = journal();
  ImuErrorProfile profile = imu_errors();
  profile.gyro.bias_gm_sigma_deg_per_h.x() = 1.0;
  EXPECT_EQ(rejected(j.submit(profile, 0ns)).field, "gyro.bias_gm_correlation_time_s[0]");
  ImuErrorProfile fading = imu_errors();
  fading.request.fade_s = 1.0;
  EXPECT_EQ(rejected(j.submit(fading, 0ns)).field, "request.fade_s");
}

TEST(Journal, RejectsASensorThatTheUnitDoesNotHave) {
  Journal j = journal();
  ImuErrorProfile profile = imu_errors();
  profile.target.number = 3;
  const ProfileAck ack = rejected(j.submit(profile, 0ns));
  EXPECT_EQ(ack.field, "target_number");
  EXPECT_NE(ack.reason.find("imu3"), std::string::npos);
}

TEST(Journal, RejectsWhatNoSampleWouldComeOutUnder) {
  Journal j = journal();
  EXPECT_EQ(accepted(j.submit(imu_errors((kEnd - 5ms).count()), 0ns)).apply_at_ns, (kEnd - 5ms).count());
  // Just before the end it would be in effect for the samples after the end, and there are none.
  for (const std::int64_t at : {(kEnd - 5ms).count() + 1, kEnd.count() - 1, kEnd.count(), kEnd.count() + 1,
                                std::numeric_limits<std::int64_t>::max()}) {
    const ProfileAck ack = rejected(j.submit(imu_errors(at), 0ns));
    EXPECT_EQ(ack.field, "request.apply_at_ns");
    EXPECT_EQ(ack.reason, "lies at or after the end of the run at 7200.000 s: no sample would come out under it");
  }
  EXPECT_EQ(rejected(j.submit(imu_errors(), kEnd)).field, "request.apply_at_ns") << "as soon as possible is too late";
}

TEST(Journal, ARejectionFitsTheWire) {
  Journal j = journal();
  ImuErrorProfile profile = imu_errors();
  profile.name = std::string(100'000, 'n');
  EXPECT_FALSE(limit_violation(rejected(j.submit(profile, 0ns))).has_value());
}

}  // namespace journal_test
}  // namespace inslab::sim
