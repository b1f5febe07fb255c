#include "inslab/referee/calibrate/alignment_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/geodesy.hpp"

namespace inslab::calibrate {
namespace {

constexpr std::size_t kBadLinesShown = 5;
constexpr std::size_t kPlottedBins = 2000;

double deg_per_h(double rad_per_s) { return rad_per_s / units::kDegPerH; }
double in_circle_deg(double yaw_rad) {
  const double deg = yaw_rad * units::kDegPerRad;
  return deg - 360.0 * std::floor(deg / 360.0);
}

std::string spread_line(const std::string& name, const Spread& spread) {
  if (spread.count < 2) return fmt::format("{:<12} {:>9}  too few solutions for a spread\n", name, spread.count);
  const nav::Vector3 mean = spread.mean_rad * units::kDegPerRad, sigma = spread.sigma_rad * units::kDegPerRad;
  return fmt::format("{:<12} {:>9}  {:>10.4f} {:>10.4f} {:>10.4f}  {:>9.4f} {:>9.4f} {:>9.4f}\n", name, spread.count,
                     mean.x(), mean.y(), in_circle_deg(spread.mean_rad.z()), sigma.x(), sigma.y(), sigma.z());
}

std::string yaw_text(const YawUncertainty& yaw) {
  const std::string shown = fmt::format("{:.3g} deg/h, as the rate's length and its part along gravity show",
                                        deg_per_h(yaw.shown_bias_rad_per_s));
  return fmt::format(
      "Yaw's standard deviation: {:.3g} deg, of a gyro bias of {} and noise of {:.2g} deg/h over the Earth's {:.2f} "
      "deg/h along north.\n",
      yaw.sigma_rad * units::kDegPerRad,
      yaw.bias_is_given ? fmt::format("{:.3g} deg/h as given ({})", deg_per_h(yaw.bias_rad_per_s), shown) : shown,
      deg_per_h(yaw.noise_rad_per_s), deg_per_h(yaw.horizontal_rad_per_s));
}

std::string tilt_text(const AlignmentResult& result) {
  if (!result.tilt) return "Tilt's trend: not looked for in less than 10 s.\n";
  const double sigma = deg_per_h(result.tilt->sigma_rad_per_s);
  const std::string rates =
      fmt::format("Tilt's trend: {:+.3f} deg/h about north, {:+.3f} about east, standard deviation {:.2g}",
                  deg_per_h(result.tilt_rate_n.x()), deg_per_h(result.tilt_rate_n.y()), sigma);
  if (!result.tilt->shows()) return rates + ": none that shows.\n";
  return rates +
         fmt::format(": taken out; left in, yaw would be {:.4f} deg.\n", in_circle_deg(result.yaw_with_tilt_rad));
}

std::string needed_text(double latitude_deg, double yaw_deg) {
  const double bias_rad_per_s = bias_for_yaw_rad_per_s(yaw_deg * units::kDeg, latitude_deg * units::kDeg);
  return fmt::format("{:g} deg of yaw needs gyros of {:.2g} deg/h: {}", yaw_deg, deg_per_h(bias_rad_per_s),
                     grade_for_bias(bias_rad_per_s));
}

}  // namespace

std::string report_text(const AlignedRecording& aligned, double latitude_deg, double wanted_yaw_deg) {
  const AlignmentResult& result = aligned.alignment;
  std::string text =
      fmt::format("{} samples of {:.6f} s\n\n{:<12} {:>9}  {:>10} {:>10} {:>10}  {:>29}\n", result.samples,
                  aligned.dt_s, "deg", "solutions", "roll", "pitch", "yaw", "standard deviations");
  text += spread_line("per sample", result.epochs) + spread_line("per second", result.seconds);
  if (result.whole) {
    text += fmt::format("{:<12} {:>9}  {:>10.4f} {:>10.4f} {:>10.4f}\n", "whole span", 1,
                        result.whole->roll_rad * units::kDegPerRad, result.whole->pitch_rad * units::kDegPerRad,
                        result.whole->yaw_rad * units::kDegPerRad);
  }
  text += "\nYaw from north towards east, in [0, 360).\n";
  if (result.yaw) text += yaw_text(*result.yaw) + tilt_text(result) + needed_text(latitude_deg, wanted_yaw_deg) + ".\n";
  return text;
}

std::string warning_text(const AlignedRecording& aligned, double latitude_deg) {
  const std::optional<YawUncertainty>& yaw = aligned.alignment.yaw;
  if (!yaw || yaw->sigma_rad * units::kDegPerRad <= kYawWarningDeg) return "";
  return fmt::format("yaw is not known: its standard deviation is {:.3g} deg; {}\n", yaw->sigma_rad * units::kDegPerRad,
                     needed_text(latitude_deg, kYawWarningDeg));
}

std::string bad_lines_text(const AlignedRecording& aligned) {
  std::string text;
  for (std::size_t i = 0; i < std::min(kBadLinesShown, aligned.bad_lines.size()); ++i) {
    text += fmt::format("line {} left out: {}\n", aligned.bad_lines[i].line, aligned.bad_lines[i].reason);
  }
  if (aligned.bad_line_count > kBadLinesShown) text += fmt::format("{} bad lines in all\n", aligned.bad_line_count);
  return text;
}

tables::Picture seconds_picture(const AlignmentResult& result, const std::string& title) {
  tables::Picture picture;
  picture.title = title + ": each second's angles from the mean of the seconds";
  const std::array<const char*, 3> names{"roll", "pitch", "yaw"};
  for (int i = 0; i < 3; ++i) {
    tables::Curve curve;
    for (std::size_t k = 0; k < result.each_second.size(); ++k) {
      const nav::RollPitchYaw& rpy = result.each_second[k];
      const nav::Vector3 angles(rpy.roll_rad, rpy.pitch_rad, rpy.yaw_rad);
      curve.x.push_back(static_cast<double>(k + 1));
      curve.y.push_back(nav::wrapped_to_pi(angles[i] - result.seconds.mean_rad[i]) * units::kDegPerRad);
    }
    tables::Panel panel;
    panel.x_label = i == 2 ? "time (s)" : "";
    panel.y_label = fmt::format("{} (deg)", names[static_cast<std::size_t>(i)]);
    panel.tight_x = true;
    panel.curves = {tables::thinned(curve, kPlottedBins)};
    picture.panels.push_back(panel);
  }
  picture.panel_width_px = 800;
  picture.panel_height_px = 220;
  return picture;
}

}  // namespace inslab::calibrate
