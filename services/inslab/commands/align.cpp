#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "inslab/foundation/files/output_file.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/one_of.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/nav/geodesy.hpp"
#include "inslab/referee/calibrate/alignment_report.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::commands {
namespace {

struct AlignOptions {
  std::string file;
  std::string axes = "rfu";
  std::string picture;
  std::uint32_t imu_type = 0;
  calibrate::RecordingOptions recording;
  double wanted_yaw_deg = 1.0;
};

int run_align(AlignOptions& options) {
  if (options.axes == "frd") options.recording.novatel.axes = novatel::NovatelAxes::ForwardRightDown;
  if (options.imu_type != 0) options.recording.novatel.imu_type = options.imu_type;
  const calibrate::AlignedRecording aligned = calibrate::align_recording(options.file, options.recording);
  terminal::tell(stderr, "{}", calibrate::bad_lines_text(aligned));
  const double latitude_deg = options.recording.latitude_deg;
  terminal::tell("{}", calibrate::report_text(aligned, latitude_deg, options.wanted_yaw_deg));
  if (const std::string warning = calibrate::warning_text(aligned, latitude_deg); !warning.empty()) {
    terminal::tell(stderr, "inslab: {}: {}", options.file, warning);
  }
  if (!options.picture.empty() && aligned.alignment.seconds.count >= 2) {
    const std::string bytes = tables::drawn(
        calibrate::seconds_picture(aligned.alignment, std::filesystem::path(options.file).filename().string()),
        tables::PictureFormat::Svg);
    files::write_file(options.picture, bytes);
    terminal::tell("{} written\n", options.picture);
  }
  if (aligned.alignment.whole) return host::kOk;
  terminal::tell(stderr, "inslab: {}: no alignment: {}\n", options.file, aligned.alignment.refusal);
  return host::kBadInput;
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
      ->check(host::one_of({"rfu", "frd"}))
      ->capture_default_str();
  command->add_option("--sensor", options->recording.sensor_number, "of a log of ours: the IMU's number")
      ->capture_default_str();
  command
      ->add_option("--gyro-bias", options->recording.gyro_bias_deg_per_h,
                   "standard deviation of the gyros' bias, deg/h; otherwise what the recording shows")
      ->check(CLI::PositiveNumber);
  command->add_option("--wanted-yaw", options->wanted_yaw_deg, "say which gyros this standard deviation needs, deg")
      ->check(CLI::PositiveNumber)
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

}  // namespace inslab::commands
