#include "inslab/scenario/service_names.hpp"
#include "inslab/services/imu_error_injector/injector_on_bus.hpp"

int main(int argc, char** argv) {
  using namespace inslab;
  return app::run_service(app::kImuInjector, "Turns the truth into what one IMU puts out", {true, false}, argc, argv,
                          [](app::Context& context) {
                            const std::uint32_t sensor = context.options().sensor;
                            imu::InjectorOnBus bus(context, context.scenario().imu_number(sensor));
                            return app::TruthFollower(context, sensor, bus).run();
                          });
}
