// The tools that look at a running set: topics, doctor, status.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <memory>
#include <regex>

#include "inslab/bus/dds/typed_topics.hpp"
#include "inslab/bus/dds/writer.hpp"
#include "inslab/bus/service/service.hpp"
#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace bench_tools_test {

using std::chrono::seconds;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

/// What `inslab` printed and its exit code.
struct Answer {
  int code;
  std::string text;
};

Answer inslab(std::vector<std::string> words) {
  words.insert(words.end(), {"--domain", own_domain()});
  Process process("inslab", words);
  const int code = process.wait(seconds(60)).value_or(-1);
  return {code, process.output()};
}

dds::ParticipantOptions network(const char* name) {
  service::NetworkOptions options;
  options.domain = static_cast<std::uint32_t>(std::stoul(own_domain()));
  return service::participant_options(options, name);
}

/// A set that runs for as long as the tests of this suite need it.
class BenchTools : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TestFolder>();
    set_ =
        std::make_unique<Process>("inslab", std::vector<std::string>{"run", source("tests/data/storm.json"), "--log",
                                                                     *folder_ / "live.mcap", "--domain", own_domain()});
    ASSERT_TRUE(set_->prints(" of 3600.0 s", seconds(60))) << set_->output();
  }
  static void TearDownTestSuite() {
    set_->send(SIGTERM);
    set_->wait(seconds(60));
    set_.reset();
    folder_.reset();
  }

  static std::unique_ptr<TestFolder> folder_;
  static std::unique_ptr<Process> set_;
};
std::unique_ptr<TestFolder> BenchTools::folder_;
std::unique_ptr<Process> BenchTools::set_;

TEST_F(BenchTools, ListTheTopicsWithTheirTypesAndEnds) {
  const Answer answer = inslab({"topics", "ls"});
  EXPECT_EQ(answer.code, 0) << answer.text;
  // Written by the injector, read by the logger.
  EXPECT_THAT(answer.text, ContainsRegex("inslab/imu/0 +inslab::v5::ImuSample +1 +1"));
  EXPECT_THAT(answer.text, ContainsRegex("inslab/profile/imu_error +inslab::v5::ImuErrorProfile +1 +[24]"));
}

TEST_F(BenchTools, EchoTheFieldsOfMessages) {
  const Answer answer = inslab({"topics", "echo", "inslab/gnss/0", "--count", "2", "--seconds", "40"});
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_THAT(answer.text, ContainsRegex("latitude_rad: 0\\.83"));
  EXPECT_THAT(answer.text, HasSubstr("fix_type: "));
  EXPECT_THAT(answer.text, HasSubstr("---"));
}

TEST_F(BenchTools, MeasureTheRateOfATopic) {
  const Answer answer = inslab({"topics", "hz", "inslab/imu/0", "--seconds", "3"});
  EXPECT_EQ(answer.code, 0) << answer.text;
  std::smatch found;
  ASSERT_TRUE(std::regex_search(answer.text, found, std::regex("inslab/imu/0: ([0-9.]+) Hz over"))) << answer.text;
  // The stream has 200 Hz by its clock; where it begins and ends the measurement misses a few.
  EXPECT_NEAR(std::stod(found[1]), 200.0, 20.0);
}

TEST_F(BenchTools, MeasureTheDelayOfATopic) {
  const Answer answer = inslab({"topics", "delay", "inslab/imu/0", "--seconds", "2"});
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_THAT(answer.text, ContainsRegex("inslab/imu/0: publish to receipt p50 [0-9]+\\.[0-9]+ ms, p99 "));
}

TEST_F(BenchTools, SayWhenATopicIsSilentOrUnknown) {
  const Answer silent = inslab({"topics", "hz", "inslab/nav", "--seconds", "1"});
  EXPECT_EQ(silent.code, 1);
  EXPECT_THAT(silent.text, HasSubstr("nothing came on inslab/nav"));
  const Answer unknown = inslab({"topics", "echo", "inslab/nothing", "--seconds", "1"});
  EXPECT_NE(unknown.code, 0);
  EXPECT_THAT(unknown.text, HasSubstr("inslab/nothing"));
}

TEST_F(BenchTools, ShowTheServicesOnce) {
  const Answer answer = inslab({"status", source("tests/data/storm.json")});
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("run: storm running"));
  EXPECT_THAT(answer.text, ContainsRegex("inslab-truth-logger +0 +running"));
  EXPECT_THAT(answer.text, Not(HasSubstr("MISSING")));
}

TEST_F(BenchTools, ShowALiveTableOnATerminal) {
  // script(1) lends a terminal.
  Process terminal("script", {"-qfec",
                              "timeout -s INT 15 " + source("build/bin/inslab") + " status --domain " + own_domain() +
                                  " " + source("tests/data/storm.json"),
                              "/dev/null"});
  EXPECT_TRUE(terminal.prints("inslab/imu_truth/0", seconds(30))) << terminal.output();
  terminal.wait(seconds(30));
  EXPECT_THAT(terminal.output(),
              ContainsRegex("inslab-imu-injector 0[\r\n]+.*[\r\n]* +inslab/imu/0 +out +[0-9]+ +[0-9.]+ +0"));
  EXPECT_THAT(terminal.output(), HasSubstr("\033[H\033[J"));
}

