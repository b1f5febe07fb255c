// A hundred swaps a second from two writers, while a third one sends garbage.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <limits>
#include <random>
#include <thread>

#include "inslab/bus/client/run_client.hpp"
#include "inslab/bus/service/service.hpp"
#include "inslab/scenario/load.hpp"
#include "tests/dds/any_bytes.hpp"
#include "tests/e2e/logged_samples.hpp"
#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace swap_storm_test {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr SensorAddress kImu{SensorKind::Imu, 0};
constexpr SensorAddress kReceiver{SensorKind::Gnss, 0};

/// Some seconds in every test run; INSLAB_STORM_SECONDS asks for more.
std::chrono::nanoseconds length_of_the_storm() {
  const char* asked = std::getenv("INSLAB_STORM_SECONDS");
  return seconds(asked == nullptr ? 6 : std::atoi(asked));
}

dds::ParticipantOptions network(const char* name) {
  service::NetworkOptions options;
  options.domain = static_cast<std::uint32_t>(std::stoul(own_domain()));
  return service::participant_options(options, name);
}

/// The profiles that the storm hurls about, a different one each time.
class Profiles {
 public:
  const catalog::AnyProfile& next() { return profiles_[next_++ % profiles_.size()]; }

 private:
  static catalog::AnyProfile load(const std::string& path, ProfileKind kind, const SensorAddress& target) {
    return scenario::load_profile(source("config/profiles/" + path), kind, target);
  }
  std::vector<catalog::AnyProfile> profiles_{
      load("imu/mems_automotive.json", ProfileKind::ImuError, kImu),
      load("vibration/car.json", ProfileKind::Vibration, kImu),
      load("installation/imu_trunk_tilted.json", ProfileKind::Installation, kImu),
      load("gnss/rtk.json", ProfileKind::GnssError, kReceiver),
      load("installation/antenna_roof.json", ProfileKind::Installation, kReceiver),
      load("imu/stim300.json", ProfileKind::ImuError, kImu),
      load("vibration/rotorcraft.json", ProfileKind::Vibration, kImu),
      load("installation/imu_cabin.json", ProfileKind::Installation, kImu),
      load("gnss/single_point.json", ProfileKind::GnssError, kReceiver),
      load("installation/antenna_trunk.json", ProfileKind::Installation, kReceiver),
      load("imu/pos830.json", ProfileKind::ImuError, kImu),
  };
  std::size_t next_ = 0;
};

/// One of the benches that swap at the same time.
class Bench {
 public:
  Bench(const char* name, std::uint64_t first_id) : participant_(network(name)), client_(participant_), id_(first_id) {}

  bool connected() const { return client_.connected(); }
  void swap(catalog::AnyProfile profile) {
    catalog::request_of(profile).request_id = id_;
    ASSERT_TRUE(client_.send(profile));
    sent_.push_back(id_++);
  }
  const std::vector<std::uint64_t>& sent() const { return sent_; }
  std::size_t unanswered() const {
    return static_cast<std::size_t>(
        std::count_if(sent_.begin(), sent_.end(), [this](auto id) { return client_.acks(id).empty(); }));
  }
  client::RunClient& client() { return client_; }

 private:
  dds::Participant participant_;
  client::RunClient client_;
  std::uint64_t id_;
  std::vector<std::uint64_t> sent_;
};

/// Writes to the request topic what no profile is: random bytes, and profiles with values beyond all limits.
class Hostile {
 public:
  Hostile() : participant_(network("hostile")), garbage_participant_(network("garbage")), client_(participant_) {
    eprosima::fastdds::dds::TypeSupport type(new dds::AnyBytes<ImuErrorProfile>());
    EXPECT_EQ(type.register_type(&garbage_participant_.dds()), eprosima::fastdds::dds::RETCODE_OK);
    const auto topic = dds::topics::request<ImuErrorProfile>();
    garbage_ =
        garbage_participant_.publisher().create_datawriter(&garbage_participant_.topic<ImuErrorProfile>(topic.name),
                                                           dds::writer_qos(topic.delivery, topic.nominal_rate_hz));
  }
  ~Hostile() { garbage_participant_.publisher().delete_datawriter(garbage_); }
  Hostile(const Hostile&) = delete;
  Hostile& operator=(const Hostile&) = delete;

  void attack(ImuErrorProfile profile) {
    dds::Bytes bytes(4 + random_() % 3000);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random_());
    garbage_->write(&bytes);
    constexpr double kBad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.0,
                               1e300};
    profile.gyro.arw_deg_per_sqrt_h[static_cast<int>(attacks_ % 3)] = kBad[attacks_ % 4];
    profile.request.request_id = kFirstId + attacks_++;
    ASSERT_TRUE(client_.send(catalog::AnyProfile(profile)));
  }
  std::uint64_t attacks() const { return attacks_; }
  std::vector<ProfileAck> answer(std::uint64_t attack) const { return client_.acks(kFirstId + attack); }

 private:
  static constexpr std::uint64_t kFirstId = 9'000'000;
  dds::Participant participant_;
  dds::Participant garbage_participant_;
  client::RunClient client_;
  eprosima::fastdds::dds::DataWriter* garbage_ = nullptr;
  std::mt19937 random_{20261125};
  std::uint64_t attacks_ = 0;
};

