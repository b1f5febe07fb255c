#pragma once

#include <functional>

namespace CLI {
class App;
}

/// The subcommands of `inslab`. Each function declares its options on `app`; when the command line chose it, `action`
/// does the work and returns the exit code (0 done, 2 bad input).
namespace inslab::cli {

void add_info(CLI::App& app, std::function<int()>& action);
void add_export(CLI::App& app, std::function<int()>& action);

}  // namespace inslab::cli
