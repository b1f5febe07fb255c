#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>

#include "inslab/formats/tables/picture.hpp"
#include "inslab/foundation/files/output_file.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/one_of.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/geodesy.hpp"
#include "inslab/referee/calibrate/recording.hpp"
#include "inslab/referee/evidence/tell.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::cli {
namespace {

constexpr std::size_t kBadLinesShown = 5;
constexpr std::size_t kPlottedBins = 2000;

struct AlignOptions {
  std::string file;
  std::string axes = "rfu";
  std::string picture;
  std::uint32_t imu_type = 0;
  align::RecordingOptions recording;
};

std::string spread_line(const std::string& name, const align::Spread& spread) {
  if (spread.count < 2) return fmt::format("{:<12} {:>9}  too few solutions for a spread\n", name, spread.count);
  const nav::Vector3 mean = spread.mean_rad * units::kDegPerRad, sigma = spread.sigma_rad * units::kDegPerRad;
  return fmt::format("{:<12} {:>9}  {:>10.4f} {:>10.4f} {:>10.4f}  {:>9.4f} {:>9.4f} {:>9.4f}\n", name, spread.count,
                     mean.x(), mean.y(), mean.z() - 360.0 * std::floor(mean.z() / 360.0), sigma.x(), sigma.y(),
                     sigma.z());
}

std::string report(const align::AlignedRecording& aligned) {
  const align::AlignmentResult& result = aligned.alignment;
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
  return text;
}

void show_bad_lines(const align::AlignedRecording& aligned) {
  for (std::size_t i = 0; i < std::min(kBadLinesShown, aligned.bad_lines.size()); ++i) {
    tell(stderr, "line {} left out: {}\n", aligned.bad_lines[i].line, aligned.bad_lines[i].reason);
  }
  if (aligned.bad_line_count > kBadLinesShown) tell(stderr, "{} bad lines in all\n", aligned.bad_line_count);
}

/// Each second's departure from the mean of the seconds.
io::Picture picture_of(const align::AlignmentResult& result, const std::string& title) {
  io::Picture picture;
  picture.title = title + ": each second's angles from the mean of the seconds";
  const std::array<const char*, 3> names{"roll", "pitch", "yaw"};
  for (int i = 0; i < 3; ++i) {
    io::Curve curve;
    for (std::size_t k = 0; k < result.each_second.size(); ++k) {
      const nav::RollPitchYaw& rpy = result.each_second[k];
      const nav::Vector3 angles(rpy.roll_rad, rpy.pitch_rad, rpy.yaw_rad);
      curve.x.push_back(static_cast<double>(k + 1));
      curve.y.push_back(nav::wrapped_to_pi(angles[i] - result.seconds.mean_rad[i]) * units::kDegPerRad);
    }
    io::Panel panel;
    panel.x_label = i == 2 ? "time (s)" : "";
    panel.y_label = fmt::format("{} (deg)", names[static_cast<std::size_t>(i)]);
    panel.tight_x = true;
    panel.curves = {io::thinned(curve, kPlottedBins)};
    picture.panels.push_back(panel);
  }
  picture.panel_width_px = 800;
  picture.panel_height_px = 220;
  return picture;
}

int run_align(AlignOptions& options) {
  if (options.axes == "frd") options.recording.novatel.axes = io::NovatelAxes::ForwardRightDown;
  if (options.imu_type != 0) options.recording.novatel.imu_type = options.imu_type;
  const align::AlignedRecording aligned = align::align_recording(options.file, options.recording);
  show_bad_lines(aligned);
  tell("{}", report(aligned));
  if (!options.picture.empty() && aligned.alignment.seconds.count >= 2) {
    const std::string bytes = io::drawn(
        picture_of(aligned.alignment, std::filesystem::path(options.file).filename().string()), io::PictureFormat::Svg);
    io::write_file(options.picture, bytes);
    tell("{} written\n", options.picture);
  }
  if (aligned.alignment.whole) return app::kOk;
  tell(stderr, "inslab: {}: no alignment: {}\n", options.file, aligned.alignment.refusal);
  return app::kBadInput;
}

}  // namespace

void add_align(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<AlignOptions>();
  CLI::App* command = app.add_subcommand(kAlign.name, kAlign.purpose);
  command
      ->add_option("file", options->file,
                   "a NovAtel ASCII log (RAWIMU...), a log of ours, a text of 7 columns, or a CSV with names")
      ->required();
  command->add_option("--latitude", options->recording.latitude_deg, "of the site, deg")
      ->required()
      ->check(CLI::Range(-90.0, 90.0));
  command->add_option("--height", options->recording.height_m, "of the site, m: for gravity")
      ->check(CLI::Range(nav::kMinHeightM, nav::kMaxHeightM));
  command->add_option("--imu-type", options->imu_type, "of a NovAtel log that does not say it (RAWIMUA, RAWIMUSA)");
  command->add_option("--axes", options->axes, "of a NovAtel log: right-forward-up or forward-right-down")
      ->check(app::one_of({"rfu", "frd"}))
      ->capture_default_str();
  command->add_option("--sensor", options->recording.sensor_number, "of a log of ours: the IMU's number")
      ->capture_default_str();
  nav::AlignmentLimits& limits = options->recording.limits;
  command->add_option("--pole-distance", limits.pole_distance_deg, "refuse nearer to a pole than this, deg")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--rate-ratio", limits.rate_ratio, "refuse a mean rate off the Earth's by this part of it")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      ->add_option("--force-spread", limits.force_spread_m_per_s2, "refuse a specific force that spreads more, m/s^2")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--plot", options->picture, "write the solutions of the seconds as a picture (SVG)");
  add_overwrite(*command);
  command->callback([options, &action] { action = [options] { return run_align(*options); }; });
}

}  // namespace inslab::cli