TEST_F(BenchTools, FindNothingWrongWithAGoodSet) {
  const Answer answer = inslab({"doctor"});
  EXPECT_THAT(answer.text, ContainsRegex("on the wire, domain [0-9]+, transport udp, interface 127.0.0.1"));
  EXPECT_THAT(answer.text, ContainsRegex("ok    [0-9]+ participants with [0-9]+ endpoints, no mismatch"));
  EXPECT_THAT(answer.text, ContainsRegex("net.core.rmem_max = [0-9]+"));
  EXPECT_THAT(answer.text, ContainsRegex("CLOCK_REALTIME is (not )?synchronised|whether the clock"));
}

TEST_F(BenchTools, FindAReaderOfOtherSettingsWithItsCure) {
  // An app that demands the history of a stream that keeps none.
  dds::Participant app(network("demanding-app"));
  auto qos = dds::reader_qos(dds::Delivery::Latched, 200.0);
  auto& topic = app.topic<ImuSample>("inslab/imu/0");
  auto* reader = app.subscriber().create_datareader(&topic, qos);
  ASSERT_NE(reader, nullptr);
  // Another that wants a sample each 50 ms promised, one writer alone, and its sign of life on the topic.
  qos = dds::reader_qos(dds::Delivery::Stream, 200.0);
  qos.deadline().period = {0, 50'000'000};
  qos.ownership().kind = eprosima::fastdds::dds::EXCLUSIVE_OWNERSHIP_QOS;
  qos.liveliness().kind = eprosima::fastdds::dds::MANUAL_BY_TOPIC_LIVELINESS_QOS;
  auto* demanding = app.subscriber().create_datareader(&topic, qos);
  ASSERT_NE(demanding, nullptr);
  const Answer answer = inslab({"doctor"});
  app.subscriber().delete_datareader(demanding);
  EXPECT_EQ(answer.code, 1);
  EXPECT_THAT(answer.text, HasSubstr("DEADLINE: the writer has period infinite, the reader wants period 50 ms"));
  EXPECT_THAT(answer.text, HasSubstr("OWNERSHIP: the writer has SHARED, the reader wants EXCLUSIVE"));
  EXPECT_THAT(answer.text, HasSubstr("LIVELINESS: the writer has AUTOMATIC, the reader wants MANUAL_BY_TOPIC"));
  EXPECT_THAT(answer.text,
              ContainsRegex("BAD   inslab/imu/0: writer in 'inslab-imu-injector' and reader in "
                            "'demanding-app' do not match: DURABILITY: the writer has VOLATILE, the reader wants "
                            "TRANSIENT_LOCAL"));
  EXPECT_THAT(answer.text, HasSubstr("cure: in 'demanding-app' set DURABILITY of the reader to VOLATILE"));
  app.subscriber().delete_datareader(reader);
}

TEST_F(BenchTools, FindAWriterOfAnotherType) {
  dds::Participant app(network("confused-app"));
  dds::Writer<GnssFix> writer(app, dds::Topic<GnssFix>{"inslab/nav", dds::Delivery::Request, 10.0});
  const Answer answer = inslab({"doctor"});
  EXPECT_EQ(answer.code, 1);
  EXPECT_THAT(answer.text, ContainsRegex("BAD   inslab/nav: writer in 'confused-app' and reader in "
                                         "'inslab-truth-logger' do not match: .*type"));
}

TEST_F(BenchTools, KnowTwoUnitsForWhatTheyAre) {
  Process other("inslab-trajectory-server",
                {"--scenario", source("tests/data/short.json"), "--unit", "other", "--domain", own_domain()});
  const Answer answer = inslab({"doctor"});
  EXPECT_THAT(answer.text, HasSubstr("note  2 units, which do not hear each other: one without a name, 'other'"));
  EXPECT_THAT(answer.text, HasSubstr("no mismatch"));
}

TEST_F(BenchTools, SwapAnInstallationOfANamedKindOfSensorAlone) {
  const Answer answer = inslab({"swap", "installation", source("config/profiles/installation/antenna_roof.json")});
  EXPECT_EQ(answer.code, 2);
  EXPECT_THAT(answer.text, HasSubstr("--sensor-kind: missing; expected imu or gnss or magnetometer or barometer or "
                                     "odometer or heading or air_data, all of which have installation profiles"));
}