/// Which revision of one kind each sample of a sensor has by the acknowledgements: first sequence -> journal number. An
/// entry that changes nothing (UNCHANGED) makes no revision.
std::map<std::uint64_t, std::uint32_t> revisions_by_acks(Bench& a, Bench& b, ProfileKind kind,
                                                         const SensorAddress& target) {
  std::map<std::uint64_t, std::uint32_t> revisions{{0, 0}};
  for (Bench* bench : {&a, &b}) {
    for (const std::uint64_t id : bench->sent()) {
      const ProfileAck ack = bench->client().acks(id).front();
      if (ack.kind == kind && ack.target == target && ack.outcome == AckOutcome::Applied) {
        revisions[ack.first_sequence] = ack.journal_number;
      }
    }
  }
  return revisions;
}

/// Expects that samples are numbered from 0 without a gap and that each was made under the revision of the acks.
template <class Sample, class Revision>
void expect_revisions(const std::vector<Sample>& samples, const std::map<std::uint64_t, std::uint32_t>& by_acks,
                      const Revision& revision) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    ASSERT_EQ(samples[i].header.sequence_number, i);
    const std::uint32_t expected = std::prev(by_acks.upper_bound(i))->second;
    ASSERT_EQ(revision(samples[i]), expected) << "sample " << i;
  }
}

TEST(SwapStorm, OfAHundredASecondLosesNoSampleAndNoAnswer) {
  const TestFolder folder;
  const std::string log = folder / "storm.mcap";
  Process run("inslab", {"run", source("tests/data/storm.json"), "--domain", own_domain(), "--log", log});
  Bench bench_a("bench-a", 1'000'000);
  Bench bench_b("bench-b", 2'000'000);
  Hostile hostile;
  ASSERT_TRUE(eventually(
      [&] {
        const auto status = bench_a.client().status();
        return bench_a.connected() && bench_b.connected() && status && status->state == RunState::Running;
      },
      seconds(60)))
      << run.output();

  Profiles profiles;
  const auto bad = std::get<ImuErrorProfile>(
      scenario::load_profile(source("config/profiles/imu/stim300.json"), ProfileKind::ImuError, kImu));
  const auto begin = std::chrono::steady_clock::now();
  const auto swaps = static_cast<int>(length_of_the_storm() / milliseconds(10));
  for (int i = 0; i < swaps; ++i) {
    (i % 2 == 0 ? bench_a : bench_b).swap(profiles.next());
    if (i % 20 == 0) hostile.attack(bad);
    std::this_thread::sleep_until(begin + (i + 1) * milliseconds(10));
  }
  EXPECT_TRUE(eventually([&] { return bench_a.unanswered() + bench_b.unanswered() == 0; }, seconds(30)))
      << bench_a.unanswered() << " and " << bench_b.unanswered() << " of " << swaps << " swaps were not answered";
  for (std::uint64_t i = 0; i < hostile.attacks(); ++i) {
    ASSERT_TRUE(eventually([&] { return !hostile.answer(i).empty(); }, seconds(30))) << "attack " << i;
    EXPECT_EQ(hostile.answer(i).front().outcome, AckOutcome::Rejected);
    EXPECT_THAT(hostile.answer(i).front().field, testing::HasSubstr("arw_deg_per_sqrt_h"));
  }
  Process stop("inslab", {"stop", "--domain", own_domain()});
  EXPECT_EQ(stop.wait(seconds(30)), 0) << stop.output();
  EXPECT_EQ(run.wait(seconds(90)), 1) << run.output();  // it was not to its end
  EXPECT_THAT(run.output(), testing::HasSubstr("stopped"));
  ASSERT_EQ(bench_a.unanswered() + bench_b.unanswered(), 0u) << run.output();

  for (Bench* bench : {&bench_a, &bench_b}) {
    for (const std::uint64_t id : bench->sent()) {
      ASSERT_EQ(bench->client().acks(id).size(), 1u) << "request " << id;
      ASSERT_NE(bench->client().acks(id).front().outcome, AckOutcome::Rejected)
          << bench->client().acks(id).front().field << bench->client().acks(id).front().reason;
    }
  }
  const auto acks = [&](ProfileKind kind, const SensorAddress& target) {
    return revisions_by_acks(bench_a, bench_b, kind, target);
  };
  const auto imu = samples_of<ImuSample>(log, "inslab/imu/0");
  const auto fixes = samples_of<GnssFix>(log, "inslab/gnss/0");
  const auto truth = samples_of<TruthState>(log, "inslab/truth");
  ASSERT_GT(imu.size(), 200u);
  EXPECT_EQ(truth.size(), imu.size() + 1);
  expect_revisions(imu, acks(ProfileKind::ImuError, kImu), [](const auto& s) { return s.revisions.imu_error; });
  expect_revisions(imu, acks(ProfileKind::Vibration, kImu), [](const auto& s) { return s.revisions.vibration; });
  expect_revisions(imu, acks(ProfileKind::Installation, kImu), [](const auto& s) { return s.revisions.installation; });
  expect_revisions(fixes, acks(ProfileKind::GnssError, kReceiver),
                   [](const auto& s) { return s.revisions.gnss_error; });
  expect_revisions(fixes, acks(ProfileKind::Installation, kReceiver),
                   [](const auto& s) { return s.revisions.installation; });
}

}  // namespace swap_storm_test
}  // namespace inslab::e2e
