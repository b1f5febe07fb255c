// A unit has one set, a set has one scenario, and every stream has one writer.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <regex>

#include "inslab/bus/client/run_client.hpp"
#include "inslab/bus/service/service.hpp"
#include "inslab/formats/log/log_info.hpp"
#include "tests/dds/any_bytes.hpp"
#include "tests/e2e/logged_samples.hpp"
#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace one_set_test {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ContainsRegex;
using testing::HasSubstr;

using Names = std::vector<std::string>;

constexpr int kCannotStart = 2;

class OneSet : public testing::Test {
 protected:
  static std::string scenario() { return source("tests/data/short.json"); }
  /// The same but for the seed, under the name 'other', so that all it names is found from a folder of its own.
  std::string other_scenario() const {
    std::ifstream file(scenario());
    std::string text((std::istreambuf_iterator<char>(file)), {});
    text = std::regex_replace(text, std::regex("\"seed\": 42"), "\"seed\": 43");
    text = std::regex_replace(text, std::regex("\"name\": \"short\""), "\"name\": \"other\"");
    text = std::regex_replace(text, std::regex("\\.\\./\\.\\./config"), source("config"));
    std::ofstream(folder_ / "other.json") << text;
    return folder_ / "other.json";
  }
  std::string offline() const {
    Process run("inslab", {"simulate", scenario(), "-o", folder_ / "offline"});
    EXPECT_EQ(run.wait(seconds(60)), 0) << run.output();
    return folder_ / "offline/short.mcap";
  }
  static std::unique_ptr<Process> start(const std::string& program, const std::string& with_scenario, Names more = {}) {
    Names all{"--scenario", with_scenario, "--domain", own_domain()};
    all.insert(all.end(), more.begin(), more.end());
    return std::make_unique<Process>(program, all);
  }
  std::unique_ptr<Process> run(const std::string& log) const {
    return std::make_unique<Process>("inslab", Names{"run", scenario(), "--log", log, "--domain", own_domain()});
  }
  static bool is_running(const client::RunClient& client) {
    return eventually([&] { return client.status() && client.status()->state == RunState::Running; }, seconds(30));
  }
  static service::NetworkOptions network() {
    service::NetworkOptions options;
    options.domain = static_cast<std::uint32_t>(std::stoul(own_domain()));
    return options;
  }
  static std::string last_line(const Process& process) {
    std::istringstream lines(process.output());
    std::string last;
    for (std::string line; std::getline(lines, line);) last = line;
    return last;
  }

  TestFolder folder_;
  std::string log_ = folder_ / "live.mcap";
};

TEST_F(OneSet, ASecondOneAndAnyServiceOfItIsRefusedAndTheFirstGoesOnToTheBit) {
  const std::string reference = offline();
  const std::string other = other_scenario();
  const auto first = run(log_);
  dds::Participant participant(service::participant_options(network(), "test"));
  const client::RunClient client(participant);
  ASSERT_TRUE(is_running(client)) << first->output();

  const std::string second_log = folder_ / "second.mcap";
  std::vector<std::unique_ptr<Process>> late;
  late.push_back(
      std::make_unique<Process>("inslab", Names{"run", other, "--log", second_log, "--domain", own_domain()}));
  late.push_back(start("inslab-trajectory-server", other));
  late.push_back(start("inslab-imu-injector", other));
  late.push_back(start("inslab-gnss-emulator", scenario()));
  late.push_back(start("inslab-truth-logger", scenario(), {"--log", folder_ / "third.mcap"}));
  // They come together, so that one of them may be told of another of them.
  for (const auto& process : late) {
    EXPECT_EQ(process->wait(seconds(20)), kCannotStart) << process->output();
    EXPECT_THAT(
        last_line(*process),
        ContainsRegex("inslab-[a-z-]+ [0-9]+ \\(host [^,]+, process [0-9]+, since .* UTC, scenario '(short|other)'\\) "
                      "runs (here already|another set)"));
    EXPECT_THAT(last_line(*process), HasSubstr("another --unit or --domain"));
  }
  EXPECT_FALSE(std::filesystem::exists(second_log));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "third.mcap"));

  EXPECT_EQ(first->wait(seconds(60)), 0) << first->output();
  expect_same_run(log_, reference);
  EXPECT_EQ(log::inspect_log(log_).run_ids.size(), 1u);
}

