#include <spdlog/spdlog.h>

#include <filesystem>

#include "inslab/formats/mcap/mcap_reader.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/output_place.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/scenario/service_names.hpp"
#include "inslab/services/truth_logger/logger_on_bus.hpp"

namespace {

using namespace inslab;

bool is_whole(const std::string& log) {
  try {
    return mcap::McapReader(log).closed_properly();
  } catch (const files::ReadError&) {
    return false;
  }
}

std::string log_path(const service::Context& context) {
  if (!context.options().log_file.empty()) return context.options().log_file;
  const std::string& unit = context.options().network.unit;
  return files::fresh_file("runs/" + context.scenario().scenario.name + (unit.empty() ? "" : "-" + unit) + "-" +
                               host::utc_text(host::realtime_now()),
                           ".mcap");
}

int write_log(service::Context& context) {
  files::set_output_rule(context.options().overwrites ? files::OutputRule::ReplaceResults
                                                      : files::OutputRule::KeepResults);
  const std::filesystem::path path = log_path(context);
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
  if (!context.options().go_on.empty() && is_whole(path.string())) {
    spdlog::info("{} is whole: the logger before this one had closed it", path.string());
    return host::kOk;
  }
  return truth_logger::LoggerOnBus(context, path.string()).run();
}

}  // namespace

int main(int argc, char** argv) {
  return service::run_service(catalog::kTruthLogger, "Writes everything it hears to an MCAP log", {false, true}, argc,
                              argv, write_log);
}
