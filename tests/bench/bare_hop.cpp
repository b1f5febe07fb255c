#include "tests/bench/bare_hop.hpp"

#include <atomic>
#include <deque>
#include <fstream>
#include <thread>

#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/dds/writer.hpp"
#include "inslab/data/streams/stamp.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/time/rate.hpp"
#include "tests/bench/process.hpp"

namespace inslab::bench {

using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

dds::Topic<TruthState> ping_topic(double rate_hz) { return {"inslab_bench/ping", dds::Delivery::Stream, rate_hz}; }

std::size_t sample_count(const BareHop& hop) { return static_cast<std::size_t>(hop.rate_hz * hop.duration_s); }

template <class Condition>
bool wait_until(Condition condition, std::chrono::nanoseconds timeout) {
  const auto deadline = host::monotonic_now() + timeout;
  while (!condition()) {
    if (host::monotonic_now() > deadline) return false;
    std::this_thread::sleep_for(milliseconds(5));
  }
  return true;
}

}  // namespace

int write_bare_hop(const BareHop& hop) {
  dds::Participant participant(hop.network);
  dds::Writer<TruthState> writer(participant, ping_topic(hop.rate_hz));
  if (!wait_until([&] { return writer.matched_readers() == hop.readers; }, seconds(10))) return 1;
  host::use_precise_timers();
  const time::Rate rate(hop.rate_hz);
  // The same head start as the trajectory server gives.
  const time::Nanoseconds zero = host::monotonic_now() + milliseconds(100);
  TruthState sample;
  for (std::size_t k = 0; k < sample_count(hop); ++k) {
    host::sleep_until(zero + static_cast<std::int64_t>(k) * rate.period());
    sample.header.sequence_number = k;
    if (!writer.write(streams::stamped(sample))) return 1;
  }
  return writer.wait_for_acknowledgments(seconds(5)) ? 0 : 1;
}

int read_bare_hop(const BareHop& hop, const std::string& result_file) {
  std::vector<double> latencies(sample_count(hop));
  std::atomic<std::size_t> count{0};
  dds::Participant participant(hop.network);
  dds::Reader<TruthState> reader(
      participant, ping_topic(hop.rate_hz), [&](const TruthState& sample, const dds::SampleOrigin&) {
        const auto age = host::monotonic_now() - time::Nanoseconds(sample.header.publish_monotonic_ns);
        const std::size_t k = count.load(std::memory_order_relaxed);
        if (k < latencies.size()) latencies[k] = time::to_seconds(age);
        count.store(k + 1, std::memory_order_release);
      });
  const auto longest = seconds(15) + time::from_seconds(hop.duration_s);
  if (!wait_until([&] { return count.load(std::memory_order_acquire) == latencies.size(); }, longest)) return 1;
  std::ofstream file(result_file);
  for (const double latency : latencies) file << latency << '\n';
  return file.good() ? 0 : 1;
}

std::vector<double> measure_bare_hop(const BareHop& hop, const std::string& transport, const std::string& folder) {
  const std::vector<std::string> common{
      "--domain",  std::to_string(hop.network.domain), "--transport", transport,
      "--rate",    std::to_string(hop.rate_hz),        "--seconds",   std::to_string(hop.duration_s),
      "--readers", std::to_string(hop.readers)};
  const auto with = [&common](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), common.begin(), common.end());
    return arguments;
  };
  const auto result_file = [&folder](int i) { return folder + "/bare_hop_" + std::to_string(i) + ".txt"; };
  std::deque<Process> readers;
  for (int i = 0; i < hop.readers; ++i) {
    readers.emplace_back("bench_chain", with({"--body", "bare-reader", "--result", result_file(i)}));
  }
  Process writer("bench_chain", with({"--body", "bare-writer"}));
  const auto longest = seconds(30) + time::from_seconds(hop.duration_s);
  bool good = writer.wait(longest).good;
  for (Process& reader : readers) good = reader.wait(longest).good && good;
  if (!good) throw std::runtime_error("the bare hop lost samples");
  std::vector<double> all;
  for (int i = 0; i < hop.readers; ++i) {
    std::vector<double> latencies;
    std::ifstream file(result_file(i));
    for (double latency = 0.0; file >> latency;) latencies.push_back(latency);
    all.insert(all.end(), latencies.begin() + static_cast<std::ptrdiff_t>(0.5 * hop.rate_hz), latencies.end());
  }
  return all;
}

}  // namespace inslab::bench
