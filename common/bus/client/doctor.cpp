#include "inslab/bus/client/doctor.hpp"

#include <fmt/format.h>
#include <sys/timex.h>

#include <algorithm>
#include <fstream>

#include "inslab/bus/client/run_client.hpp"
#include "inslab/bus/client/shm_segments.hpp"
#include "inslab/bus/dds/wire_findings.hpp"
#include "inslab/bus/service/service.hpp"

namespace inslab::client {

namespace {

Finding good(const std::string& what) { return {Finding::Grade::Good, what, ""}; }
Finding note(const std::string& what) { return {Finding::Grade::Note, what, ""}; }
Finding bad(const std::string& what, const std::string& cure) { return {Finding::Grade::Bad, what, cure}; }

long limit_in(const std::filesystem::path& path) {
  std::ifstream file(path);
  long value = 0;
  file >> value;
  return value;
}

std::string words_of_units(const std::vector<std::string>& units) {
  std::string words;
  for (const std::string& unit : units) {
    words += (words.empty() ? "" : ", ") + (unit.empty() ? "one without a name" : "'" + unit + "'");
  }
  return words;
}

}  // namespace

std::size_t Findings::to_cure() const {
  return static_cast<std::size_t>(std::count_if(
      found.begin(), found.end(), [](const Finding& finding) { return finding.grade == Finding::Grade::Bad; }));
}

std::string words_of(const Findings& findings) {
  std::string text = findings.title + "\n";
  for (const Finding& finding : findings.found) {
    switch (finding.grade) {
      case Finding::Grade::Good:
        text += fmt::format("  ok    {}\n", finding.what);
        break;
      case Finding::Grade::Note:
        text += fmt::format("  note  {}\n", finding.what);
        break;
      case Finding::Grade::Bad:
        text += fmt::format("  BAD   {}\n        cure: {}\n", finding.what, finding.cure);
        break;
    }
  }
  return text;
}

Findings examine_environment(const std::function<std::string(const char*)>& variable,
                             const std::filesystem::path& folder) {
  Findings findings{"environment", {}};
  auto& found = findings.found;
  if (const std::string server = variable("ROS_DISCOVERY_SERVER"); !server.empty()) {
    found.push_back(bad("ROS_DISCOVERY_SERVER=" + server + " makes this process a client of a discovery server",
                        "unset it, unless every participant of the network uses that server"));
  }
  for (const char* name : {"FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE"}) {
    const std::string file = variable(name);
    if (file.empty()) continue;
    if (std::filesystem::exists(file)) {
      found.push_back(note(std::string(name) + "=" + file + " decides transport and discovery"));
    } else {
      found.push_back(bad(std::string(name) + "=" + file + ": there is no such file", "correct or unset it"));
    }
  }
  if (std::filesystem::exists(folder / "DEFAULT_FASTRTPS_PROFILES.xml")) {
    found.push_back(
        note("DEFAULT_FASTRTPS_PROFILES.xml in this folder is read by every Fast DDS process started here"));
  }
  if (findings.to_cure() == 0) found.push_back(good("no variable leads Fast DDS astray"));
  return findings;
}

Findings examine_socket_buffers(const std::filesystem::path& kernel) {
  Findings findings{"socket buffers", {}};
  constexpr long kWanted = 4 << 20;
  for (const char* name : {"rmem_max", "wmem_max"}) {
    const long limit = limit_in(kernel / name);
    const std::string what = fmt::format("net.core.{} = {}", name, limit);
    if (limit >= kWanted || (name[0] == 'w' && limit >= kWanted / 4)) {
      findings.found.push_back(good(what));
    } else {
      findings.found.push_back(note(what +
                                    ": enough for 1 kHz live; a bigger one makes lockstep faster: sysctl -w net.core." +
                                    name + "=" + std::to_string(kWanted)));
    }
  }
  return findings;
}

Findings examine_shared_memory(const std::filesystem::path& directory, bool clean) {
  Findings findings{"shared memory", {}};
  const auto segments = find_shm_segments(directory);
  const auto stale =
      std::count_if(segments.begin(), segments.end(), [](const ShmSegment& segment) { return !segment.in_use; });
  if (stale == 0) {
    findings.found.push_back(good(fmt::format("{} segments of Fast DDS, all in use", segments.size())));
  } else if (clean) {
    findings.found.push_back(
        good(fmt::format("removed {} stale segments of {}", remove_stale(segments), segments.size())));
  } else {
    findings.found.push_back(bad(
        fmt::format("{} of {} segments of Fast DDS belong to nobody: processes were killed", stale, segments.size()),
        "inslab doctor --clean"));
  }
  return findings;
}

Findings examine_clock() {
  timex state{};
  const int result = adjtimex(&state);
  if (result < 0) return {"clock", {note("the kernel does not say whether the clock is synchronised")}};
  if (result == TIME_ERROR || (state.status & STA_UNSYNC) != 0) {
    return {"clock",
            {note("CLOCK_REALTIME is not synchronised: latencies between this host and another mean nothing "
                  "(on one host they do); chrony or ptp4l would help")}};
  }
  return {"clock",
          {good(fmt::format("CLOCK_REALTIME is synchronised, error at most {:.3f} ms",
                            static_cast<double>(state.maxerror) * 1e-3))}};
}

Findings examine_endpoints(const std::string& where, std::size_t participants,
                           const std::vector<dds::Endpoint>& endpoints) {
  Findings findings{"on the wire, " + where, {}};
  auto& found = findings.found;
  if (participants == 0) {
    found.push_back(note("nobody was heard: is the set running, with the same --domain, --interface and --transport?"));
    return findings;
  }
  if (const auto units = dds::units_among(endpoints); units.size() > 1) {
    found.push_back(
        note(fmt::format("{} units, which do not hear each other: {}", units.size(), words_of_units(units))));
  }
  const std::vector<dds::WireFinding> mismatches = dds::wire_findings(endpoints);
  for (const dds::WireFinding& finding : mismatches) found.push_back(bad(finding.what, finding.cure));
  if (mismatches.empty()) {
    found.push_back(
        good(fmt::format("{} participants with {} endpoints, no mismatch", participants, endpoints.size())));
  }
  return findings;
}

Findings examine_network(const service::NetworkOptions& network, double seconds) {
  const dds::Discovery discovery(service::participant_options(network, "inslab-doctor"));
  listen_for(seconds);
  const std::string where = fmt::format("domain {}, transport {}, interface {}", network.domain, network.transport,
                                        network.interface_address);
  const std::vector<dds::Endpoint> endpoints = discovery.endpoints();
  return examine_endpoints(where, discovery.participants().size(), endpoints);
}

}  // namespace inslab::client
