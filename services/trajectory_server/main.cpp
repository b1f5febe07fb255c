#include "inslab/scenario/service_names.hpp"
#include "inslab/services/trajectory_server/server_on_bus.hpp"

int main(int argc, char** argv) {
  using namespace inslab;
  return service::run_service(catalog::kTrajectoryServer,
                              "Sends the vehicle's true motion and keeps the run's clock and journal",
                              {false, false, true}, argc, argv,
                              [](service::Context& context) { return trajectory_server::ServerOnBus(context).run(); });
}