TEST_F(OneSet, OfTwoThatStartTogetherOneRuns) {
  const auto one = run(folder_ / "one.mcap");
  const auto two = run(folder_ / "two.mcap");
  const auto refused = [](Process& process) { return process.wait(milliseconds(1)) == kCannotStart; };
  ASSERT_TRUE(eventually([&] { return refused(*one) || refused(*two); }, seconds(20)))
      << one->output() << two->output();
  Process& other = refused(*one) ? *two : *one;
  EXPECT_TRUE(other.prints(" of 8.0 s", seconds(30))) << other.output();
  other.send(SIGINT);
  EXPECT_EQ(other.wait(seconds(30)), 1) << other.output();
}

TEST_F(OneSet, AServiceWithAnotherScenarioIsNamedBeforeTheRun) {
  const std::string other = other_scenario();
  const auto odd = start("inslab-imu-injector", other);
  // As long as it looks around it would refuse itself, and nobody had to name it.
  ASSERT_TRUE(odd->prints("waits for the trajectory server", seconds(20))) << odd->output();
  const auto log = start("inslab-truth-logger", scenario(), {"--log", log_});
  const auto imu3 = start("inslab-imu-injector", scenario(), {"--sensor", "3"});
  const auto gnss = start("inslab-gnss-emulator", scenario());
  const auto server = start("inslab-trajectory-server", scenario());
  EXPECT_EQ(server->wait(seconds(20)), 1) << server->output();
  EXPECT_THAT(
      server->output(),
      ContainsRegex("inslab-imu-injector 0 \\(host [^,]+, process " + std::to_string(odd->pid()) +
                    ", since .* UTC, scenario 'other'\\) does not belong to this trajectory server's run: one has "
                    "the scenario 'short', the other 'other'"));
  for (const auto* process : {&imu3, &gnss}) {
    EXPECT_EQ((*process)->wait(seconds(20)), 1) << (*process)->output();
    EXPECT_THAT((*process)->output(), HasSubstr("the run ended as a fault: inslab-imu-injector 0"));
  }
  EXPECT_EQ(log->wait(seconds(20)), 1) << log->output();
  EXPECT_TRUE(samples_of<TruthState>(log_, "inslab/truth").empty());
}

TEST_F(OneSet, AnnouncesTheHashOfWhatTheFilesSayWhateverClockTheCommandLineGives) {
  dds::Participant participant(service::participant_options(network(), "test"));
  Process set("inslab",
              {"run", scenario(), "--log", log_, "--domain", own_domain(), "--clock", "lockstep", "--paused"});
  const auto hashes = [&participant] {
    std::map<std::string, std::string> of;
    for (const dds::Peer& peer : participant.peers().all()) {
      const auto identity = streams::identity_in(peer.user_data);
      if (identity) of[identity->service] = identity->scenario_hash;
    }
    return of;
  };
  ASSERT_TRUE(eventually([&] { return hashes().size() == 5; }, seconds(60))) << set.output();
  for (const auto& [service, hash] : hashes()) EXPECT_EQ(hash, hashes().at("inslab-truth-logger")) << service;
  set.send(SIGINT);
  EXPECT_EQ(set.wait(seconds(60)), 1) << set.output();
}

