#include <CLI/CLI.hpp>

#include "inslab/foundation/files/output_place.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::commands {

void add_overwrite(CLI::App& command) {
  command.add_flag_callback(
      "--overwrite", [] { files::set_output_rule(files::OutputRule::ReplaceResults); },
      "replace results that are there already; an input never is");
}

}  // namespace inslab::commands
