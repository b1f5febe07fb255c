// The cost of one IMU epoch in the reference navigation app's filter.

#include <benchmark/benchmark.h>

#include "inslab/models/navigation/navigation_filter.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::bench {
namespace {

constexpr std::int64_t kPeriod_ns = 5'000'000;
constexpr int kHour = 720000;  // epochs

/// At rest, shaken from one interval to the next, with fixes at 5 Hz.
ImuSample sample_at(std::uint64_t k, const nav::NavState& state, const nav::Gravity& gravity) {
  const double dt_s = 1e-9 * kPeriod_ns, sign = k % 2 == 0 ? 1.0 : -1.0;
  ImuSample sample;
  sample.header.sequence_number = k;
  sample.header.sim_time_ns = static_cast<std::int64_t>(k + 1) * kPeriod_ns;
  sample.interval_ns = kPeriod_ns;
  sample.dtheta_b = dt_s * nav::omega_ie_n(state.position.latitude_rad) + Vector3(1e-4, -1e-4, 0.0) * sign;
  sample.dv_b = -dt_s * gravity.g_n(state.position) + Vector3(0.001, 0.002, 0.0) * sign;
  return sample;
}

void filter_epochs(benchmark::State& state, double covariance_interval_s, double max_latency_s) {
  const nav::Gravity gravity;
  const nav::NavState rest{{0.5, 2.0, 100.0}, Vector3::Zero(), nav::Quaternion::Identity()};
  navigation::NavigationParameters parameters;
  parameters.covariance_interval_s = covariance_interval_s;
  parameters.max_latency_s = max_latency_s;
  navigation::NavigationFilter filter(parameters, gravity);
  filter.start(rest, 0);
  GnssFix fix;
  fix.fix_type = FixType::Fixed;
  fix.latitude_rad = rest.position.latitude_rad;
  fix.longitude_rad = rest.position.longitude_rad;
  fix.height_m = rest.position.height_m;
  fix.position_sigma_ned_m.setConstant(0.02);
  fix.velocity_sigma_ned_m_per_s.setConstant(0.03);
  std::uint64_t k = 0;
  for (auto _ : state) {
    const ImuSample sample = sample_at(k++, rest, gravity);
    benchmark::DoNotOptimize(filter.add(sample));
    if (k % 40 == 0) {
      fix.header.sim_time_ns = sample.header.sim_time_ns;
      filter.add(fix);
    }
    if (k % 4000 == 0) filter.take_results();
  }
  if (filter.filter() == nullptr) state.SkipWithError("the filter was lost");
  state.SetItemsProcessed(state.iterations());
}

void FilterEpoch(benchmark::State& state) { filter_epochs(state, 0.02, 1.0); }
void FilterEpochCovarianceEveryEpoch(benchmark::State& state) { filter_epochs(state, 0.0, 1.0); }
void FilterEpochWithoutPast(benchmark::State& state) { filter_epochs(state, 0.02, 0.0); }

BENCHMARK(FilterEpoch)->Iterations(kHour);
BENCHMARK(FilterEpochCovarianceEveryEpoch)->Iterations(kHour);
BENCHMARK(FilterEpochWithoutPast)->Iterations(kHour);

}  // namespace
}  // namespace inslab::bench
