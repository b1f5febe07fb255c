#include <CLI/CLI.hpp>
#include <memory>

#include "inslab/formats/recordings/fix_errors_text.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/one_of.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/referee/calibrate/profile_file.hpp"
#include "inslab/referee/graft/fix_errors.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::commands {
namespace {

struct FixOptions {
  graft::FixErrorOptions extract;
  std::string fix_type = "single";
  std::vector<double> lever_arm_m{0.0, 0.0, 0.0};
  std::string output;
  std::string profile;
};

int run_extract_gnss(FixOptions& options) {
  options.extract.fix_type = enum_named<FixType>(options.fix_type).value();
  options.extract.lever_arm_v_m = nav::Vector3::Map(options.lever_arm_m.data());
  const graft::FixErrors extracted = graft::extract_fix_errors(options.extract);
  terminal::tell("{}", extracted.text);
  recordings::write_fix_errors(options.output, extracted.errors);
  terminal::tell("{} written\n", options.output);
  if (options.profile.empty()) return host::kOk;
  calibrate::write_profile(options.profile, graft::fix_profile_of(options.output));
  terminal::tell("profile {} written; its recording goes into the scenario's folder of recordings\n", options.profile);
  return host::kOk;
}

}  // namespace

void add_graft_of_gnss(CLI::App& graft, std::function<int()>& action) {
  auto options = std::make_shared<FixOptions>();
  CLI::App* command = graft.add_subcommand("extract-gnss", "Take the errors out of the fixes of a receiver");
  command->add_option("file", options->extract.file, "a log of ours (.mcap), or positions in a text")->required();
  command->add_option("--reference", options->extract.reference, "where the vehicle was, with attitudes")->required();
  command->add_option("-o,--output", options->output, "the errors (.csv)")->required();
  command->add_option("--sensor", options->extract.sensor_number, "of a log: the receiver's number")
      ->capture_default_str();
  command->add_option("--columns", options->extract.columns, "of a text without names");
  command->add_option("--reference-columns", options->extract.reference_reading.columns,
                      "of a reference without names");
  command->add_option("--topic", options->extract.reference_reading.topic, "of a reference that is a log")
      ->capture_default_str();
  command->add_option("--fix-type", options->fix_type, "of a text, which does not say")
      ->check(host::one_of({"single", "differential", "float", "fixed"}))
      ->capture_default_str();
  command->add_option("--time-offset", options->extract.time_offset_s, "to begin with, s");
  command->add_option("--lever-arm", options->lever_arm_m, "to begin with, m, to the antenna")->expected(3);
  command->add_flag("--keep-geometry", options->extract.keep_geometry, "these two are known: do not fit them");
  command->add_option("--profile", options->profile, "write a GNSS error profile with them");
  add_overwrite(*command);
  command->callback([options, &action] { action = [options] { return run_extract_gnss(*options); }; });
}

}  // namespace inslab::commands
