#include <CLI/CLI.hpp>
#include <memory>

#include "inslab/formats/recordings/recorded_errors_file.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/usage_error.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/referee/calibrate/profile_file.hpp"
#include "inslab/referee/graft/extract.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::commands {
namespace {

struct GraftOptions {
  graft::ExtractOptions extract;
  std::optional<double> latitude_deg;
  double height_m = 0.0;
  bool no_north = false;
  std::vector<double> mounting_deg{0.0, 0.0, 0.0};
  std::vector<double> lever_arm_m{0.0, 0.0, 0.0};
  std::string output;
  std::string basic;
  std::string full;
};

void write_profile_of(const std::string& path, const GraftOptions& options,
                      const std::optional<graft::MotionTerms>& terms) {
  if (path.empty()) return;
  calibrate::write_profile(path, graft::profile_of(options.output, terms));
  terminal::tell("profile {} written; its recording goes into the scenario's folder of recordings\n", path);
}

int run_extract(GraftOptions& options) {
  const bool moved = !options.extract.reference.empty();
  if ((moved ? 1 : 0) + (options.latitude_deg ? 1 : 0) + (options.extract.recording.minus_truth ? 1 : 0) != 1) {
    throw host::UsageError("one of --latitude (it stood still), --reference (it moved) and --minus-truth is needed");
  }
  if (!options.full.empty() && !moved) throw host::UsageError("--full is of a recording in motion: --reference");
  if (options.latitude_deg) {
    options.extract.site =
        graft::StillSite{{*options.latitude_deg * units::kDeg, 0.0, options.height_m}, {}, !options.no_north};
  }
  options.extract.start.mounting_rpy_rad = nav::Vector3::Map(options.mounting_deg.data()) * units::kDeg;
  options.extract.start.lever_arm_v_m = nav::Vector3::Map(options.lever_arm_m.data());
  const graft::Extracted extracted = graft::extract(options.extract);
  terminal::tell("{}", extracted.text);
  recordings::write_recorded_errors(options.output, extracted.errors, extracted.notes);
  terminal::tell("{}", graft::recording_text(options.output));
  write_profile_of(options.basic, options, std::nullopt);
  write_profile_of(options.full, options, extracted.terms);
  return host::kOk;
}

void add_extract(CLI::App& graft, const std::shared_ptr<GraftOptions>& options, std::function<int()>& action) {
  CLI::App* command = graft.add_subcommand("extract", "Take the errors out of a recording of an IMU");
  command->add_option("file", options->extract.file, "a log of ours, a text of 7 columns, or a CSV with names")
      ->required();
  command->add_option("-o,--output", options->output, "the errors, a log (.mcap)")->required();
  auto& recording = options->extract.recording;
  command->add_option("--sensor", recording.sensor_number, "of a log: the IMU's number")->capture_default_str();
  command->add_flag("--minus-truth", recording.minus_truth, "of a log: take its perfect IMU off");
  command->add_option("--latitude", options->latitude_deg, "it stood still here, deg")->check(CLI::Range(-90.0, 90.0));
  command->add_option("--height", options->height_m, "of the site, m: for gravity")->capture_default_str();
  command->add_flag("--no-north", options->no_north, "its gyros do not feel the Earth turn: take yaw for 0");
  command->add_option("--reference", options->extract.reference, "it moved along this trajectory, with attitudes");
  command->add_option("--columns", options->extract.reference_reading.columns, "of a reference without names");
  command->add_option("--topic", options->extract.reference_reading.topic, "of a reference that is a log")
      ->capture_default_str();
  command->add_option("--time-offset", options->extract.start.time_offset_s, "to begin with, s");
  command->add_option("--mounting", options->mounting_deg, "to begin with: roll pitch yaw, deg")->expected(3);
  command->add_option("--lever-arm", options->lever_arm_m, "to begin with, m, from the reference's point")->expected(3);
  command->add_flag("--keep-geometry", options->extract.keep_geometry, "these three are known: do not fit them");
  command->add_option("--basic", options->basic, "write an IMU error profile with the signal alone");
  command->add_option("--full", options->full, "write one with the terms of the motion besides");
  add_overwrite(*command);
  command->callback([options, &action] { action = [options] { return run_extract(*options); }; });
}

}  // namespace

void add_graft(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<GraftOptions>();
  CLI::App* graft = app.add_subcommand(kGraft.name, kGraft.purpose);
  graft->require_subcommand(1);
  add_extract(*graft, options, action);
  add_graft_of_gnss(*graft, action);
  CLI::App* check = graft->add_subcommand("check", "Say what a file of recorded errors holds");
  check->add_option("file", options->output, "what extract wrote")->required();
  check->callback([options, &action] {
    action = [options] {
      terminal::tell("{}", graft::recording_text(options->output));
      return host::kOk;
    };
  });
}

}  // namespace inslab::commands
