#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace inslab::commands {

/// "profile import": what the command line chose.
std::string command_words(const CLI::App& app);

/// Says what is wrong with a command line, and which command or option was most likely meant, or prints the help that
/// was asked for; returns the exit code.
int answer(const CLI::App& app, const CLI::ParseError& error);

}  // namespace inslab::commands
