#include "inslab/referee/calibrate/analysis.hpp"

#include <cmath>

namespace inslab::cli {
namespace {

/// More tau than any record has: 2^46 samples.
constexpr std::int64_t kLargestCluster = std::int64_t{1} << 46;
constexpr int kPointsPerOctave = 3;
/// The curve ends where a point has hardly a degree of freedom.
constexpr std::int64_t kLeastClusters = 8;

struct AxisInput {
  AxisInput(double dt_s, const std::vector<std::int64_t>& sizes) : record(dt_s), curve(dt_s, sizes) {}
  allan::Record record;
  allan::AllanStream curve;
};

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

AxisAnalysis analyse_axis(std::size_t axis, const AxisInput& input, const AnalysisOptions& options) {
  AxisAnalysis analysis;
  analysis.axis = axis;
  analysis.mean = input.record.mean();
  analysis.span_s = input.record.span_s();
  const allan::Likelihood likelihood(input.record, options.finest_tau_s);
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
  analysis.curve = curve_of(input.curve, analysis.fit.model, input.record.dt_s());
  return analysis;
}

}  // namespace

ImuAnalysis analyse_imu(const std::string& path, const AnalysisOptions& options) {
  ImuAnalysis analysis;
  analysis.path = path;
  analysis.is_error = options.recording.minus_truth;
  std::vector<AxisInput> inputs;
  const auto sizes = allan::octave_cluster_sizes(kLargestCluster, kPointsPerOctave);
  analysis.recording = io::read_imu_recording(
      path, options.recording,
      [&](const io::ImuRecordingInfo& info) { inputs.assign(io::kImuAxes, AxisInput(info.dt_s, sizes)); },
      [&](const io::ImuIncrements& increments) {
        for (std::size_t i = 0; i < io::kImuAxes; ++i) {
          inputs[i].record.add(increments[i]);
          inputs[i].curve.add(increments[i]);
        }
      });
  for (std::size_t i = 0; i < io::kImuAxes; ++i) {
    if (analysis.recording.has_axis[i]) analysis.axes.push_back(analyse_axis(i, inputs[i], options));
  }
  return analysis;
}

}  // namespace inslab::cli
