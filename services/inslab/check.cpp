#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/exit_code.hpp"
#include "scenario/load.hpp"
#include "services/inslab/commands.hpp"

namespace inslab::cli {

void add_check(CLI::App& app, std::function<int()>& action) {
  auto file = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("check", "Read a scenario and all it names; say what is wrong, or what is in it");
  command->add_option("scenario", *file, "scenario file (JSON)")->required();
  command->callback([file, &action] {
    action = [file] {
      const scenario::LoadedScenario loaded = scenario::load(*file);
      fmt::print("{}: good: {:.3f} s at {} Hz, {} segments, {} IMUs, {} GNSS receivers, {} swaps\n", *file,
                 loaded.scenario.duration_s, loaded.scenario.truth_rate_hz,
                 loaded.scenario.trajectory.segments.size(), loaded.imus.size(), loaded.gnss.size(),
                 loaded.swaps.size());
      return app::kOk;
    };
  });
}

}  // namespace inslab::cli
