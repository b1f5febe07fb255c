// The set on three hosts, started by deploy/lab from an inventory. The hosts are network namespaces on a bridge, made
// here and removed again; the third hangs on a long, bad cable where a test asks for it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>

#include "tests/e2e/logged_samples.hpp"
#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace several_hosts_test {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;

struct Cable {
  int delay_ms = 0;
  double loss = 0.0;
};

/// Hosts a, b and c at 10.231.0.1 to 3.
class Network {
 public:
  explicit Network(const Cable* cable_of_c) {
    for (const std::string& name : kAll) ip({"netns", "add", space(name)});
    ip({"-n", space("net"), "link", "add", "bridge0", "type", "bridge"});
    ip({"-n", space("net"), "link", "set", "bridge0", "up"});
    for (std::size_t i = 0; i < kHosts.size(); ++i) connect(kHosts[i], i + 1, i == 2 ? cable_of_c : nullptr);
  }
  ~Network() {
    relay_.reset();
    for (const std::string& name : kAll) ip({"netns", "delete", space(name)});
  }
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  /// Why there are no hosts here; empty when there are.
  const std::string& problem() const { return problem_; }
  Process& relay() { return *relay_; }

  static std::string space(const std::string& name) { return "inslab" + std::to_string(getpid()) + name; }
  static std::string address(std::size_t number) { return "10.231.0." + std::to_string(number); }

 private:
  static inline const std::vector<std::string> kHosts{"a", "b", "c"};
  static inline const std::vector<std::string> kAll{"net", "a", "b", "c"};

  void ip(const std::vector<std::string>& arguments) {
    Process command("ip", arguments);
    if (command.wait(seconds(20)) != 0 && problem_.empty()) {
      problem_ = "no network namespaces here: ip " + testing::PrintToString(arguments) + ": " + command.output();
    }
  }

  void connect(const std::string& host, std::size_t number, const Cable* cable) {
    const std::string port = "to-" + host;
    if (cable == nullptr) {
      ip({"-n", space("net"), "link", "add", port, "type", "veth", "peer", "name", "eth0", "netns", space(host)});
    } else {
      relay_ =
          std::make_unique<Process>("tap_relay", std::vector<std::string>{space(host), "eth0", space("net"), port,
                                                                          "--delay-ms", std::to_string(cable->delay_ms),
                                                                          "--loss", std::to_string(cable->loss)});
      if (!relay_->prints("ready", seconds(20)) && problem_.empty()) problem_ = "no TAP devices: " + relay_->output();
    }
    ip({"-n", space("net"), "link", "set", port, "master", "bridge0"});
    ip({"-n", space("net"), "link", "set", port, "up"});
    ip({"-n", space(host), "link", "set", "lo", "up"});
    ip({"-n", space(host), "address", "add", address(number) + "/24", "dev", "eth0"});
    ip({"-n", space(host), "link", "set", "eth0", "mtu", "1500"});
    ip({"-n", space(host), "link", "set", "eth0", "up"});
    ip({"-n", space(host), "route", "add", "224.0.0.0/4", "dev", "eth0"});
  }

  std::string problem_;
  std::unique_ptr<Process> relay_;
};

class SeveralHosts : public testing::Test {
 protected:
  void make_network(const Cable* cable_of_c = nullptr) {
    if (geteuid() != 0) GTEST_SKIP() << "network namespaces need root";
    network_ = std::make_unique<Network>(cable_of_c);
    if (!network_->problem().empty()) GTEST_SKIP() << network_->problem();
  }

