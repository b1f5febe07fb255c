#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <atomic>
#include <fastdds/dds/log/Log.hpp>
#include <filesystem>
#include <map>
#include <mutex>
#include <sstream>
#include <thread>

#include "inslab/bus/dds/discovery.hpp"
#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/dds/writer.hpp"
#include "tests/dds/keys.hpp"

namespace inslab::dds {
namespace security_test {

using std::chrono::seconds;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

ParticipantOptions options(const std::string& role, const std::string& keys) {
  ParticipantOptions options;
  options.name = role;
  options.domain = 40 + static_cast<std::uint32_t>(getpid() % 150);
  options.security = keys;
  options.role = role;
  return options;
}

template <class Condition>
bool eventually(Condition condition, std::chrono::nanoseconds timeout = seconds(20)) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::yield();
  }
  return true;
}

/// The keys of one authority for all tests.
class Security : public testing::Test {
 protected:
  static void SetUpTestSuite() { keys_ = new Keys(); }
  static void TearDownTestSuite() {
    delete keys_;
    keys_ = nullptr;
  }
  void SetUp() override { ASSERT_TRUE(keys_->made()) << "deploy/security/make-keys failed"; }

  static Keys* keys_;
};
Keys* Security::keys_ = nullptr;

TEST_F(Security, RolesExchangeWhatTheyMay) {
  Participant server(options("inslab-trajectory-server", keys_->path()));
  Participant logger(options("inslab-truth-logger", keys_->path()));
  std::atomic<int> received{0};
  Reader<TruthState> reader(logger, topics::truth(), [&](const TruthState&, const SampleOrigin&) { ++received; });
  Writer<TruthState> writer(server, topics::truth());
  ASSERT_TRUE(eventually([&] { return writer.matched_readers() == 1 && reader.matched_writers() == 1; }));
  EXPECT_TRUE(writer.write(TruthState()));
  EXPECT_TRUE(eventually([&] { return received == 1; }));
}

TEST_F(Security, WithoutACertificateNothingIsSeenAndNothingIsInjected) {
  Participant server(options("inslab-trajectory-server", keys_->path()));
  Participant operator_(options("operator", keys_->path()));
  Participant stranger(options("stranger", ""));
  std::atomic<int> requests{0};
  std::atomic<int> overheard{0};
  Reader<FaultProfile> request_reader(server, topics::request<FaultProfile>(),
                                      [&](const FaultProfile&, const SampleOrigin&) { ++requests; });
  Writer<SimStatus> status(server, topics::sim_status());
  Reader<SimStatus> eavesdropper(stranger, topics::sim_status(),
                                 [&](const SimStatus&, const SampleOrigin&) { ++overheard; });
  Writer<FaultProfile> injector(stranger, topics::request<FaultProfile>());
  Writer<FaultProfile> rightful(operator_, topics::request<FaultProfile>());
  // Once the rightful writer has come through, the stranger, who started before it, has had its time too.
  ASSERT_TRUE(eventually([&] { return rightful.matched_readers() == 1; }));
  status.write(SimStatus());
  injector.write(FaultProfile());
  rightful.write(FaultProfile());
  ASSERT_TRUE(eventually([&] { return requests >= 1; }));
  EXPECT_EQ(requests, 1);
  EXPECT_EQ(overheard, 0);
  EXPECT_EQ(injector.matched_readers(), 0);
  EXPECT_EQ(eavesdropper.matched_writers(), 0);
}

/// What is logged while it lives.
class LogCapture {
 public:
  LogCapture() : before_(spdlog::default_logger()) {
    spdlog::set_default_logger(
        std::make_shared<spdlog::logger>("captured", std::make_shared<spdlog::sinks::ostream_sink_mt>(text_)));
  }
  ~LogCapture() { spdlog::set_default_logger(before_); }
  LogCapture(const LogCapture&) = delete;
  LogCapture& operator=(const LogCapture&) = delete;

