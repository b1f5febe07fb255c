#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>

#include "app/exit_code.hpp"
#include "services/inslab/commands.hpp"
#include "services/inslab/verify/allan.hpp"
#include "services/inslab/verify/gnss.hpp"
#include "services/inslab/verify/increments.hpp"
#include "services/inslab/verify/trajectory.hpp"

namespace inslab::cli {

namespace {

/// One block of the verification: its name on the command line, what it shows, and the work. `full` asks for all seeds.
struct Verification {
  const char* name;
  const char* purpose;
  std::vector<verify::Table> (*run)(bool full);
};

void say(const std::string& what) { spdlog::info(what); }

const std::vector<Verification>& verifications() {
  static const std::vector<Verification> list{
      {"trajectory", "Truth of motion tables against an independent solution (thesis table 4-1)",
       verify::verify_trajectory},
      {"allan", "Random errors of the IMU by Allan variance (thesis tables 4-4 to 4-7)",
       [](bool full) { return verify::allan_tables(full, say); }},
      {"increments", "Order of the error of mechanized increments, and of rate times interval",
       [](bool) { return verify::increments(60.0); }},
      {"gnss", "Errors of the receivers and the lever arm of their antenna (thesis tables 4-8, 4-9)", verify::gnss},
  };
  return list;
}

int verify_one(const Verification& verification, bool full) {
  bool held = true;
  for (const verify::Table& table : verification.run(full)) {
    fmt::print("{}\n", verify::to_text(table));
    held = held && table.held();
  }
  fmt::print("{}: {}\n", verification.name, held ? "every row held" : "NOT every row held");
  return held ? app::kOk : app::kFailed;
}

}  // namespace

void add_verify(CLI::App& app, std::function<int()>& action) {
  CLI::App* verify = app.add_subcommand("verify", "Show the product's figures beside the published ones");
  verify->require_subcommand(1);
  for (const Verification& verification : verifications()) {
    CLI::App* command = verify->add_subcommand(verification.name, verification.purpose);
    auto full = std::make_shared<bool>(false);
    command->add_flag("--full", *full, "all seeds instead of the preset one");
    command->callback(
        [&action, &verification, full] { action = [&verification, full] { return verify_one(verification, *full); }; });
  }
}

}  // namespace inslab::cli
