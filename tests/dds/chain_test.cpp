#include <gtest/gtest.h>

#include <condition_variable>
#include <ctime>
#include <map>
#include <mutex>
#include <thread>

#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/dds/writer.hpp"

namespace inslab::dds {

void PrintTo(Transport transport, std::ostream* out) { *out << (transport == Transport::Udp ? "udp" : "shm"); }

namespace chain_test {

using std::chrono::seconds;

/// Collects samples until a condition holds; every wait has a deadline.
template <class T>
class Collector {
 public:
  void add(const T& sample) {
    const std::lock_guard<std::mutex> lock(mutex_);
    samples_.push_back(sample);
    changed_.notify_all();
  }
  bool wait_for(std::size_t count, std::chrono::nanoseconds timeout = seconds(20)) {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, timeout, [&] { return samples_.size() >= count; });
  }
  std::vector<T> samples() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return samples_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<T> samples_;
};

template <class Condition>
bool eventually(Condition condition) {
  const auto deadline = std::chrono::steady_clock::now() + seconds(20);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::yield();
  }
  return true;
}

class Chain : public testing::TestWithParam<Transport> {
 protected:
  static std::uint32_t domain() { return 40 + static_cast<std::uint32_t>(getpid() % 150); }
  ParticipantOptions options(const std::string& name) const {
    ParticipantOptions options;
    options.name = name;
    options.domain = domain();
    options.transport = GetParam();
    return options;
  }
  Participant from_{options("from")};
  Participant to_{options("to")};
};

TEST_P(Chain, DeliversTenThousandSamplesInOrderAndToTheBit) {
  Collector<TruthState> received;
  const auto topic = topics::truth(1000.0);
  Reader<TruthState> reader(to_, topic, [&](const TruthState& s, const SampleOrigin&) { received.add(s); });
  Writer<TruthState> writer(from_, topic);
  ASSERT_TRUE(eventually([&] { return writer.matched_readers() == 1 && reader.matched_writers() == 1; }));

  constexpr std::size_t kSamples = 10'000;
  TruthState sample;
  for (std::size_t i = 0; i < kSamples; ++i) {
    sample.header.sequence_number = i;
    sample.latitude_rad = 0.1 / (1.0 + static_cast<double>(i));
    sample.q_nv = Quaternion(1.0, 1e-9 * static_cast<double>(i), 0.0, 0.0);
    ASSERT_TRUE(writer.write(sample));
    // Faster than any real run, yet inside the history of one second.
    if (i % 500 == 499) {
      ASSERT_TRUE(writer.wait_for_acknowledgments(seconds(10)));
    }
  }
  ASSERT_TRUE(received.wait_for(kSamples));
  const auto samples = received.samples();
  for (std::size_t i = 0; i < kSamples; ++i) {
    ASSERT_EQ(samples[i].header.sequence_number, i);
    ASSERT_EQ(samples[i].latitude_rad, 0.1 / (1.0 + static_cast<double>(i)));
    ASSERT_EQ(samples[i].q_nv.x(), 1e-9 * static_cast<double>(i));
  }
}

TEST_P(Chain, LateJoinerGetsTheWholeJournalInOrder) {
  const auto topic = topics::journal<InstallationProfile>();
  Writer<InstallationProfile> writer(from_, topic);
  for (std::uint32_t i = 1; i <= 50; ++i) {
    InstallationProfile entry;
    entry.target = {i % 2 == 0 ? SensorKind::Imu : SensorKind::Gnss, i % 3};
    entry.request.journal_number = i;
    ASSERT_TRUE(writer.write(entry));
  }
  Collector<InstallationProfile> received;
  Reader<InstallationProfile> reader(to_, topic,
                                     [&](const InstallationProfile& p, const SampleOrigin&) { received.add(p); });
  ASSERT_TRUE(received.wait_for(50));
  std::uint32_t expected = 1;
  for (const auto& entry : received.samples()) EXPECT_EQ(entry.request.journal_number, expected++);
}

