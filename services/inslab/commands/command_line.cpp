#include "inslab/services/inslab/commands/command_line.hpp"

#include <CLI/CLI.hpp>
#include <iostream>
#include <vector>

#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/text/nearest.hpp"
#include "inslab/foundation/text/shown.hpp"

namespace inslab::commands {

namespace {

/// The innermost command that was chosen; the program itself when none was.
const CLI::App& innermost(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? app : innermost(*chosen.back());
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// What is wrong with a word that nothing takes; empty when the error is another one.
std::string unknown_word(const CLI::App& app) {
  const std::vector<std::string> left = app.remaining(true);
  if (left.empty()) return "";
  const CLI::App& command = innermost(app);
  const std::string& word = left.front();
  const std::string name = &command == &app ? "inslab" : "inslab " + command_words(app);
  if (word.substr(0, 1) == "-") {
    const std::string option = word.substr(0, word.find('='));
    return name + " has no option " + text::quoted(option) + text::did_you_mean(option, option_names(command));
  }
  const std::vector<std::string> commands = command_names(command);
  if (commands.empty()) return name + " takes no further argument; given is " + text::quoted(word);
  return name + " has no command " + text::quoted(word) + text::did_you_mean(word, commands);
}

}  // namespace

std::string command_words(const CLI::App& app) {
  std::string words;
  for (const CLI::App* command : app.get_subcommands()) {
    const std::string more = command_words(*command);
    words += (words.empty() ? "" : " ") + command->get_name() + (more.empty() ? "" : " " + more);
  }
  return words;
}

int answer(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
  const std::string chosen = command_words(app);
  const std::string unknown = unknown_word(app);
  std::cerr << "inslab: " << text::shown(unknown.empty() ? error.what() : unknown) << "\n"
            << "inslab " << chosen << (chosen.empty() ? "" : " ") << "--help says what there is\n";
  return host::kBadInput;
}

}  // namespace inslab::commands
