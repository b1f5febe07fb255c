#include <CLI/CLI.hpp>

#include "inslab/foundation/files/output_place.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::cli {

void add_overwrite(CLI::App& command) {
  command.add_flag_callback(
      "--overwrite", [] { io::set_output_rule(io::OutputRule::ReplaceResults); },
      "replace results that are there already; an input never is");
}

}  // namespace inslab::cli
