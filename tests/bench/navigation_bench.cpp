// The cost of one IMU epoch in the strapdown mechanization, and of its inverse.

#include <benchmark/benchmark.h>

#include "inslab/nav/attitude.hpp"
#include "inslab/nav/strapdown.hpp"

namespace inslab::bench {
namespace {

constexpr double kDt_s = 0.005;

nav::NavState start() { return {{0.5, 2.0, 100.0}, {10.0, -5.0, 0.0}, nav::Quaternion::Identity()}; }

/// Level turning, rocked and shaken from one interval to the next: coning and sculling terms are not 0.
nav::ImuIncrements increments(int k) {
  static const double g_m_per_s2 = nav::Gravity().g_n(start().position).z();
  const double sign = k % 2 == 0 ? 1.0 : -1.0;
  return {{1e-3 * sign, -1e-3 * sign, 2e-3}, {0.01 * sign, 0.02 * sign, -g_m_per_s2 * kDt_s}, kDt_s};
}

void advance(benchmark::State& state, bool full_rotation_term) {
  nav::Strapdown strapdown(start(), nav::Gravity(), {full_rotation_term});
  int k = 0;
  for (auto _ : state) strapdown.advance(increments(++k));
  benchmark::DoNotOptimize(strapdown);
  state.SetItemsProcessed(state.iterations());
}

void StrapdownAsPrinted(benchmark::State& state) { advance(state, false); }
void StrapdownWithFullRotation(benchmark::State& state) { advance(state, true); }

void StrapdownInverse(benchmark::State& state) {
  nav::Strapdown strapdown(start(), nav::Gravity(), {});
  strapdown.advance(increments(0));
  double sum = 0.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(sum += strapdown.increments_to(start().v_n, start().q_nb, kDt_s).dv_b.x());
  }
  state.SetItemsProcessed(state.iterations());
}

// An hour: the increments above do not keep the body within the valid domain for ever.
BENCHMARK(StrapdownAsPrinted)->Iterations(720000);
BENCHMARK(StrapdownWithFullRotation)->Iterations(720000);
BENCHMARK(StrapdownInverse);

}  // namespace
}  // namespace inslab::bench