/// Processor time, which other work on the machine does not lengthen.
double used_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

TEST_P(Chain, LateJoinerGetsALongJournalInTimeThatGrowsWithItsLength) {
  const auto topic = topics::journal<InstallationProfile>();
  constexpr std::uint32_t kEntries = 20'000;
  Writer<InstallationProfile> writer(from_, topic);
  for (std::uint32_t i = 1; i <= kEntries; ++i) {
    InstallationProfile entry;
    entry.request.journal_number = i;
    ASSERT_TRUE(writer.write(entry));
  }
  const double before_s = used_s();
  Collector<InstallationProfile> received;
  Reader<InstallationProfile> reader(to_, topic,
                                     [&](const InstallationProfile& p, const SampleOrigin&) { received.add(p); });
  ASSERT_TRUE(received.wait_for(kEntries, seconds(90)));
  EXPECT_LT(used_s() - before_s, 20.0);
  std::uint32_t expected = 1;
  for (const auto& entry : received.samples()) ASSERT_EQ(entry.request.journal_number, expected++);
}

TEST_P(Chain, LateJoinerGetsTheLastStatusOfEachService) {
  Writer<ServiceStatus> writer(from_, topics::service_status());
  for (int round = 0; round < 3; ++round) {
    for (std::uint32_t sensor = 0; sensor < 20; ++sensor) {
      ServiceStatus status;
      status.service = "a-service";
      status.sensor_number = sensor;
      status.overruns = static_cast<std::uint32_t>(round);
      ASSERT_TRUE(writer.write(status));
    }
  }
  Collector<ServiceStatus> received;
  Reader<ServiceStatus> reader(to_, topics::service_status(),
                               [&](const ServiceStatus& s, const SampleOrigin&) { received.add(s); });
  ASSERT_TRUE(received.wait_for(20));
  std::map<std::uint32_t, std::uint32_t> last;
  for (const auto& status : received.samples()) last[status.sensor_number] = status.overruns;
  EXPECT_EQ(last.size(), 20u);
  for (const auto& [sensor, overruns] : last) EXPECT_EQ(overruns, 2u) << "sensor " << sensor;
}

TEST_P(Chain, LateJoinerGetsTheAnswers) {
  Writer<ProfileAck> writer(from_, topics::profile_ack());
  for (std::uint64_t id = 0; id < 100; ++id) {
    ProfileAck ack;
    ack.request_id = id;
    ASSERT_TRUE(writer.write(ack));
  }
  Collector<ProfileAck> received;
  Reader<ProfileAck> reader(to_, topics::profile_ack(),
                            [&](const ProfileAck& ack, const SampleOrigin&) { received.add(ack); });
  ASSERT_TRUE(received.wait_for(100));
  std::uint64_t expected = 0;
  for (const ProfileAck& ack : received.samples()) EXPECT_EQ(ack.request_id, expected++);
}

TEST_P(Chain, ReceivedSampleKeepsTheBytesThatWereSent) {
  Collector<Received<GnssFix>> received;
  Reader<GnssFix> reader(to_, topics::stream<GnssFix>(0),
                         [&](const Received<GnssFix>& p, const SampleOrigin&) { received.add(p); });
  Writer<GnssFix> writer(from_, topics::stream<GnssFix>(0));
  ASSERT_TRUE(eventually([&] { return writer.matched_readers() == 1 && reader.matched_writers() == 1; }));
  GnssFix fix;
  fix.hdop = 0.7;
  ASSERT_TRUE(writer.write(fix));
  ASSERT_TRUE(received.wait_for(1));
  std::vector<std::uint8_t> expected;
  wire::encode(fix, expected);
  EXPECT_EQ(received.samples().front().cdr, expected);
}

