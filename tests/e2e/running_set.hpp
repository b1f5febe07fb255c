#pragma once

#include <gtest/gtest.h>

#include <csignal>
#include <memory>
#include <string>
#include <vector>

#include "inslab/bus/client/run_client.hpp"
#include "inslab/bus/service/service.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "tests/e2e/process.hpp"

namespace inslab::e2e {

/// A test of a live set: its files, a participant beside it, and how its run goes.
class RunningSet : public testing::Test {
 protected:
  static std::string scenario(const std::string& name) { return source("tests/data/" + name + ".json"); }

  /// One service, started by hand.
  std::unique_ptr<Process> service(const std::string& program, const std::string& name,
                                   const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all{"--scenario", scenario(name), "--domain", own_domain()};
    if (program != "inslab-trajectory-server") all.insert(all.end(), {"--state", folder_ / "state"});
    all.insert(all.end(), more.begin(), more.end());
    return std::make_unique<Process>(program, all);
  }
  static pid_t child(const Process& set, const std::string& program) {
    const auto pids = children_named(set.pid(), program);
    return pids.empty() ? 0 : pids.front();
  }
  /// Ends a service of a running set as a crash does.
  static void kill_child(const Process& set, const std::string& program) {
    const pid_t pid = child(set, program);
    ASSERT_NE(pid, 0) << program;
    kill(pid, SIGKILL);
  }
  std::optional<SimStatus> status() const { return client_.status(); }
  double sim_time_s() const { return status() ? time::to_seconds(status()->sim_time_ns) : -1.0; }
  bool reaches(double time_s) const {
    return eventually([&] { return sim_time_s() > time_s; }, std::chrono::seconds(60));
  }

  static dds::ParticipantOptions network() {
    service::NetworkOptions options;
    options.domain = static_cast<std::uint32_t>(std::stoul(own_domain()));
    return service::participant_options(options, "bench");
  }

  TestFolder folder_;
  std::string log_ = folder_ / "live.mcap";
  dds::Participant participant_{network()};
  client::RunClient client_{participant_};
};

}  // namespace inslab::e2e
