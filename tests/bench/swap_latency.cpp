#include "tests/bench/swap_latency.hpp"

#include <atomic>
#include <memory>
#include <random>
#include <stdexcept>
#include <thread>

#include "inslab/bus/client/run_client.hpp"
#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/service/service.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::bench {

using std::chrono::seconds;

std::vector<double> measure_swap_latency(const ChainSettings& settings, int count) {
  const ChainServices services(settings);
  service::NetworkOptions network;
  network.domain = settings.domain;
  network.transport = settings.transport;
  dds::Participant participant(service::participant_options(network, "bench"));
  client::RunClient client(participant);
  std::atomic<std::uint32_t> revision{0};
  std::atomic<std::int64_t> changed_at_ns{0};
  const dds::Reader<ImuSample> reader(participant, dds::topics::stream<ImuSample>(0),
                                      [&](const ImuSample& sample, const dds::SampleOrigin&) {
                                        if (sample.revisions.imu_error == revision.load()) return;
                                        changed_at_ns = host::monotonic_now().count();
                                        revision = sample.revisions.imu_error;
                                      });
  const auto running = [&] { return client.connected() && client.status() && client.status()->sim_time_ns > 0; };
  if (!client::wait_for(host::monotonic_now() + seconds(30), running, "the set"))
    throw std::runtime_error("the set did not start");

  std::vector<catalog::AnyProfile> profiles;
  for (const char* name : {"mems_automotive", "stim300"}) {
    profiles.push_back(scenario::load_profile(std::string(INSLAB_SOURCE_DIR "/config/profiles/imu/") + name + ".json",
                                              ProfileKind::ImuError, {SensorKind::Imu, 0}));
  }
  std::mt19937 random(1);
  std::vector<double> waits_s;
  for (int i = 0; i < count; ++i) {
    std::this_thread::sleep_for(std::chrono::microseconds(10'000 + random() % 30'000));
    catalog::AnyProfile& profile = profiles[static_cast<std::size_t>(i) % 2];
    catalog::request_of(profile).request_id = static_cast<std::uint64_t>(i) + 1;
    const std::uint32_t before = revision;
    const time::Nanoseconds sent_at = host::monotonic_now();
    if (!client.send(profile)) throw std::runtime_error("a swap could not be sent");
    while (revision == before) {
      if (host::monotonic_now() - sent_at > seconds(5)) throw std::runtime_error("a swap did not show");
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    waits_s.push_back(time::to_seconds(time::Nanoseconds(changed_at_ns) - sent_at));
  }
  client.send({1, CommandKind::Stop, 0.0});
  return waits_s;
}

}  // namespace inslab::bench
