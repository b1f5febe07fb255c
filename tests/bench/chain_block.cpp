#include "tests/bench/chain_block.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/data/samples/imu_sample.hpp"
#include "inslab/data/samples/nav_solution.hpp"
#include "inslab/data/samples/service_status.hpp"
#include "inslab/data/samples/truth_state.hpp"
#include "inslab/data/wire/cdr.hpp"
#include "inslab/formats/mcap/mcap_reader.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/scenario/service_names.hpp"

namespace inslab::bench {

namespace {

/// The demo at another rate and length; returns the file.
std::string write_scenario(const ChainSettings& settings) {
  const std::filesystem::path demo = INSLAB_SOURCE_DIR "/config/scenarios/demo.json";
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(std::ifstream(demo));
  json["duration_s"] = settings.duration_s;
  json["truth_rate_hz"] = settings.rate_hz;
  json["imu"][0]["rate_hz"] = settings.rate_hz;
  for (const char* key : {"swaps", "reference_nav", "acceptance"}) json.erase(key);
  // A hiccup of the machine belongs into the figures, not to end the run.
  json["clock"] = {{"max_lag_ms", 1000.0}, {"mode", settings.lockstep ? "lockstep" : "real_time"}};
  if (settings.nav_app == NavApp::Reference) {
    json["reference_nav"] = {{"parameters", INSLAB_SOURCE_DIR "/config/nav/demo_car.json"}};
  } else if (settings.nav_app != NavApp::None) {
    json["require_nav_app"] = true;
    json["require_subscribers"] = {{{"topic", "inslab/imu/0"}}, {{"topic", "inslab/gnss/0"}}};
  }
  json["trajectory"]["segments"].push_back({{"duration_s", settings.duration_s}});
  for (const char* kind : {"imu", "gnss"}) {
    for (auto& sensor : json[kind]) {
      for (auto& [key, value] : sensor.items()) {
        const bool is_file = key.size() > 8 && key.compare(key.size() - 8, 8, "_profile") == 0;
        if (is_file) value = (demo.parent_path() / value.get<std::string>()).lexically_normal().string();
      }
    }
  }
  const std::string file = settings.folder + "/chain.json";
  std::ofstream(file) << json.dump(2);
  return file;
}

template <class T>
T decoded(const mcap::Message& message) {
  T value;
  if (!wire::decode(message.data, message.size, value))
    throw std::runtime_error("the log holds bytes that are no sample");
  return value;
}

/// The last report of a service stands.
void note_receipt(const ServiceStatus& status, ChainBlock& block) {
  for (const StreamStatus& stream : status.streams) {
    if (stream.topic == catalog::kTruth.name && stream.direction == StreamDirection::In) {
      block.truth_receipt_p50_s[status.service] = stream.latency_p50_s;
    }
  }
}

void read_latencies(const std::string& log_file, ChainBlock& block) {
  const mcap::McapReader log(log_file);
  std::map<std::uint16_t, std::string> topics;
  for (const auto& [id, channel] : log.channels()) topics[id] = channel.topic;
  std::map<std::int64_t, StreamHeader> truth;  // by sim time
  log.for_each([&](const mcap::Message& message) {
    if (topics[message.channel_id] == catalog::kServiceStatus.name)
      note_receipt(decoded<ServiceStatus>(message), block);
    if (topics[message.channel_id] != catalog::kTruth.name) return true;
    const StreamHeader header = decoded<TruthState>(message).header;
    truth[header.sim_time_ns] = header;
    return true;
  });
  block.wall_s =
      time::to_seconds(truth.rbegin()->second.publish_realtime_ns - truth.begin()->second.publish_realtime_ns);
  constexpr std::int64_t kWarmUp_ns = 500'000'000;
  std::map<std::uint64_t, std::int64_t> imu_published_ns;  // CLOCK_REALTIME, by sequence number
  log.for_each([&](const mcap::Message& message) {
    if (topics[message.channel_id] != catalog::stream_topic<ImuSample>(0)) return true;
    const StreamHeader imu = decoded<ImuSample>(message).header;
    imu_published_ns[imu.sequence_number] = imu.publish_realtime_ns;
    if (imu.sim_time_ns < kWarmUp_ns) return true;
    const StreamHeader& cause = truth.at(imu.sim_time_ns);
    block.one_hop_s.push_back(time::to_seconds(imu.publish_monotonic_ns - cause.publish_monotonic_ns));
    block.two_hops_s.push_back(
        time::to_seconds(static_cast<std::int64_t>(message.log_time_ns) - cause.publish_realtime_ns));
    return true;
  });
  log.for_each([&](const mcap::Message& message) {
    if (topics[message.channel_id] != catalog::kNav.name) return true;
    const auto solution = decoded<NavSolution>(message);
    // While it aligns the filter has nothing to do.
    if (solution.mode != NavMode::Navigating) return true;
    block.solution_s.push_back(
        time::to_seconds(static_cast<std::int64_t>(message.log_time_ns) - imu_published_ns.at(solution.imu_sequence)));
    return true;
  });
}

}  // namespace

ChainServices::ChainServices(const ChainSettings& settings) {
  const std::string scenario_file = write_scenario(settings);
  const std::vector<std::string> common{
      "--scenario",  scenario_file,      "--domain",    std::to_string(settings.domain),
      "--transport", settings.transport, "--log-level", "warn"};
  for (const auto& [service, sensor] : scenario::required_services(scenario::load(scenario_file))) {
    std::vector<std::string> arguments = common;
    if (service == catalog::kTruthLogger) {
      arguments.insert(arguments.end(), {"--log", settings.folder + "/chain.mcap", "--overwrite"});
    } else if (service != catalog::kReferenceNav) {
      arguments.insert(arguments.end(), {"--sensor", std::to_string(sensor)});
    }
    const bool copies = settings.copying && service != catalog::kTruthLogger;
    if (copies) arguments.insert(arguments.begin(), service);
    processes_.push_back(std::make_unique<Process>(copies ? "bench_copying_service" : service, arguments));
  }
  processes_.push_back(std::make_unique<Process>(catalog::kTrajectoryServer, common));
  if (settings.nav_app == NavApp::ClientOnBlocks || settings.nav_app == NavApp::ClientOnSingles) {
    setenv("FASTRTPS_DEFAULT_PROFILES_FILE", INSLAB_SOURCE_DIR "/config/dds/loopback.xml", 1);
    nav_app_ = std::make_unique<Process>(
        "fastdds_nav_client",
        std::vector<std::string>{"--domain", std::to_string(settings.domain), "--seconds", "600", "--blocks",
                                 settings.nav_app == NavApp::ClientOnBlocks ? "1" : "0"});
    unsetenv("FASTRTPS_DEFAULT_PROFILES_FILE");
  }
}

ChainBlock run_chain(const ChainSettings& settings) {
  const ChainServices services(settings);
  ChainBlock block;
  const auto longest = std::chrono::seconds(60) + time::from_seconds(settings.duration_s);
  for (const auto& process : services.processes()) {
    const ProcessEnd end = process->wait(longest);
    if (!end.good) throw std::runtime_error(process->program() + " failed");
    block.services[process->program()] = end;
  }
  read_latencies(settings.folder + "/chain.mcap", block);
  return block;
}

}  // namespace inslab::bench
