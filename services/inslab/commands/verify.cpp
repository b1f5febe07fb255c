#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>

#include "inslab/foundation/files/output_file.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/referee/verify/alignment.hpp"
#include "inslab/referee/verify/allan.hpp"
#include "inslab/referee/verify/closed_loop.hpp"
#include "inslab/referee/verify/gnss.hpp"
#include "inslab/referee/verify/increments.hpp"
#include "inslab/referee/verify/navigation.hpp"
#include "inslab/referee/verify/propagation.hpp"
#include "inslab/referee/verify/trajectory.hpp"
#include "inslab/referee/verify/vibration.hpp"
#include "inslab/services/inslab/commands/commands.hpp"
#include "inslab/services/inslab/commands/outages_over_dds.hpp"

namespace inslab::cli {

namespace {

struct Request {
  bool full = false;               ///< all seeds
  std::vector<std::string> files;  ///< the user's own, to be shown too
  verify::OutageTimes outages;     ///< of `navigation`
  bool over_dds = false;           ///< through the real processes, too
  app::NetworkOptions network;     ///< of these
  std::string picture;             ///< where the block's picture goes; empty: nowhere
};

/// One block of the verification: its name on the command line, what it shows, and the work.
struct Verification {
  const char* name;
  const char* purpose;
  std::vector<verify::Table> (*run)(const Request& request);
  bool takes_files = false;
  io::Picture (*picture)() = nullptr;
  verify::Table (*over_dds)(const app::NetworkOptions& network, const verify::OutageTimes& outages) = nullptr;
};

void say(const std::string& what) { spdlog::info(what); }

const std::vector<Verification>& verifications() {
  static const std::vector<Verification> list{
      {"trajectory", "Truth of motion tables against an independent solution (thesis table 4-1)",
       [](const Request& request) { return verify::verify_trajectory(request.full); }},
      {"closed-loop", "From a file through IMU and mechanization back to the file (thesis table 4-2)",
       [](const Request& request) { return verify::closed_loop(request.files); }, true},
      {"alignment", "Static coarse alignment with the lab's IMU, direct and from NovAtel lines (lab report)",
       [](const Request&) { return verify::alignment_tables(1); }},
      {"allan", "Random errors of the IMU by Allan variance (thesis tables 4-4 to 4-7)",
       [](const Request& request) { return verify::allan_tables(request.full, say); }},
      {"increments", "Order of the error of mechanized increments, and of rate times interval",
       [](const Request&) { return verify::increments(60.0); }},
      {"gnss", "Errors of the receivers and the lever arm of their antenna (thesis tables 4-8, 4-9)",
       [](const Request& request) { return verify::gnss(request.full); }},
      {"navigation", "Drift in GNSS outages and the filter's honesty (thesis tables 4-10 to 4-13)",
       [](const Request& request) { return verify::navigation(request.full, request.outages); }, false, nullptr,
       outages_over_dds},
      {"propagation", "How errors of inertial navigation grow, against closed forms and the linear model (lecture)",
       [](const Request& request) { return verify::propagation(request.full); }, false, verify::propagation_picture},
      {"vibration", "Increments, coning, sculling and spectra of vibration",
       [](const Request& request) { return verify::vibration_tables(request.full); }},
  };
  return list;
}

int verify_one(const Verification& verification, const Request& request) {
  bool held = true;
  std::vector<verify::Table> tables = verification.run(request);
  if (request.over_dds) tables.push_back(verification.over_dds(request.network, request.outages));
  for (const verify::Table& table : tables) {
    fmt::print("{}\n", verify::to_text(table));
    held = held && table.held();
  }
  if (!request.picture.empty()) {
    const std::string bytes = io::drawn(verification.picture(), io::PictureFormat::Svg);
    io::write_file(request.picture, bytes);
  }
  fmt::print("{}: {}\n", verification.name, held ? "every row held" : "NOT every row held");
  return held ? app::kOk : app::kFailed;
}

void add_outages(CLI::App& command, verify::OutageTimes& outages) {
  command.add_option("--outage", outages.length_s, "length of an outage, s")
      ->check(CLI::Range(1.0, 600.0))
      ->capture_default_str();
  command.add_option("--every", outages.spacing_s, "from the beginning of one outage to that of the next, s")
      ->check(CLI::Range(2.0, 1200.0))
      ->capture_default_str();
  command
      .add_option("--from", outages.first_s, "beginning of the first, s; the drive begins at 300 s and ends at 1200 s")
      ->check(CLI::Range(1.0, 1100.0))
      ->capture_default_str();
}

}  // namespace

void add_verify(CLI::App& app, std::function<int()>& action) {
  CLI::App* verify = app.add_subcommand(kVerify.name, kVerify.purpose);
  verify->require_subcommand(1);
  for (const Verification& verification : verifications()) {
    CLI::App* command = verify->add_subcommand(verification.name, verification.purpose);
    auto request = std::make_shared<Request>();
    command->add_flag("--full", request->full, "all seeds instead of the preset one");
    if (verification.takes_files) {
      command->add_option("--files", request->files, "trajectory files with velocity and attitude to show too");
    }
    if (verification.picture != nullptr) {
      command->add_option("--picture", request->picture, "write the curves there (SVG)");
      add_overwrite(*command);
    }
    if (verification.over_dds != nullptr) {
      command->add_flag("--dds", request->over_dds, "through the real processes in lockstep, too");
      request->network.add_to(*command);
      add_outages(*command, request->outages);
    }
    command->callback([&action, &verification, request] {
      action = [&verification, request] { return verify_one(verification, *request); };
    });
  }
}

}  // namespace inslab::cli