TEST_F(OneSet, AServiceThatComesToAServerOfAnotherScenarioDoesNotStartAndAnAppOfAnotherVersionIsNamed) {
  const auto server = start("inslab-trajectory-server", scenario());
  dds::Participant participant(service::participant_options(network(), "old_app"));
  const client::RunClient client(participant);
  ASSERT_TRUE(eventually([&] { return client.status().has_value(); }, seconds(20))) << server->output();
  const auto odd = start("inslab-imu-injector", other_scenario());
  EXPECT_EQ(odd->wait(seconds(20)), kCannotStart) << odd->output();
  EXPECT_THAT(last_line(*odd), ContainsRegex("inslab-trajectory-server 0 .*process " + std::to_string(server->pid()) +
                                             ",.*one has the scenario 'other', the other 'short'"));

  eprosima::fastdds::dds::TypeSupport earlier(new dds::AnyBytes<TruthState>("inslab::TruthState"));
  ASSERT_EQ(earlier.register_type(&participant.dds()), eprosima::fastdds::dds::RETCODE_OK);
  auto* topic =
      participant.dds().create_topic("inslab/truth", "inslab::TruthState", eprosima::fastdds::dds::TOPIC_QOS_DEFAULT);
  auto* reader = participant.subscriber().create_datareader(topic, dds::reader_qos(dds::Delivery::Stream, 200.0));
  ASSERT_NE(reader, nullptr);
  EXPECT_TRUE(server->prints("reads inslab/truth as inslab::TruthState: it was built with another version of the types",
                             seconds(10)))
      << server->output();
  Process doctor("inslab", {"doctor", "--domain", own_domain()});
  EXPECT_EQ(doctor.wait(seconds(20)), 1) << doctor.output();
  EXPECT_THAT(doctor.output(), HasSubstr("the writer has inslab::v5::TruthState, the reader wants inslab::TruthState"));
  EXPECT_THAT(doctor.output(), HasSubstr("cure: generate the app's types anew from idl/"));
  server->send(SIGTERM);
  EXPECT_EQ(server->wait(seconds(20)), 0) << server->output();
}

TEST_F(OneSet, AWriterThatIsNotOfTheSetIsAFaultAtOnceAndTheRowsStayTheSets) {
  const std::string reference = offline();
  const auto set = run(log_);
  dds::Participant foe(service::participant_options(network(), "foe"));
  const client::RunClient client(foe);
  dds::Writer<TruthState> truth(foe, dds::topics::truth());
  dds::Writer<ImuSample> imu(foe, dds::topics::stream<ImuSample>(0));
  dds::Writer<ImuErrorProfile> journal(foe, dds::topics::journal<ImuErrorProfile>());
  dds::Writer<SimStatus> status(foe, dds::topics::sim_status());
  ASSERT_TRUE(is_running(client)) << set->output();
  ASSERT_TRUE(eventually([&] { return truth.matched_readers() >= 4 && journal.matched_readers() >= 4; }, seconds(20)));
  TruthState lie;
  lie.header.run_id = client.status()->run_id;
  lie.latitude_rad = 1.0;
  ImuSample lie_of_an_imu;
  lie_of_an_imu.header.run_id = lie.header.run_id;
  for (std::uint64_t ahead = 0; ahead < 200; ++ahead) {
    lie.header.sequence_number = lie_of_an_imu.header.sequence_number = 1200 + ahead;
    lie.header.sim_time_ns = lie_of_an_imu.header.sim_time_ns = static_cast<std::int64_t>(5'000'000 * (1200 + ahead));
    truth.write(lie);
    imu.write(lie_of_an_imu);
  }
  ImuErrorProfile entry;
  entry.target = {SensorKind::Imu, 0};
  entry.name = "lie";
  entry.request.journal_number = 1;
  entry.request.apply_at_ns = 1;
  entry.gyro.bias_constant_deg_per_h.setConstant(1e308);
  journal.write(entry);
  dds::Participant onlooker(service::participant_options(network(), "onlooker"));
  client::RunClient watching(onlooker);
  ASSERT_TRUE(is_running(watching));
  ASSERT_TRUE(eventually([&] { return status.matched_readers() >= 6; }, seconds(20)));
  SimStatus over = *client.status();
  over.state = RunState::Finished;
  status.write(over);
  EXPECT_TRUE(eventually([&] { return !watching.writers().fault().empty(); }, seconds(5)));
  EXPECT_THAT(watching.writers().fault(), HasSubstr("inslab/sim/status: a writer that is not this set's: 'foe', GUID"));
  EXPECT_TRUE(eventually([heard = watching.statuses(), &watching] { return watching.statuses() > heard; }, seconds(5)));
  EXPECT_EQ(watching.status()->state, RunState::Running);
  EXPECT_TRUE(set->prints("inslab/truth: a writer that is not this set's: 'foe', GUID ", seconds(5))) << set->output();
  EXPECT_TRUE(set->prints("inslab/imu/0: a writer that is not this set's: 'foe', GUID ", seconds(5)));
  EXPECT_TRUE(set->prints("inslab/journal/imu_error: a writer that is not this set's: 'foe', GUID ", seconds(5)));
  EXPECT_TRUE(set->prints("inslab/sim/status: a writer that is not this set's: 'foe', GUID ", seconds(5)));

  EXPECT_EQ(set->wait(seconds(60)), 1) << set->output();
  EXPECT_THAT(last_line(*set), HasSubstr("a writer that is not this set's: 'foe'"));
  expect_same_run(log_, reference);
}

