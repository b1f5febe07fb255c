#include <filesystem>

#include "app/host.hpp"
#include "app/service_names.hpp"
#include "services/truth_logger/logger_on_bus.hpp"

int main(int argc, char** argv) {
  using namespace inslab;
  return app::run_service(app::kTruthLogger, "Writes everything it hears to an MCAP log", {false, true}, argc, argv,
                          [](app::Context& context) {
                            std::filesystem::path path = context.options().log_file;
                            if (path.empty()) {
                              path = std::filesystem::path("runs") / (context.scenario().scenario.name + "-" +
                                                                      app::utc_text(app::realtime_now()) + ".mcap");
                            }
                            if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
                            return logger::LoggerOnBus(context, path.string()).run();
                          });
}
