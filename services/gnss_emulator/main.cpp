#include "inslab/scenario/service_names.hpp"
#include "inslab/services/gnss_emulator/emulator_on_bus.hpp"

int main(int argc, char** argv) {
  using namespace inslab;
  return app::run_service(app::kGnssEmulator, "Turns the truth into what one GNSS receiver reports", {true, false},
                          argc, argv, [](app::Context& context) {
                            const std::uint32_t sensor = context.options().sensor;
                            gnss::EmulatorOnBus bus(context, context.scenario().gnss_number(sensor));
                            return app::TruthFollower(context, sensor, bus).run();
                          });
}
