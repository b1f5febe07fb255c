#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <memory>

#include "inslab/foundation/files/output_file.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/one_of.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/referee/calibrate/fitted_profile.hpp"
#include "inslab/referee/calibrate/profile_file.hpp"
#include "inslab/referee/calibrate/report.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::commands {
namespace {

const std::map<std::string, allan::Term>& term_names() {
  static const std::map<std::string, allan::Term> names{{"white", allan::Term::White},
                                                        {"quantization", allan::Term::Quantization},
                                                        {"flicker", allan::Term::Flicker},
                                                        {"random-walk", allan::Term::RandomWalk},
                                                        {"gauss-markov", allan::Term::GaussMarkov}};
  return names;
}

struct AllanOptions {
  std::string file;
  calibrate::AnalysisOptions analysis;
  std::vector<std::string> terms;
  std::string directory;
  std::string profile;
  bool accept_poor_fit = false;
};

/// Where the curves go, without the ending: STEM_allan in the folder asked for, or beside the recording.
std::string curves_stem(const AllanOptions& options) {
  const std::filesystem::path input(options.file);
  const std::filesystem::path directory =
      options.directory.empty() ? input.parent_path() : std::filesystem::path(options.directory);
  if (!directory.empty()) std::filesystem::create_directories(directory);
  return (directory / (input.stem().string() + "_allan")).string();
}

int run_allan(AllanOptions& options) {
  for (const std::string& term : options.terms) options.analysis.terms.push_back(term_names().at(term));
  const calibrate::ImuAnalysis analysis = calibrate::analyse_imu(options.file, options.analysis);
  terminal::tell("{}\n", calibrate::report_text(analysis));
  const std::string stem = curves_stem(options);
  files::write_file(stem + ".csv", calibrate::curve_csv(analysis));
  terminal::tell("{}.csv written\n", stem);
  const std::string poor = options.profile.empty() || options.accept_poor_fit ? "" : calibrate::poor_fits(analysis);
  if (!options.profile.empty() && poor.empty()) {
    calibrate::write_profile(options.profile, calibrate::fitted_profile(analysis));
    terminal::tell("profile {} written\n", options.profile);
  }
  files::write_file(stem + ".png", tables::drawn(calibrate::curve_picture(analysis), tables::PictureFormat::Png));
  terminal::tell("{}.png written\n", stem);
  if (poor.empty()) return host::kOk;
  spdlog::error("{}: not written (--accept-poor-fit writes it nevertheless): {}", options.profile, poor);
  return host::kFailed;
}

}  // namespace

void add_allan(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<AllanOptions>();
  CLI::App* command = app.add_subcommand(kAllan.name, kAllan.purpose);
  command->add_option("file", options->file, "a log of ours, a text of 7 columns, or a CSV with names (docs/allan.md)")
      ->required();
  command->add_option("--sensor", options->analysis.recording.sensor_number, "of a log: the IMU's number")
      ->capture_default_str();
  command->add_flag("--minus-truth", options->analysis.recording.minus_truth,
                    "of a log: take the perfect IMU off, so that the vehicle may move");
  command->add_flag("--over-gaps", options->analysis.recording.over_gaps,
                    "where samples are missing, go on as though nothing were");
  std::vector<std::string> names;
  for (const auto& [name, term] : term_names()) names.push_back(name);
  command
      ->add_option("--term", options->terms, "fit just this term; may be repeated. None: those that the record needs")
      ->allow_extra_args(false)
      ->check(host::one_of(names));
  command
      ->add_option("--fit-from", options->analysis.finest_tau_s,
                   "smallest tau fitted, s: above what filters and vibration shape")
      ->check(CLI::NonNegativeNumber);
  command->add_option("-o,--output", options->directory,
                      "folder for FILE_allan.csv and .png; that of the file when not given");
  command->add_option("--profile", options->profile, "write the fit as an IMU error profile");
  command->add_flag("--accept-poor-fit", options->accept_poor_fit, "write it even where it departs from the curve");
  add_overwrite(*command);
  command->callback([options, &action] { action = [options] { return run_allan(*options); }; });
}

}  // namespace inslab::commands
