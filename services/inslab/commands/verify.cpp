#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "inslab/foundation/files/output_file.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/services/inslab/commands/commands.hpp"
#include "inslab/services/inslab/study/verifications.hpp"

namespace inslab::commands {

namespace {

int verify_one(const study::Verification& verification, const study::VerifyRequest& request) {
  bool held = true;
  std::size_t misses = 0, rows = 0;
  std::vector<std::string> left_out;
  for (const verify::Table& table : study::tables_of(verification, request)) {
    terminal::tell("{}\n", verify::to_text(table));
    held = held && table.held();
    misses += table.misses();
    rows += table.rows.size();
    left_out.insert(left_out.end(), table.left_out.begin(), table.left_out.end());
  }
  if (!request.picture.empty()) {
    const std::string bytes = tables::drawn(verification.picture(), tables::PictureFormat::Svg);
    files::write_file(request.picture, bytes);
  }
  std::string verdict = !held ? "NOT every row held" : rows > 0 ? "every row held" : "no row was judged";
  if (misses > 0) verdict += fmt::format(", but for {} known to miss (docs/verification.md)", misses);
  if (!left_out.empty()) verdict += fmt::format("; left out for lack of data: {}", fmt::join(left_out, ", "));
  terminal::tell("{}: {}\n", verification.name, verdict);
  return held ? host::kOk : host::kFailed;
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
  for (const study::Verification& verification : study::verifications()) {
    CLI::App* command = verify->add_subcommand(verification.name, verification.purpose);
    auto request = std::make_shared<study::VerifyRequest>();
    command->add_flag("--full", request->full, "all seeds instead of the preset one");
    if (verification.files != nullptr) {
      command->add_option("--files", request->files, verification.files);
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

}  // namespace inslab::commands
