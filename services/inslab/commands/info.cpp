#include <CLI/CLI.hpp>
#include <memory>

#include "inslab/formats/log/log_info_text.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::commands {
namespace {

int run_info(const std::string& path) {
  try {
    terminal::tell("{}", log::text_of(log::inspect_log(path)));
    return host::kOk;
  } catch (const files::ReadError& error) {
    terminal::tell(stderr, "inslab info: {}\n", error.what());
    return host::kBadInput;
  }
}

}  // namespace

void add_info(CLI::App& app, std::function<int()>& action) {
  CLI::App* command = app.add_subcommand("info", "What a log holds: topics, types, counts, rates, gaps");
  const auto path = std::make_shared<std::string>();
  command->add_option("log", *path, "an MCAP log of Inslab")->required();
  command->callback([&action, path] { action = [path] { return run_info(*path); }; });
}

}  // namespace inslab::commands
