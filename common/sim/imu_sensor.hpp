#pragma once

#include <tuple>

#include "inslab/models/imu/imu_model.hpp"
#include "inslab/sim/run_sink.hpp"
#include "inslab/sim/sensor.hpp"

namespace inslab::sim {

template <>
struct SensorModel<catalog::Imu> {
  using Model = imu::ImuModel;
  using Output = Model::Output;

  static Model::Setup setup(const scenario::LoadedScenario& scenario, const scenario::LoadedImu& imu) {
    return {scenario.stream_seed(), imu.number,       imu.rate,       scenario.gravity(), imu.errors,
            imu.vibration,          imu.installation, scenario.end(), scenario.recordings};
  }
  /// An IMU slower than the truth swaps between two of its own intervals: only where one begins is anything due.
  static bool takes_profiles_at(const time::Rate& rate, const TruthState& truth) {
    return rate.contains(time::Nanoseconds(truth.header.sim_time_ns - truth.interval_ns));
  }
  static std::optional<Output> process(Model& model, const TruthState& truth) { return model.measure(truth); }
  static void hand(RunSink& sink, std::size_t index, const Output& output) {
    sink.imu(index, output.sample, output.truth);
  }
  static auto samples(Output& output) { return std::tie(output.sample, output.truth); }
};

}  // namespace inslab::sim
