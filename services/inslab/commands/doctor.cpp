#include <fmt/format.h>
#include <sys/timex.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>

#include "inslab/bus/client/run_client.hpp"
#include "inslab/bus/dds/discovery.hpp"
#include "inslab/bus/dds/wire_findings.hpp"
#include "inslab/bus/service/service.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/services/inslab/commands/commands.hpp"
#include "inslab/services/inslab/live/shm_segments.hpp"

namespace inslab::cli {

namespace {

struct DoctorOptions {
  bool clean = false;
  double seconds = 2.5;
  app::NetworkOptions network;
};

/// Prints findings as they come and counts those that want a cure.
class Findings {
 public:
  void good(const std::string& what) { fmt::print("  ok    {}\n", what); }
  void note(const std::string& what) { fmt::print("  note  {}\n", what); }
  void bad(const std::string& what, const std::string& cure) {
    ++count_;
    fmt::print("  BAD   {}\n        cure: {}\n", what, cure);
  }
  int count() const { return count_; }

 private:
  int count_ = 0;
};

void look_at_environment(Findings& findings) {
  fmt::print("environment\n");
  const auto value_of = [](const char* name) -> std::string {
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
  };
  if (const std::string server = value_of("ROS_DISCOVERY_SERVER"); !server.empty()) {
    findings.bad("ROS_DISCOVERY_SERVER=" + server + " makes this process a client of a discovery server",
                 "unset it, unless every participant of the network uses that server");
  }
  for (const char* name : {"FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE"}) {
    const std::string file = value_of(name);
    if (file.empty()) continue;
    if (std::filesystem::exists(file)) {
      findings.note(std::string(name) + "=" + file + " decides transport and discovery");
    } else {
      findings.bad(std::string(name) + "=" + file + ": there is no such file", "correct or unset it");
    }
  }
  if (std::filesystem::exists("DEFAULT_FASTRTPS_PROFILES.xml")) {
    findings.note("DEFAULT_FASTRTPS_PROFILES.xml in this folder is read by every Fast DDS process started here");
  }
  if (findings.count() == 0) findings.good("no variable leads Fast DDS astray");
}

long kernel_limit(const std::string& name) {
  std::ifstream file("/proc/sys/net/core/" + name);
  long value = 0;
  file >> value;
  return value;
}

void look_at_socket_buffers(Findings& findings) {
  fmt::print("socket buffers\n");
  constexpr long kWanted = 4 << 20;
  for (const char* name : {"rmem_max", "wmem_max"}) {
    const long limit = kernel_limit(name);
    const std::string what = fmt::format("net.core.{} = {}", name, limit);
    if (limit >= kWanted || (name[0] == 'w' && limit >= kWanted / 4)) {
      findings.good(what);
    } else {
      findings.note(what + ": enough for 1 kHz live; a bigger one makes lockstep faster: sysctl -w net.core." + name +
                    "=" + std::to_string(kWanted));
    }
  }
}

void look_at_shared_memory(Findings& findings, bool clean) {
  fmt::print("shared memory\n");
  const auto segments = find_shm_segments("/dev/shm");
  std::size_t stale = 0;
  for (const ShmSegment& segment : segments) stale += segment.in_use ? 0 : 1;
  if (stale == 0) {
    findings.good(fmt::format("{} segments of Fast DDS, all in use", segments.size()));
  } else if (clean) {
    findings.good(fmt::format("removed {} stale segments of {}", remove_stale(segments), segments.size()));
  } else {
    findings.bad(
        fmt::format("{} of {} segments of Fast DDS belong to nobody: processes were killed", stale, segments.size()),
        "inslab doctor --clean");
  }
}

void look_at_clock(Findings& findings) {
  fmt::print("clock\n");
  timex state{};
  const int result = adjtimex(&state);
  if (result < 0) {
    findings.note("the kernel does not say whether the clock is synchronised");
  } else if (result == TIME_ERROR || (state.status & STA_UNSYNC) != 0) {
    findings.note(
        "CLOCK_REALTIME is not synchronised: latencies between this host and another mean nothing "
        "(on one host they do); chrony or ptp4l would help");
  } else {
    findings.good(fmt::format("CLOCK_REALTIME is synchronised, error at most {:.3f} ms",
                              static_cast<double>(state.maxerror) * 1e-3));
  }
}

std::string words_of_units(const std::vector<std::string>& units) {
  std::string words;
  for (const std::string& unit : units) {
    words += (words.empty() ? "" : ", ") + (unit.empty() ? "one without a name" : "'" + unit + "'");
  }
  return words;
}

/// Every pair of a writer and a reader of one topic that will not match, once for each reason.
void look_at_the_wire(Findings& findings, const DoctorOptions& options) {
  fmt::print("on the wire, domain {}, transport {}, interface {}\n", options.network.domain, options.network.transport,
             options.network.interface_address);
  const dds::Discovery discovery(app::participant_options(options.network, "inslab-doctor"));
  listen_for(options.seconds);
  const std::vector<dds::Endpoint> endpoints = discovery.endpoints();
  const auto participants = discovery.participants();
  if (participants.empty()) {
    findings.note("nobody was heard: is the set running, with the same --domain, --interface and --transport?");
    return;
  }
  if (const auto units = dds::units_among(endpoints); units.size() > 1) {
    findings.note(fmt::format("{} units, which do not hear each other: {}", units.size(), words_of_units(units)));
  }
  const std::vector<dds::WireFinding> mismatches = dds::wire_findings(endpoints);
  for (const dds::WireFinding& finding : mismatches) findings.bad(finding.what, finding.cure);
  if (mismatches.empty()) {
    findings.good(fmt::format("{} participants with {} endpoints, no mismatch", participants.size(), endpoints.size()));
  }
}

int doctor(const DoctorOptions& options) {
  Findings findings;
  look_at_environment(findings);
  look_at_socket_buffers(findings);
  look_at_shared_memory(findings, options.clean);
  look_at_clock(findings);
  look_at_the_wire(findings, options);
  fmt::print("{} {} to cure\n", findings.count(), findings.count() == 1 ? "finding" : "findings");
  return findings.count() == 0 ? app::kOk : app::kFailed;
}

}  // namespace

void add_doctor(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<DoctorOptions>();
  CLI::App* command = app.add_subcommand("doctor", "Look for what keeps a set from working, with the cure");
  command->add_flag("--clean", options->clean, "remove shared-memory segments that killed processes left");
  command->add_option("--seconds", options->seconds, "how long to listen on the network")
      ->check(CLI::Range(0.5, 60.0))
      ->capture_default_str();
  options->network.add_to(*command);
  command->callback([options, &action] { action = [options] { return doctor(*options); }; });
}

}  // namespace inslab::cli