  /// The hosts' folders and the inventory. The third host has the receiver and the log, so all that goes over its cable
  /// goes both ways.
  std::string inventory(const std::string& scenario, const std::string& discovery) {
    std::ostringstream text;
    text << R"({"scenario": "tests/data/)" << scenario << R"(.json", "domain": )" << own_domain()
         << R"(, "discovery": ")" << discovery << R"(", "log": "runs/lab.mcap", "hosts": [)";
    const std::vector<std::string> services{R"("trajectory-server")", R"("imu-injector:0")",
                                            R"("gnss-emulator:0", "truth-logger")"};
    for (std::size_t i = 0; i < services.size(); ++i) {
      const std::string name(1, static_cast<char>('a' + i));
      const std::string folder = folder_ / name;
      std::filesystem::create_directories(folder);
      for (const char* shared : {"build", "config", "tests"}) {
        std::filesystem::create_symlink(source(shared), folder + "/" + shared);
      }
      text << (i == 0 ? "" : ", ") << R"({"name": ")" << name << R"(", "address": ")" << Network::address(i + 1)
           << R"(", "folder": ")" << folder << R"(", "reach": ["ip", "netns", "exec", ")" << Network::space(name)
           << R"("], "services": [)" << services[i] << "]"
           << (discovery == "server" && i == 0 ? R"(, "discovery_server": true)" : "") << "}";
    }
    text << "]}";
    const std::string path = folder_ / "inventory.json";
    std::ofstream(path) << text.str();
    return path;
  }

  std::unique_ptr<Process> lab(const std::string& inventory) const {
    return std::make_unique<Process>(source("deploy/lab"), std::vector<std::string>{"run", inventory});
  }
  std::string log() const { return folder_ / "c/runs/lab.mcap"; }

  TestFolder folder_;
  std::unique_ptr<Network> network_;
};

class SeveralHostsFindEachOther : public SeveralHosts, public testing::WithParamInterface<const char*> {};

TEST_P(SeveralHostsFindEachOther, AndEverySampleArrives) {
  make_network();
  if (IsSkipped()) return;
  const auto run = lab(inventory("lab", GetParam()));
  EXPECT_EQ(run->wait(seconds(90)), 0) << run->output();
  EXPECT_THAT(run->output(), HasSubstr("swap 1: installation 'antenna_roof' for gnss0: applied at 2.000 s"));
  EXPECT_EQ(samples_of<ImuSample>(log(), "inslab/imu/0").size(), 400u);
}

INSTANTIATE_TEST_SUITE_P(By, SeveralHostsFindEachOther, testing::Values("multicast", "peers", "server"),
                         [](const auto& instance) { return std::string(instance.param); });

TEST_F(SeveralHosts, ALongCableThatLosesFramesLosesNoSample) {
  const Cable cable{20, 0.01};
  make_network(&cable);
  if (IsSkipped()) return;
  const auto run = lab(inventory("lab", "multicast"));
  EXPECT_EQ(run->wait(seconds(90)), 0) << run->output();
  const auto truth = samples_of<TruthState>(log(), "inslab/truth");
  EXPECT_EQ(truth.size(), 401u);
  EXPECT_EQ(samples_of<ImuSample>(log(), "inslab/imu/0").size(), 400u);
}

