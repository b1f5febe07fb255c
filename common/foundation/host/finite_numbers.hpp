#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <string>

namespace inslab::host {

/// Every number that `app` and its commands take must be a finite one from now on: CLI11 reads "nan", and its ranges
/// let it pass, since it is neither below nor above anything.
inline void expect_finite_numbers(CLI::App& app) {
  const CLI::Validator finite(
      [](std::string& given) {
        char* end = nullptr;
        const double value = std::strtod(given.c_str(), &end);
        const bool is_number = end != given.c_str() && *end == '\0';
        return is_number && !std::isfinite(value) ? "is " + given + "; expected a finite number" : std::string();
      },
      "");
  for (CLI::Option* option : app.get_options(std::function<bool(CLI::Option*)>())) {
    if (option->get_type_name().rfind("FLOAT", 0) == 0) option->check(finite);
  }
  for (CLI::App* command : app.get_subcommands(std::function<bool(CLI::App*)>())) expect_finite_numbers(*command);
}

}  // namespace inslab::host
