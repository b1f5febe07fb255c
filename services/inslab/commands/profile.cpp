#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>

#include "inslab/formats/profile_import/conversion.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/one_of.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/foundation/text/shown.hpp"
#include "inslab/referee/calibrate/profile_file.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::commands {
namespace {

using Importer = profile_import::ImportedProfile (*)(const std::string&, const profile_import::ImportOptions&);

const std::map<std::string, Importer>& importers() {
  static const std::map<std::string, Importer> list{{"kf-gins", profile_import::import_kf_gins},
                                                    {"gnss-ins-sim", profile_import::import_gnss_ins_sim},
                                                    {"gazebo", profile_import::import_gazebo}};
  return list;
}

struct ProfileOptions {
  std::string from;
  std::string file;
  std::string output;
  std::string name;
  profile_import::ImportOptions import;
};

int run_import(const ProfileOptions& options) {
  profile_import::ImportedProfile imported = importers().at(options.from)(options.file, options.import);
  const std::string stem = std::filesystem::path(options.file).stem().string();
  imported.profile.name = text::cut(text::shown(options.name.empty() ? stem : options.name), 64);
  // Without a file the profile itself goes to standard output, and what is for people beside it.
  std::FILE* const people = options.output.empty() ? stderr : stdout;
  for (const std::string& line : imported.lines) terminal::tell(people, "{}\n", line);
  if (options.output.empty()) {
    terminal::tell("{}", calibrate::profile_text(imported.profile));
  } else {
    calibrate::write_profile(options.output, imported.profile);
    terminal::tell("profile {} written\n", options.output);
  }
  return host::kOk;
}

}  // namespace

void add_profile(CLI::App& app, std::function<int()>& action) {
  CLI::App* profile = app.add_subcommand(kProfile.name, kProfile.purpose);
  profile->require_subcommand(1);
  auto options = std::make_shared<ProfileOptions>();
  CLI::App* command = profile->add_subcommand("import", "An IMU error profile from another program's file");
  std::vector<std::string> names;
  for (const auto& [name, importer] : importers()) names.push_back(name);
  command->add_option("file", options->file, "the file")->required();
  command->add_option("--from", options->from, "whose file it is")->required()->check(host::one_of(names));
  command->add_option("-o,--output", options->output, "profile (JSON); standard output when not given");
  command->add_option("--name", options->name, "the profile's name; that of the file when not given");
  command->add_option("--rate", options->import.rate_hz, "Hz, at which the other program runs its IMU")
      ->check(CLI::PositiveNumber);
  command->add_option("--sensor", options->import.sensor, "gazebo: the name of the IMU, where there are several");
  add_overwrite(*command);
  command->callback([options, &action] { action = [options] { return run_import(*options); }; });
}

}  // namespace inslab::commands
