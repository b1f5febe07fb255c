// The cost of one truth sample along curves: the promise is half a million steps per second at 200 Hz, whatever the
// number of rows. Making the curves is counted apart.

#include <benchmark/benchmark.h>

#include <cmath>

#include "inslab/models/trajectory/row_motion.hpp"
#include "inslab/models/trajectory/smooth_model.hpp"
#include "inslab/models/trajectory/waypoint_motion.hpp"

namespace inslab::bench {
namespace {

/// A vehicle that weaves to and fro over rolling ground at up to 15 m/s, with attitude.
TrajectoryFile weaving(double rate_hz, double seconds) {
  TrajectoryFile file;
  file.name = "weaving";
  const nav::Geodetic start{0.53, 2.0, 20.0};
  const auto rows = static_cast<std::int64_t>(seconds * rate_hz) + 1;
  for (std::int64_t k = 0; k < rows; ++k) {
    const double t_s = static_cast<double>(k) / rate_hz;
    nav::Geodetic here = nav::displaced(start, {40.0 * std::sin(0.1 * t_s), 3000.0 * std::sin(0.005 * t_s), 0.0});
    here.height_m = 20.0 + 5.0 * std::sin(0.05 * t_s);
    file.rows.push_back(
        {time::from_seconds(t_s), here, std::nullopt,
         nav::RollPitchYaw{0.02 * std::sin(t_s), 0.02 * std::cos(t_s), 1.57 + 0.27 * std::cos(0.1 * t_s)}});
  }
  return file;
}

void drive(benchmark::State& state, trajectory::SmoothMotion motion) {
  trajectory::SmoothModel model(std::move(motion), "row", nav::Gravity(), time::Rate(200.0), {2300, 0});
  double sum = 0.0;
  for (auto _ : state) benchmark::DoNotOptimize(sum += model.advance().dv_v.x());
  state.SetItemsProcessed(state.iterations());
}

void SplineAt1Hz(benchmark::State& state) { drive(state, trajectory::motion_through(weaving(1.0, 1300.0), {})); }
void SplineAt10Hz(benchmark::State& state) { drive(state, trajectory::motion_through(weaving(10.0, 1300.0), {})); }
void SplineAt200Hz(benchmark::State& state) { drive(state, trajectory::motion_through(weaving(200.0, 1300.0), {})); }
void SplineOfADayAt1Hz(benchmark::State& state) { drive(state, trajectory::motion_through(weaving(1.0, 86400.0), {})); }
void SplineOfAnHourAt200Hz(benchmark::State& state) {
  drive(state, trajectory::motion_through(weaving(200.0, 3600.0), {}));
}

void Waypoints(benchmark::State& state) {
  scenario::Trajectory trajectory;
  trajectory.source = scenario::TrajectorySource::Waypoints;
  for (int k = 0; k < 200; ++k)
    trajectory.waypoints.push_back({30.0 + 0.002 * (k % 2), 114.0 + 0.004 * k, 20.0, 15.0, 0.0});
  drive(state, trajectory::motion_along_waypoints(trajectory, std::chrono::hours(24)));
}

/// Rows to curves, once for a file: linear in the rows.
void MakeCurves(benchmark::State& state) {
  const TrajectoryFile file = weaving(1.0, static_cast<double>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(trajectory::motion_through(file, {}).path.get());
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

// 240000 samples are 20 minutes.
BENCHMARK(SplineAt1Hz)->Iterations(240000);
BENCHMARK(SplineAt10Hz)->Iterations(240000);
BENCHMARK(SplineAt200Hz)->Iterations(240000);
BENCHMARK(SplineOfADayAt1Hz)->Iterations(240000);
BENCHMARK(SplineOfAnHourAt200Hz)->Iterations(240000);
BENCHMARK(Waypoints)->Iterations(240000);
BENCHMARK(MakeCurves)->Arg(100)->Arg(10000)->Arg(720000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace inslab::bench
