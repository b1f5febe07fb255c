#include "inslab/referee/calibrate/analysis.hpp"

#include <cmath>

namespace inslab::calibrate {
namespace {

/// More tau than any record has: 2^46 samples.
constexpr std::int64_t kLargestCluster = std::int64_t{1} << 46;
constexpr int kPointsPerOctave = 3;
/// The curve ends where a point has hardly a degree of freedom.
constexpr std::int64_t kLeastClusters = 8;

std::vector<CurvePoint> curve_of(const allan::AllanStream& stream, const allan::NoiseModel& model, double dt_s) {
  std::vector<CurvePoint> curve;
  for (const allan::AllanPoint& point : stream.points()) {
    if (point.m * kLeastClusters > stream.samples()) break;
    const double degrees = allan::equivalent_degrees_of_freedom(point, model, dt_s);
    const allan::Interval variance = allan::variance_interval(point.variance, degrees, kIntervalConfidence);
    curve.push_back({static_cast<double>(point.m) * dt_s,
                     std::sqrt(point.variance),
                     {std::sqrt(variance.low), std::sqrt(variance.high)},
                     std::sqrt(allan::allan_variance(model, dt_s, point.m))});
  }
  return curve;
}

AxisAnalysis analyse_axis(std::size_t axis, const allan::Record& record, const allan::AllanStream& stream,
                          const AnalysisOptions& options) {
  AxisAnalysis analysis;
  analysis.axis = axis;
  analysis.mean = record.mean();
  analysis.span_s = record.span_s();
  const allan::Likelihood likelihood(record, options.finest_tau_s);
  const auto curve = likelihood.rough_curve();
  const bool is_constant =
      std::all_of(curve.begin(), curve.end(), [](const auto& point) { return point.second == 0.0; });
  if (is_constant) return analysis;  // no noise at all: nothing to fit
  analysis.fit = options.terms.empty() ? allan::select(likelihood) : allan::fit(likelihood, options.terms);
  const auto log = [&likelihood](const allan::NoiseModel& model) { return likelihood.log(model); };
  for (const allan::Term term : analysis.fit.terms) {
    for (const allan::Parameter parameter : allan::parameters_of(term)) {
      analysis.parameters.push_back({parameter, allan::value_of(analysis.fit.model, parameter),
                                     allan::likelihood_interval(log, analysis.fit, parameter, kIntervalConfidence)});
    }
  }
  analysis.curve = curve_of(stream, analysis.fit.model, record.dt_s());
  return analysis;
}

}  // namespace

void ImuAnalyser::begin(const recordings::ImuRecordingInfo& info) {
  const auto sizes = allan::octave_cluster_sizes(kLargestCluster, kPointsPerOctave);
  records_.assign(recordings::kImuAxes, allan::Record(info.dt_s));
  curves_.assign(recordings::kImuAxes, allan::AllanStream(info.dt_s, sizes));
}

void ImuAnalyser::add(const recordings::ImuIncrements& increments) {
  for (std::size_t i = 0; i < recordings::kImuAxes; ++i) {
    records_[i].add(increments[i]);
    curves_[i].add(increments[i]);
  }
}

ImuAnalysis ImuAnalyser::finish(const std::string& path, const recordings::ImuRecordingInfo& recording) const {
  ImuAnalysis analysis{path, recording, options_.recording.minus_truth, {}};
  for (std::size_t i = 0; i < recordings::kImuAxes; ++i) {
    if (recording.has_axis[i]) analysis.axes.push_back(analyse_axis(i, records_[i], curves_[i], options_));
  }
  return analysis;
}

ImuAnalysis analyse_imu(const std::string& path, const AnalysisOptions& options) {
  ImuAnalyser analyser(options);
  const recordings::ImuRecordingInfo recording = recordings::read_imu_recording(
      path, options.recording, [&](const recordings::ImuRecordingInfo& info) { analyser.begin(info); },
      [&](const recordings::ImuIncrements& increments) { analyser.add(increments); });
  return analyser.finish(path, recording);
}

}  // namespace inslab::calibrate
