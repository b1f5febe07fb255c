#include "inslab/referee/verify/still_imu.hpp"

#include <cmath>

#include "inslab/referee/verify/run_start.hpp"

namespace inslab::verify {
namespace {

/// As the fit needs it at T = 10 s over 20 h: clusters of a quarter of T.
constexpr std::size_t kClusters = 32768;
constexpr int kPointsPerOctave = 1;

scenario::LoadedScenario still(const ImuErrorProfile& errors, double rate_hz, double duration_s, std::uint64_t seed) {
  scenario::LoadedScenario loaded;
  loaded.scenario.name = "still";
  loaded.scenario.seed = seed;
  loaded.scenario.duration_s = duration_s;
  loaded.scenario.truth_rate_hz = rate_hz;
  loaded.scenario.trajectory.initial.latitude_deg = 30.0;
  loaded.scenario.trajectory.initial.longitude_deg = 114.0;
  scenario::Segment rest;
  rest.duration_s = duration_s;
  loaded.scenario.trajectory.segments.push_back(rest);
  loaded.truth_rate = time::Rate(rate_hz);
  loaded.truth_samples = static_cast<std::uint64_t>(std::llround(duration_s * rate_hz)) + 1;
  scenario::LoadedImu imu;
  imu.rate = loaded.truth_rate;
  imu.errors = errors;
  loaded.imus.push_back(imu);
  return loaded;
}

/// Takes the IMU's output apart by axis.
class AxesSink : public sim::RunSink {
 public:
  AxesSink(double dt_s, std::int64_t largest_cluster)
      : records_(6, allan::Record(dt_s, kClusters)),
        curves_(6, allan::AllanStream(dt_s, allan::octave_cluster_sizes(largest_cluster, kPointsPerOctave))) {}

  void journal(const catalog::AnyProfile&) override {}
  void truth(const TruthState&) override {}
  void gnss(std::size_t, const GnssFix&) override {}
  void ack(const ProfileAck&) override {}
  void imu(std::size_t, const ImuSample& sample, const ImuTruth&) override {
    for (int axis = 0; axis < 3; ++axis) {
      take(static_cast<std::size_t>(axis), sample.dtheta_b[axis]);
      take(static_cast<std::size_t>(3 + axis), sample.dv_b[axis]);
    }
  }

  std::vector<AxisRecord> axes() const {
    std::vector<AxisRecord> axes;
    for (std::size_t i = 0; i < records_.size(); ++i) axes.push_back({records_[i], curves_[i].points()});
    return axes;
  }

 private:
  void take(std::size_t axis, double increment) {
    records_[axis].add(increment);
    curves_[axis].add(increment);
  }

  std::vector<allan::Record> records_;
  std::vector<allan::AllanStream> curves_;
};

}  // namespace

std::vector<AxisRecord> record_still_imu(const ImuErrorProfile& errors, double rate_hz, double duration_s,
                                         std::uint64_t seed, const Simulation& simulation) {
  const scenario::LoadedScenario loaded = still(errors, rate_hz, duration_s, seed);
  // Beyond an eighth of the record a point has hardly a degree of freedom.
  AxesSink sink(1.0 / rate_hz, static_cast<std::int64_t>(duration_s * rate_hz / 8.0));
  simulation(loaded, kStart, sink);
  return sink.axes();
}

}  // namespace inslab::verify
