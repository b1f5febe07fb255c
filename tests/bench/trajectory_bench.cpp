// The cost of one truth sample: the promise is a million steps per second at 200 Hz, whatever the table's length and
// its number of segments.

#include <benchmark/benchmark.h>

#include "inslab/models/trajectory/inverse_mechanization_model.hpp"
#include "inslab/models/trajectory/motion_table_model.hpp"
#include "tests/unit/models/trajectory/file_rows.hpp"
#include "tests/unit/models/trajectory/tables.hpp"

namespace inslab::bench {
namespace {

void drive(benchmark::State& state, const scenario::Trajectory& trajectory, double rate_hz) {
  trajectory::MotionTableModel model(trajectory, time::Rate(rate_hz), {2300, 0});
  double sum = 0.0;
  for (auto _ : state) benchmark::DoNotOptimize(sum += model.advance().dv_v.x());
  state.SetItemsProcessed(state.iterations());
}

void Static(benchmark::State& state) { drive(state, trajectory::tables::at_wuhan(), 200.0); }
void Vehicle(benchmark::State& state) { drive(state, trajectory::tables::vehicle(), 200.0); }
void Aircraft(benchmark::State& state) { drive(state, trajectory::tables::aircraft(), 200.0); }
void Ship(benchmark::State& state) { drive(state, trajectory::tables::ship(), 200.0); }
void VehicleAt1kHz(benchmark::State& state) { drive(state, trajectory::tables::vehicle(), 1000.0); }

void Rocket(benchmark::State& state) { drive(state, trajectory::tables::rocket(), 200.0); }

/// A table of that many segments from its start to its end: 100 steps a segment, so that its length grows with it.
void Segments(benchmark::State& state) {
  scenario::Trajectory table = trajectory::tables::at_wuhan();
  for (int i = 0; i < state.range(0); i += 2) {
    table.segments.push_back(
        trajectory::tables::segment(0.5, {trajectory::tables::target_speed(i % 4 == 0 ? 10.0 : 5.0)}));
    table.segments.push_back(trajectory::tables::segment(0.5, {trajectory::tables::turn(i % 4 == 0 ? 20.0 : -20.0)}));
  }
  drive(state, table, 200.0);
}

/// Rows at the rate given, truth at 200 Hz.
void InverseMechanization(benchmark::State& state) {
  const auto file = std::make_shared<TrajectoryFile>(
      trajectory::rows_of(trajectory::tables::vehicle(), static_cast<double>(state.range(0)), 1200.0));
  trajectory::InverseMechanizationModel model(file, nav::Gravity(), {}, time::Rate(200.0), {2300, 0});
  double sum = 0.0;
  for (auto _ : state) benchmark::DoNotOptimize(sum += model.advance().dv_v.x());
  state.SetItemsProcessed(state.iterations());
}

// 240000 samples are 20 minutes: what follows the table is cheaper and not counted.
BENCHMARK(Static)->Iterations(240000);
BENCHMARK(Vehicle)->Iterations(240000);
BENCHMARK(Aircraft)->Iterations(240000);
BENCHMARK(Ship)->Iterations(240000);
BENCHMARK(VehicleAt1kHz)->Iterations(1200000);
BENCHMARK(InverseMechanization)->Arg(200)->Arg(10)->Iterations(240000);
BENCHMARK(Rocket)->Iterations(13000);
BENCHMARK(Segments)->Arg(100)->Iterations(10000);
BENCHMARK(Segments)->Arg(1000)->Iterations(100000);
BENCHMARK(Segments)->Arg(10000)->Iterations(1000000);
BENCHMARK(Segments)->Arg(100000)->Iterations(10000000);

}  // namespace
}  // namespace inslab::bench
