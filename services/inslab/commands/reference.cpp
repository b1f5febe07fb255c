#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/one_of.hpp"
#include "inslab/services/inslab/commands/commands.hpp"
#include "inslab/services/inslab/derived/derived_files.hpp"

namespace inslab::commands {

void add_reference(CLI::App& app, std::function<int()>& action) {
  auto wanted = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(kReference.name, kReference.purpose);
  std::vector<std::string> names;
  for (const derived::DerivedFile& file : derived::derived_files()) names.push_back(file.path);
  command->add_option("file", *wanted, "which")->required()->check(host::one_of(names));
  command->callback([wanted, &action] {
    action = [wanted] {
      for (const derived::DerivedFile& file : derived::derived_files()) {
        if (file.path == *wanted) std::cout << file.text();
      }
      return host::kOk;
    };
  });
}

}  // namespace inslab::commands
