#pragma once

#include <functional>

namespace CLI {
class App;
}

/// The subcommands of `inslab`. Each function declares its options on `app`; when the command line chose it, `action`
/// does the work and returns the exit code (app/exit_code.hpp).
namespace inslab::cli {

void add_run(CLI::App& app, std::function<int()>& action);
void add_summary(CLI::App& app, std::function<int()>& action);
void add_report(CLI::App& app, std::function<int()>& action);
void add_soak(CLI::App& app, std::function<int()>& action);
void add_simulate(CLI::App& app, std::function<int()>& action);
void add_status(CLI::App& app, std::function<int()>& action);
void add_control(CLI::App& app, std::function<int()>& action);
void add_swap(CLI::App& app, std::function<int()>& action);
void add_topics(CLI::App& app, std::function<int()>& action);
void add_doctor(CLI::App& app, std::function<int()>& action);
void add_schedule(CLI::App& app, std::function<int()>& action);
void add_check(CLI::App& app, std::function<int()>& action);
void add_info(CLI::App& app, std::function<int()>& action);
void add_export(CLI::App& app, std::function<int()>& action);
void add_trajectory(CLI::App& app, std::function<int()>& action);
void add_plot(CLI::App& app, std::function<int()>& action);
void add_reference(CLI::App& app, std::function<int()>& action);
void add_navigate(CLI::App& app, std::function<int()>& action);
void add_montecarlo(CLI::App& app, std::function<int()>& action);
void add_align(CLI::App& app, std::function<int()>& action);
void add_allan(CLI::App& app, std::function<int()>& action);
void add_predict(CLI::App& app, std::function<int()>& action);
void add_profile(CLI::App& app, std::function<int()>& action);
void add_verify(CLI::App& app, std::function<int()>& action);

/// The option --overwrite of a command that writes files: without it no file that is there already is replaced.
void add_overwrite(CLI::App& command);

}  // namespace inslab::cli