  /// With all that Fast DDS has said so far.
  std::string text() const {
    eprosima::fastdds::dds::Log::Flush();
    return text_.str();
  }

 private:
  std::shared_ptr<spdlog::logger> before_;
  std::ostringstream text_;
};

TEST_F(Security, AnOpenReaderHandsEverySampleOnOnceAndComplainsOfNothing) {
  constexpr std::uint64_t kRequests = 50;
  const LogCapture log;
  {
    Participant server(options("inslab-trajectory-server", keys_->path()));
    Participant operator_(options("operator", keys_->path()));
    std::mutex mutex;
    std::map<std::uint64_t, int> came;
    OpenReader<FaultProfile> reader(server, topics::request<FaultProfile>(),
                                    [&](const FaultProfile& profile, const SampleOrigin&) {
                                      const std::lock_guard<std::mutex> lock(mutex);
                                      ++came[profile.request.request_id];
                                    });
    Writer<FaultProfile> writer(operator_, topics::request<FaultProfile>());
    ASSERT_TRUE(eventually([&] { return writer.matched_readers() == 2 && reader.matched_writers() == 1; }));
    for (std::uint64_t i = 0; i < kRequests; ++i) {
      FaultProfile profile;
      profile.request.request_id = i;
      ASSERT_TRUE(writer.write(profile));
    }
    EXPECT_TRUE(eventually([&] {
      const std::lock_guard<std::mutex> lock(mutex);
      return came.size() == kRequests;
    }));
    EXPECT_TRUE(writer.wait_for_acknowledgments(seconds(20)));  // both readers have had theirs
    const std::lock_guard<std::mutex> lock(mutex);
    for (const auto& [id, times] : came) EXPECT_EQ(times, 1) << id;
  }
  EXPECT_THAT(log.text(), Not(HasSubstr("Fast DDS: ")));
}

TEST_F(Security, ALoggerMayNotWriteProfiles) {
  Participant logger(options("inslab-truth-logger", keys_->path()));
  EXPECT_THROW(Writer<FaultProfile>(logger, topics::request<FaultProfile>()), std::runtime_error);
}

TEST_F(Security, AnAppUnderTestMayNotReadTheTruth) {
  Participant app(options("nav-app", keys_->path()));
  EXPECT_THROW(Reader<TruthState>(app, topics::truth(), [](const TruthState&, const SampleOrigin&) {}),
               std::runtime_error);
}

TEST_F(Security, AForeignCertificateIsRefusedByName) {
  const Keys others;
  ASSERT_TRUE(others.made());
  std::filesystem::copy_file(others.path() + "/operator.cert.pem", keys_->path() + "/intruder.cert.pem",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_THAT([this] { Participant participant(options("intruder", keys_->path())); },
              ThrowsMessage<std::runtime_error>(HasSubstr("intruder.cert.pem: ")));
}

TEST_F(Security, APeerOfAnotherAuthorityIsNotHeard) {
  const Keys others;
  ASSERT_TRUE(others.made());
  Participant server(options("inslab-trajectory-server", keys_->path()));
  Participant stranger(options("operator", others.path()));
  Participant rightful(options("operator", keys_->path()));
  std::atomic<int> requests{0};
  Reader<FaultProfile> reader(server, topics::request<FaultProfile>(),
                              [&](const FaultProfile&, const SampleOrigin&) { ++requests; });
  Writer<FaultProfile> intruding(stranger, topics::request<FaultProfile>());
  Writer<FaultProfile> writer(rightful, topics::request<FaultProfile>());
  ASSERT_TRUE(eventually([&] { return writer.matched_readers() == 1; }));
  intruding.write(FaultProfile());
  writer.write(FaultProfile());
  ASSERT_TRUE(eventually([&] { return requests >= 1; }));
  EXPECT_EQ(requests, 1);
  EXPECT_EQ(intruding.matched_readers(), 0);
}

}  // namespace security_test
}  // namespace inslab::dds