TEST(Commands, KeepTheirTimeoutAndSayWhereTheyLooked) {
  const std::string where = "on domain " + own_domain() + ", unit 'nobody', interface 127.0.0.1";
  const Answer stop = inslab({"stop", "--unit", "nobody", "--timeout", "2.5"});
  EXPECT_EQ(stop.code, 3);
  EXPECT_THAT(stop.text, HasSubstr("waits for a trajectory server " + where));
  EXPECT_THAT(stop.text, HasSubstr("a trajectory server " + where + " was not found within 2.5 s"));
  const Answer echo = inslab({"topics", "hz", "inslab/imu/0", "--unit", "nobody", "--seconds", "0.5"});
  EXPECT_EQ(echo.code, 1);
  EXPECT_THAT(echo.text, HasSubstr("it has no writer " + where + ": is the set running there?"));
  const Answer list = inslab({"topics", "ls", "--seconds", "0.5"});
  EXPECT_THAT(list.text, HasSubstr("nobody was heard in 0.5 s on domain "));
}

TEST(Commands, TakeNoPatternForAUnit) {
  for (const char* command : {"stop", "status", "doctor"}) {
    const Answer answer = inslab({command, "--unit", "*"});
    EXPECT_EQ(answer.code, 2) << answer.text;
    EXPECT_THAT(answer.text, HasSubstr("'*' names no unit; expected letters, digits"));
  }
  Process service("inslab-trajectory-server", {"--scenario", source("tests/data/short.json"), "--unit", "my car"});
  EXPECT_EQ(service.wait(seconds(20)), 2) << service.output();
}

TEST(Commands, TakeAnInterfaceByNameAndSayWhichThereAre) {
  const Answer absent = inslab({"topics", "ls", "--interface", "192.0.2.77"});
  EXPECT_EQ(absent.code, 2);
  EXPECT_THAT(absent.text, HasSubstr("this host has no interface '192.0.2.77'; it has "));
  EXPECT_THAT(absent.text, HasSubstr("lo (127.0.0.1)"));
  const Answer by_name = inslab({"topics", "ls", "--interface", "lo", "--unit", "nobody", "--seconds", "2.1"});
  EXPECT_THAT(by_name.text,
              HasSubstr("listens for 2.1 s on domain " + own_domain() + ", unit 'nobody', interface 127.0.0.1"));
}

TEST(Doctor, FindsVariablesThatLeadAstray) {
  setenv("ROS_DISCOVERY_SERVER", "10.0.0.1:11811", 1);
  setenv("FASTRTPS_DEFAULT_PROFILES_FILE", "/no/such/profiles.xml", 1);
  const Answer answer = inslab({"doctor", "--seconds", "0.5"});
  unsetenv("ROS_DISCOVERY_SERVER");
  unsetenv("FASTRTPS_DEFAULT_PROFILES_FILE");
  EXPECT_EQ(answer.code, 1);
  EXPECT_THAT(answer.text, HasSubstr("BAD   ROS_DISCOVERY_SERVER=10.0.0.1:11811"));
  EXPECT_THAT(answer.text, HasSubstr("cure: unset it, unless every participant"));
  EXPECT_THAT(answer.text, HasSubstr("/no/such/profiles.xml: there is no such file"));
}

TEST(Doctor, FindsTheSegmentsOfAKilledProcessAndLeavesThoseOfALivingOne) {
  const auto start = [](const char* domain) {
    return std::make_unique<Process>("inslab-trajectory-server",
                                     std::vector<std::string>{"--scenario", source("tests/data/short.json"),
                                                              "--transport", "shm", "--domain", domain});
  };
  const auto stale_and_all = [](const std::string& text) {
    std::smatch found;
    const bool some = std::regex_search(text, found, std::regex("([0-9]+) of ([0-9]+) segments of Fast DDS belong"));
    return some ? std::make_pair(std::stoi(found[1]), std::stoi(found[2])) : std::make_pair(0, 0);
  };
  inslab({"doctor", "--clean", "--seconds", "0.5"});
  const auto living = start("17");
  const auto killed = start("18");
  const auto segments = [&] { return stale_and_all(inslab({"doctor", "--seconds", "0.5"}).text); };
  // Both have opened theirs once they wait for the others.
  Process waiting("inslab", {"topics", "ls", "--domain", "18", "--transport", "shm"});
  ASSERT_EQ(waiting.wait(seconds(30)), 0) << waiting.output();
  Process waiting_too("inslab", {"topics", "ls", "--domain", "17", "--transport", "shm"});
  ASSERT_EQ(waiting_too.wait(seconds(30)), 0) << waiting_too.output();
  killed->send(SIGKILL);
  ASSERT_TRUE(killed->wait(seconds(10)));
  const auto [stale, all] = segments();
  EXPECT_GT(stale, 0);
  EXPECT_LT(stale, all);
  const Answer cleaned = inslab({"doctor", "--clean", "--seconds", "0.5"});
  EXPECT_THAT(cleaned.text, HasSubstr("removed " + std::to_string(stale) + " stale segments"));
  EXPECT_EQ(segments().first, 0);
  // The living one still speaks over its own.
  Process hears("inslab", {"topics", "ls", "--domain", "17", "--transport", "shm"});
  EXPECT_EQ(hears.wait(seconds(30)), 0) << hears.output();
}

}  // namespace bench_tools_test
}  // namespace inslab::e2e
