#include <filesystem>

#include "app/host.hpp"
#include "app/service_names.hpp"
#include "io/output_place.hpp"
#include "services/truth_logger/logger_on_bus.hpp"

int main(int argc, char** argv) {
  using namespace inslab;
  return app::run_service(app::kTruthLogger, "Writes everything it hears to an MCAP log", {false, true}, argc, argv,
                          [](app::Context& context) {
                            io::set_output_rule(context.options().overwrites ? io::OutputRule::ReplaceResults
                                                                             : io::OutputRule::KeepResults);
                            std::filesystem::path path = context.options().log_file;
                            if (path.empty()) {
                              const std::string& unit = context.options().network.unit;
                              path = io::fresh_file("runs/" + context.scenario().scenario.name +
                                                        (unit.empty() ? "" : "-" + unit) + "-" +
                                                        app::utc_text(app::realtime_now()),
                                                    ".mcap");
                            }
                            if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
                            return logger::LoggerOnBus(context, path.string()).run();
                          });
}
