// Every model in one process, as `inslab simulate` runs them. One item is one step: a TruthState, and what follows from
// it. Goals for the 200 Hz vehicle scenario on one core: 500 x real time with the full log (100 000 steps/s), 2000 x
// without (400 000 steps/s).

#include <benchmark/benchmark.h>

#include <filesystem>
#include <memory>

#include "inslab/foundation/host/host.hpp"
#include "inslab/referee/evidence/swap_window.hpp"
#include "inslab/sim/log_sink.hpp"
#include "inslab/sim/offline_run.hpp"
#include "tests/unit/sim/journal_of_faults.hpp"

namespace inslab::bench {
namespace {

/// Counts and forgets.
class NoSink : public sim::RunSink {
 public:
  void journal(const catalog::AnyProfile&) override {}
  void truth(const TruthState&) override {}
  void imu(std::size_t, const ImuSample& sample, const ImuTruth&) override {
    Vector3 dv_b = sample.dv_b;  // newer versions of the library take nothing that is const
    benchmark::DoNotOptimize(dv_b);
  }
  void gnss(std::size_t, const GnssFix&) override {}
  void ack(const ProfileAck&) override {}
};

scenario::LoadedScenario vehicle() { return scenario::load(INSLAB_SOURCE_DIR "/config/scenarios/vehicle.json"); }

/// Steps until the benchmark has enough; begins again when the twenty minutes are over.
void drive(benchmark::State& state, const scenario::LoadedScenario& loaded, sim::RunSink& sink) {
  const time::GpsTime start = loaded.start(host::realtime_now());
  auto run = std::make_unique<sim::OfflineRun>(loaded, start, RunId{}, sink);
  for (auto _ : state) {
    if (run->step()) continue;
    state.PauseTiming();
    run = std::make_unique<sim::OfflineRun>(loaded, start, RunId{}, sink);
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations());
  state.counters["x_real_time"] = benchmark::Counter(
      static_cast<double>(state.iterations()) / loaded.scenario.truth_rate_hz, benchmark::Counter::kIsRate);
}

void BM_OfflineWithoutLog(benchmark::State& state) {
  const scenario::LoadedScenario loaded = vehicle();
  NoSink sink;
  drive(state, loaded, sink);
}
BENCHMARK(BM_OfflineWithoutLog);

void BM_OfflineWithLog(benchmark::State& state) {
  const scenario::LoadedScenario loaded = vehicle();
  const std::string path = (std::filesystem::temp_directory_path() / "inslab_offline_bench.mcap").string();
  sim::LogSink sink(path, loaded, loaded.start(host::realtime_now()));
  drive(state, loaded, sink);
  sink.close();
  state.counters["log_bytes_per_step"] =
      static_cast<double>(std::filesystem::file_size(path)) / static_cast<double>(state.iterations());
  std::filesystem::remove(path);
}
BENCHMARK(BM_OfflineWithLog);

/// The windows of a soak's swaps: one item is a swap with its first sample. What one costs may not grow with their
/// number.
void BM_SwapWindows(benchmark::State& state) {
  const auto swaps = static_cast<std::uint32_t>(state.range(0));
  const evidence::LogSummary summary = sim::journal_of_faults(swaps);
  for (auto _ : state) {
    evidence::SwapWindowsOfLog windows(summary);
    for (std::uint32_t i = 1; i <= swaps; ++i) windows.add(sim::sample_after(i, swaps), ImuTruth{}, TruthState{});
    benchmark::DoNotOptimize(windows.all().size());
  }
  state.SetItemsProcessed(state.iterations() * swaps);
  state.SetComplexityN(state.range(0));
}
BENCHMARK(BM_SwapWindows)->Range(2000, 16000)->Complexity();

}  // namespace
}  // namespace inslab::bench