TEST_F(SeveralHosts, ALinkThatIsDownForFiveSecondsLosesNoSample) {
  const Cable cable{0, 0.0};
  make_network(&cable);
  if (IsSkipped()) return;
  const auto run = lab(inventory("lab_link_down", "multicast"));
  ASSERT_TRUE(eventually(
      [this] { return std::filesystem::exists(log()) && std::filesystem::file_size(log()) > 50'000; }, seconds(60)))
      << run->output();
  network_->relay().send(SIGUSR1);
  const auto up_again = std::chrono::steady_clock::now() + seconds(5);
  EXPECT_TRUE(eventually([&] { return std::chrono::steady_clock::now() > up_again; }, seconds(20)));
  network_->relay().send(SIGUSR2);
  EXPECT_EQ(run->wait(seconds(120)), 0) << run->output();
  EXPECT_EQ(samples_of<TruthState>(log(), "inslab/truth").size(), 1201u) << run->output();
  EXPECT_EQ(samples_of<ImuSample>(log(), "inslab/imu/0").size(), 1200u) << run->output();
  EXPECT_EQ(samples_of<ImuTruth>(log(), "inslab/imu_truth/0").size(), 1200u) << run->output();
  EXPECT_EQ(samples_of<GnssFix>(log(), "inslab/gnss/0").size(), 120u) << run->output();
}

TEST(LabInventory, IsRefusedByThePlaceThatIsWrong) {
  const TestFolder folder;
  const std::string path = folder / "inventory.json";
  const auto refusal = [&](const std::string& text) {
    std::ofstream(path) << text;
    Process lab(source("deploy/lab"), {"check", path});
    EXPECT_EQ(lab.wait(seconds(20)), 2);
    return lab.output();
  };
  EXPECT_THAT(
      refusal("{\n  \"scenario\": 1,\n}"),
      testing::ContainsRegex("line (3, column 1|2, column 16)"));  // the brace, or as Python 3.13 the comma before it
  EXPECT_THAT(refusal(R"({"scenario": "x", "hosts": [], "speed": 1})"), HasSubstr("speed: is not known"));
  EXPECT_THAT(refusal(R"({"hosts": []})"), HasSubstr("scenario: is missing"));
  EXPECT_THAT(refusal(R"({"scenario": "x", "hosts": [{"name": "a", "address": "10.0.0.256", "folder": "/x",
                       "services": []}]})"),
              HasSubstr("hosts[0].address: "));
  EXPECT_THAT(refusal(R"({"scenario": "x", "hosts": [{"name": "a", "address": "10.0.0.1", "folder": "/x",
                       "services": ["truth-logger", "imu-injector:x"]}]})"),
              HasSubstr("hosts[0].services[1]: is 'imu-injector:x'"));
  EXPECT_THAT(refusal(R"({"scenario": "x", "hosts": [{"name": "a", "address": "10.0.0.1", "folder": "/x",
                       "services": ["truth-logger"]}]})"),
              HasSubstr("hosts: 0 run trajectory-server; expected one"));
}

TEST(LabInventory, IsRefusedByEveryActionThatWouldStartWhatItNames) {
  const TestFolder folder;
  const std::string path = folder / "inventory.json";
  const auto refusal = [&](const char* action, const std::string& scenario, const std::string& more) {
    std::ofstream(path) << R"({"scenario": ")" << scenario << "\"" << more
                        << R"(, "hosts": [{"name": "a", "address": "10.0.0.1", "folder": "/x", "services":
                              ["truth-logger", "trajectory-server"]}]})";
    Process lab(source("deploy/lab"), {action, path});
    EXPECT_EQ(lab.wait(seconds(20)), 2) << action;
    return lab.output();
  };
  for (const char* action : {"check", "install", "run", "start", "status", "stop"}) {
    EXPECT_THAT(refusal(action, "x", R"(, "unit": "my car")"),
                HasSubstr("inventory.json: unit: is \"my car\"; expected"));
    EXPECT_THAT(refusal(action, "x", R"(, "domain": 999)"),
                HasSubstr("inventory.json: domain: is 999; expected 0 to 232"));
  }
  for (const char* action : {"check", "install", "run", "start"}) {
    EXPECT_THAT(refusal(action, "config/none.json", ""),
                HasSubstr("scenario: names 'config/none.json', which is not there"));
  }
  EXPECT_THAT(refusal("check", "config/profiles/imu/stim300.json", ""), HasSubstr("scenario: inslab: stim300.json: "));
  EXPECT_THAT(refusal("check", "x", R"(, "clock": ["--rate", 2])"), HasSubstr("clock[1]: is 2; expected a word"));
  EXPECT_THAT(refusal("check", "x", R"(, "log": "../x.mcap")"), HasSubstr("log: is '../x.mcap'"));
}

TEST(LabInventory, OfTheExampleIsGood) {
  Process lab(source("deploy/lab"), {"check", source("config/lab/three_hosts.json")});
  EXPECT_EQ(lab.wait(seconds(20)), 0) << lab.output();
}

}  // namespace several_hosts_test
}  // namespace inslab::e2e
