#include "inslab/referee/calibrate/report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "inslab/foundation/units/units.hpp"
#include "inslab/referee/calibrate/fitted_profile.hpp"

namespace inslab::calibrate {
namespace {

double rate_unit(bool is_gyro) { return is_gyro ? units::kDegPerH : units::kMGal; }
const char* rate_unit_name(bool is_gyro) { return is_gyro ? "deg/h" : "mGal"; }

const char* term_name(allan::Parameter parameter, bool is_gyro) {
  switch (parameter) {
    case allan::Parameter::White:
      return is_gyro ? "white noise (angle random walk)" : "white noise (velocity random walk)";
    case allan::Parameter::Quantization:
      return "quantization, one count";
    case allan::Parameter::Flicker:
      return "flicker (bias instability)";
    case allan::Parameter::RandomWalk:
      return "random walk of the bias";
    case allan::Parameter::GmSigma:
      return "Gauss-Markov bias, sigma";
    case allan::Parameter::GmCorrelationTime:
      break;
  }
  return "Gauss-Markov bias, correlation time";
}

std::string bound(double value) { return std::isinf(value) ? "unbounded" : fmt::format("{:.5g}", value); }

std::string axis_text(const AxisAnalysis& axis) {
  const double unit = rate_unit(axis.is_gyro());
  std::string text = fmt::format("{}: mean {:.6g} {}\n", recordings::kImuAxisNames[axis.axis], axis.mean / unit,
                                 rate_unit_name(axis.is_gyro()));
  if (axis.parameters.empty()) return text + "  no noise at all\n";
  for (const FittedParameter& fitted : axis.parameters) {
    const ProfileUnit in = profile_unit(fitted.parameter, axis.is_gyro());
    text += fmt::format("  {:<36} {:>11.5g}  {:>11} to {:<11} {}\n", term_name(fitted.parameter, axis.is_gyro()),
                        fitted.value / in.si, bound(fitted.interval.low / in.si), bound(fitted.interval.high / in.si),
                        in.unit);
  }
  if (axis.fast_process_s > 0.0) {
    text += fmt::format("  a process of {:.3g} s, faster than a few samples, is taken for white noise\n",
                        axis.fast_process_s);
  }
  if (axis.finest_tau_s > 0.0) text += fmt::format("  fitted from tau {:.3g} s on\n", axis.finest_tau_s);
  return text + fmt::format("  chi-square of the residuals {:.4g}, degrees of freedom {}, chance {:.2g}: {}\n",
                            axis.goodness.chi_square, axis.goodness.degrees, axis.goodness.probability,
                            axis.goodness.sentence());
}

/// One line a tau an octave apart, one column an axis.
std::string deviations_text(const ImuAnalysis& analysis) {
  const std::vector<CurvePoint>* longest = nullptr;
  std::string text = fmt::format("{:>12}", "tau s");
  for (const AxisAnalysis& axis : analysis.axes) {
    text += fmt::format("  {:>14}",
                        fmt::format("{} {}", recordings::kImuAxisNames[axis.axis], rate_unit_name(axis.is_gyro())));
    if (longest == nullptr || axis.curve.size() > longest->size()) longest = &axis.curve;
  }
  text += "\n";
  if (longest == nullptr) return text;
  double next_tau_s = 0.0;
  for (std::size_t i = 0; i < longest->size(); ++i) {
    const double tau_s = (*longest)[i].tau_s;
    if (tau_s < next_tau_s) continue;
    next_tau_s = 1.99 * tau_s;
    text += fmt::format("{:>12.6g}", tau_s);
    for (const AxisAnalysis& axis : analysis.axes) {
      text += i < axis.curve.size() ? fmt::format("  {:>14.5g}", axis.curve[i].deviation / rate_unit(axis.is_gyro()))
                                    : fmt::format("  {:>14}", "-");
    }
    text += "\n";
  }
  return text;
}

/// One picture of a triad: the points, their 99 % band dotted, the fit.
tables::Panel panel(const ImuAnalysis& analysis, bool is_gyro) {
  constexpr const char* kColours[] = {"#c0392b", "#27803b", "#2464a8"};
  tables::Panel panel;
  panel.title = is_gyro ? "gyroscopes" : "accelerometers";
  panel.x_label = "tau (s)";
  panel.y_label = fmt::format("Allan deviation ({})", rate_unit_name(is_gyro));
  panel.log_x = panel.log_y = true;
  for (const AxisAnalysis& axis : analysis.axes) {
    if (axis.is_gyro() != is_gyro || axis.curve.empty()) continue;
    const std::string colour = fmt::format(" linecolor rgb '{}'", kColours[axis.axis % 3]);
    tables::Curve points{
        std::string(recordings::kImuAxisNames[axis.axis]), {}, {}, "points pointtype 7 pointsize 0.4" + colour};
    tables::Curve low{"", {}, {}, "lines dashtype 3" + colour}, high = low;
    tables::Curve fitted{"", {}, {}, "lines linewidth 1.5" + colour};
    const auto add = [unit = rate_unit(is_gyro)](tables::Curve& curve, double tau_s, double value) {
      curve.x.push_back(tau_s);
      curve.y.push_back(value > 0.0 ? value / unit : std::numeric_limits<double>::quiet_NaN());
    };
    for (const CurvePoint& point : axis.curve) {
      add(points, point.tau_s, point.deviation);
      add(low, point.tau_s, point.interval.low);
      add(high, point.tau_s, point.interval.high);
      add(fitted, point.tau_s, point.fitted);
    }
    panel.curves.insert(panel.curves.end(), {points, low, high, fitted});
  }
  return panel;
}

}  // namespace

std::string report_text(const ImuAnalysis& analysis) {
  const recordings::ImuRecordingInfo& recording = analysis.recording;
  std::string text =
      fmt::format("{} ({}): {} samples at {:.6g} Hz, {:.6g} s\n", analysis.path, recording.kind, recording.samples,
                  1.0 / recording.dt_s, static_cast<double>(recording.samples) * recording.dt_s);
  if (recording.gaps > 0) text += fmt::format("{} gaps, passed over\n", recording.gaps);
  if (recording.invalid > 0)
    text += fmt::format("{} samples that are marked as not valid, left out\n", recording.invalid);
  text += fmt::format("\nFitted, with 99 % intervals of the likelihood ratio\n\n");
  for (const AxisAnalysis& axis : analysis.axes) text += axis_text(axis);
  return text + "\nOverlapped Allan deviation\n\n" + deviations_text(analysis);
}

std::string curve_csv(const ImuAnalysis& analysis) {
  std::string text = "axis,tau_s,deviation,low_99,high_99,fitted\n";
  for (const AxisAnalysis& axis : analysis.axes) {
    for (const CurvePoint& point : axis.curve) {
      text += fmt::format("{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", recordings::kImuAxisNames[axis.axis],
                          point.tau_s, point.deviation, point.interval.low, point.interval.high, point.fitted);
    }
  }
  return text;
}

tables::Picture curve_picture(const ImuAnalysis& analysis) {
  tables::Picture picture;
  picture.title = analysis.is_error ? "Allan deviation of the IMU's errors" : "Allan deviation";
  picture.panel_width_px = 900;
  picture.panel_height_px = 480;
  for (const bool is_gyro : {true, false}) {
    tables::Panel triad = panel(analysis, is_gyro);
    if (!triad.curves.empty()) picture.panels.push_back(std::move(triad));
  }
  return picture;
}

}  // namespace inslab::calibrate
