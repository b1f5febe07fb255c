#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::commands {

namespace {

/// Becomes inslab-study, which lies beside this program. Returns only by throwing: std::runtime_error.
int become_study(const char* command, const std::vector<std::string>& arguments) {
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
  const std::string program = self.parent_path() / "inslab-study";
  std::vector<const char*> argv{program.c_str(), command};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  argv.push_back(nullptr);
  execv(program.c_str(), const_cast<char* const*>(argv.data()));
  throw std::runtime_error(program + ": " + std::strerror(errno) + "; `inslab " + command +
                           "` needs it: deploy/install_packages build build-tests && cmake --build --preset release "
                           "--target inslab-study");
}

}  // namespace

void add_commands(CLI::App& app, std::function<int()>& action) {
  add_run(app, action);
  add_summary(app, action);
  add_follow(app, action);
  add_judge(app, action);
  add_report(app, action);
  add_status(app, action);
  add_swap(app, action);
  add_schedule(app, action);
  add_control(app, action);
  add_topics(app, action);
  add_doctor(app, action);
  add_check(app, action);
  add_info(app, action);
  add_export(app, action);
  add_trajectory(app, action);
  for (const StudyCommand& study : kStudyCommands) {
    CLI::App* command = app.add_subcommand(study.name, study.purpose);
    command->prefix_command();
    command->set_help_flag();  // its options, --help too, are for the other program to read
    command->callback([command, name = study.name, &action] {
      action = [command, name] { return become_study(name, command->remaining()); };
    });
  }
}

}  // namespace inslab::commands