TEST_F(OneSet, InLockstepAConsumerThatNobodyExpectsAndThatStandsHoldsTheClockForSecondsOnly) {
  const std::string reference = offline();
  Process set("inslab",
              {"run", scenario(), "--log", log_, "--domain", own_domain(), "--clock", "lockstep", "--paused"});
  dds::Participant participant(service::participant_options(network(), "ghost"));
  client::RunClient client(participant);
  dds::Writer<Credit> credits(participant, dds::topics::credit());
  ASSERT_TRUE(eventually([&] { return client.status() && client.status()->state == RunState::Paused; }, seconds(30)))
      << set.output();
  ASSERT_TRUE(eventually([&] { return client.connected() && credits.matched_readers() >= 4; }, seconds(20)));
  for (const char* topic : {"inslab/truth", "inslab/imu/0", "inslab/gnss/0"}) {
    Credit credit;
    credit.run_id = client.status()->run_id;
    credit.consumer = "ghost";
    credit.topic = topic;
    credits.write(credit);
  }
  ASSERT_TRUE(eventually([&] { return client.status()->journal_entries == 6; }, seconds(20))) << set.output();
  ASSERT_TRUE(client.send({7, CommandKind::Resume, 0.0}));
  EXPECT_TRUE(set.prints("inslab/truth: ghost 0 has not come on for 5 s: the run no longer waits for it", seconds(30)))
      << set.output();
  EXPECT_EQ(set.wait(seconds(60)), 0) << set.output();
  expect_same_run(log_, reference);
}

/// Whoever speaks in the trajectory server's name: what breaks the limits reaches no model.
TEST_F(OneSet, AJournalEntryIsJudgedWhereItIsObeyed) {
  const auto injector = start("inslab-imu-injector", scenario());
  service::ServiceOptions options;
  options.network = network();
  scenario::LoadedScenario loaded = scenario::load(scenario());
  const streams::Identity identity = service::identity_of(catalog::kTrajectoryServer, options, loaded);
  service::Context server(identity, options, std::move(loaded));
  dds::Writer<ImuErrorProfile> journal(server.participant(), dds::topics::journal<ImuErrorProfile>());
  ASSERT_TRUE(eventually([&] { return journal.matched_readers() > 0; }, seconds(20))) << injector->output();
  ImuErrorProfile entry;
  entry.target = {SensorKind::Imu, 0};
  entry.name = "too much";
  entry.request.journal_number = 1;
  entry.gyro.bias_constant_deg_per_h.setConstant(1e308);
  journal.write(entry);
  EXPECT_TRUE(injector->prints("entry 1 of the journal is not obeyed: gyro.bias_constant_deg_per_h", seconds(10)))
      << injector->output();
  injector->send(SIGTERM);
  EXPECT_EQ(injector->wait(seconds(10)), 0) << injector->output();
}

using RequiredApp = OneSet;

/// An app that is there, as the barrier asks, and never says where it is.
TEST_F(RequiredApp, ThatSaysNothingFailsTheRun) {
  dds::Participant participant(service::participant_options(network(), "bench"));
  const dds::Writer<NavSolution> silent(participant, dds::topics::nav());
  Process run("inslab",
              {"run", source("tests/data/required_app.json"), "--domain", own_domain(), "--log", folder_ / "log.mcap"});
  EXPECT_EQ(run.wait(seconds(90)), 1) << run.output();
  EXPECT_THAT(run.output(),
              HasSubstr("inslab/nav: the scenario requires a navigation app, and no solution of one came"));
}

}  // namespace one_set_test
}  // namespace inslab::e2e