TEST_P(Chain, OpenReaderHandsEverySampleOnOnce) {
  Collector<SimCommand> received;
  OpenReader<SimCommand> reader(to_, topics::sim_command(),
                                [&](const SimCommand& c, const SampleOrigin&) { received.add(c); });
  Writer<SimCommand> writer(from_, topics::sim_command());
  ASSERT_TRUE(eventually([&] { return writer.matched_readers() == 2 && reader.matched_writers() == 1; }));
  for (std::uint64_t i = 0; i < 50; ++i) ASSERT_TRUE(writer.write({i, CommandKind::Stop}));
  ASSERT_TRUE(writer.wait_for_acknowledgments(seconds(10)));
  ASSERT_TRUE(received.wait_for(50));
  EXPECT_EQ(received.samples().size(), 50u);
}

TEST_P(Chain, OpenReaderHandsEverySampleOnOnceWhateverCameBefore) {
  Collector<SimCommand> received;
  OpenReader<SimCommand> reader(to_, topics::sim_command(),
                                [&](const SimCommand& c, const SampleOrigin&) { received.add(c); });
  constexpr std::uint64_t kMany = 4300;
  constexpr std::uint64_t kFew = 200;
  const auto send = [&](Participant& from, int writers, std::uint64_t first, std::uint64_t count) {
    Writer<SimCommand> writer(from, topics::sim_command());
    ASSERT_TRUE(eventually([&] { return writer.matched_readers() == 2 && reader.matched_writers() == writers; }));
    for (std::uint64_t i = 0; i < count; ++i) {
      ASSERT_TRUE(writer.write({first + i, CommandKind::Step, 1.0}));
      if (i % 100 == 99) {
        ASSERT_TRUE(writer.wait_for_acknowledgments(seconds(10)));
      }
    }
    ASSERT_TRUE(writer.wait_for_acknowledgments(seconds(10)));
  };
  send(from_, 1, 0, kMany);
  ASSERT_TRUE(received.wait_for(kMany));
  ASSERT_TRUE(eventually([&] { return reader.matched_writers() == 0; }));
  // Another client, whose numbers begin anew and are smaller than all that came before.
  send(from_, 1, kMany, kFew);
  ASSERT_TRUE(received.wait_for(kMany + kFew));
  std::map<std::uint64_t, int> times;
  for (const SimCommand& command : received.samples()) ++times[command.request_id];
  EXPECT_EQ(times.size(), kMany + kFew);
  for (const auto& [id, count] : times) EXPECT_EQ(count, 1) << "request " << id;
}

TEST_P(Chain, UnitsDoNotHearEachOther) {
  auto in_unit = [&](const std::string& unit) {
    ParticipantOptions unit_options = options("unit");
    unit_options.unit = unit;
    return unit_options;
  };
  Participant alpha(in_unit("alpha"));
  Participant also_alpha(in_unit("alpha"));
  Participant beta(in_unit("beta"));
  Collector<TruthState> heard_by_alpha;
  Collector<TruthState> heard_by_beta;
  Reader<TruthState> alpha_reader(also_alpha, topics::truth(),
                                  [&](const TruthState& s, const SampleOrigin&) { heard_by_alpha.add(s); });
  Reader<TruthState> beta_reader(beta, topics::truth(),
                                 [&](const TruthState& s, const SampleOrigin&) { heard_by_beta.add(s); });
  Writer<TruthState> writer(alpha, topics::truth());
  // The writer must know its reader too: what it sends before is for nobody.
  ASSERT_TRUE(eventually([&] { return alpha_reader.matched_writers() == 1 && writer.matched_readers() == 1; }));
  ASSERT_TRUE(writer.write({}));
  ASSERT_TRUE(heard_by_alpha.wait_for(1));
  EXPECT_EQ(beta_reader.matched_writers(), 0);
  EXPECT_TRUE(heard_by_beta.samples().empty());
}

INSTANTIATE_TEST_SUITE_P(Transports, Chain, testing::Values(Transport::Udp, Transport::Shm),
                         [](const auto& instance) { return instance.param == Transport::Udp ? "Udp" : "Shm"; });

}  // namespace chain_test
}  // namespace inslab::dds
