#include "inslab/referee/calibrate/analysis.hpp"

#include <algorithm>
#include <cmath>

namespace inslab::calibrate {
namespace {

constexpr int kPointsPerOctave = 3;

std::vector<CurvePoint> curve_of(const PhaseStore& store, const allan::NoiseModel& model, double dt_s) {
  std::vector<CurvePoint> curve;
  const std::vector<double> phase = store.phase();
  for (const std::int64_t m : allan::curve_cluster_sizes(store.samples(), kPointsPerOctave)) {
    const allan::AllanPoint point = allan::overlapped_allan_variance(phase, dt_s, m);
    const double degrees = allan::equivalent_degrees_of_freedom(point, model, dt_s);
    const allan::Interval variance = allan::variance_interval(point.variance, degrees, kIntervalConfidence);
    curve.push_back({static_cast<double>(point.m) * dt_s,
                     std::sqrt(point.variance),
                     {std::sqrt(variance.low), std::sqrt(variance.high)},
                     std::sqrt(allan::allan_variance(model, dt_s, point.m))});
  }
  return curve;
}

/// Terms that were asked for are fitted as they were asked for, fast or not.
allan::ChosenFit fit_of(const allan::Record& record, const AnalysisOptions& options) {
  if (options.terms.empty()) return allan::choose_fit(record, options.finest_tau_s);
  allan::Likelihood likelihood(record, options.finest_tau_s, allan::Likelihood::Means::Joined);
  allan::Fit fit = allan::fit(likelihood, options.terms);
  return {std::move(likelihood), std::move(fit), options.finest_tau_s, 0.0};
}

AxisAnalysis analyse_axis(std::size_t axis, const allan::Record& record, const PhaseStore& store,
                          const AnalysisOptions& options) {
  AxisAnalysis analysis;
  analysis.axis = axis;
  analysis.mean = record.mean();
  analysis.span_s = record.span_s();
  const auto curve = allan::Likelihood(record, options.finest_tau_s).rough_curve();
  const bool is_constant =
      std::all_of(curve.begin(), curve.end(), [](const auto& point) { return point.variance == 0.0; });
  if (is_constant) return analysis;  // no noise at all: nothing to fit
  const allan::ChosenFit chosen = fit_of(record, options);
  analysis.fit = chosen.fit;
  analysis.finest_tau_s = chosen.finest_tau_s;
  analysis.fast_process_s = chosen.fast_process_s;
  const auto log = [&chosen](const allan::NoiseModel& model) { return chosen.likelihood.log(model); };
  for (const allan::Term term : analysis.fit.terms) {
    for (const allan::Parameter parameter : allan::parameters_of(term)) {
      analysis.parameters.push_back({parameter, allan::value_of(analysis.fit.model, parameter),
                                     allan::likelihood_interval(log, analysis.fit, parameter, kIntervalConfidence)});
    }
  }
  analysis.goodness =
      allan::goodness_of(chosen.likelihood, chosen.fit.model, static_cast<int>(analysis.parameters.size()));
  analysis.curve = curve_of(store, analysis.fit.model, record.dt_s());
  return analysis;
}

}  // namespace

void ImuAnalyser::begin(const recordings::ImuRecordingInfo& info) {
  has_axis_ = info.has_axis;
  records_.assign(recordings::kImuAxes, allan::Record(info.dt_s));
  phases_.clear();
  phases_.resize(recordings::kImuAxes);
}

void ImuAnalyser::add(const recordings::ImuIncrements& increments) {
  for (std::size_t i = 0; i < recordings::kImuAxes; ++i) {
    records_[i].add(increments[i]);
    if (has_axis_[i]) phases_[i].add(increments[i]);
  }
}

ImuAnalysis ImuAnalyser::finish(const std::string& path, const recordings::ImuRecordingInfo& recording) const {
  ImuAnalysis analysis{path, recording, options_.recording.minus_truth, {}};
  for (std::size_t i = 0; i < recordings::kImuAxes; ++i) {
    if (recording.has_axis[i]) analysis.axes.push_back(analyse_axis(i, records_[i], phases_[i], options_));
  }
  return analysis;
}

std::string poor_fits(const ImuAnalysis& analysis) {
  std::string text;
  for (const AxisAnalysis& axis : analysis.axes) {
    if (!axis.goodness.is_poor()) continue;
    text += (text.empty() ? "" : "; ") + std::string(recordings::kImuAxisNames[axis.axis]) + ": " +
            axis.goodness.sentence();
  }
  return text;
}

ImuAnalysis analyse_imu(const std::string& path, const AnalysisOptions& options) {
  ImuAnalyser analyser(options);
  const recordings::ImuRecordingInfo recording = recordings::read_imu_recording(
      path, options.recording, [&](const recordings::ImuRecordingInfo& info) { analyser.begin(info); },
      [&](const recordings::ImuIncrements& increments) { analyser.add(increments); });
  return analyser.finish(path, recording);
}

}  // namespace inslab::calibrate
