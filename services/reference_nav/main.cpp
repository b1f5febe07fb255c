#include "inslab/scenario/service_names.hpp"
#include "inslab/services/reference_nav/navigator_on_bus.hpp"

int main(int argc, char** argv) {
  using namespace inslab;
  return service::run_service(
      catalog::kReferenceNav, "Navigates by one IMU and one GNSS receiver", {false, false}, argc, argv,
      [](service::Context& context) {
        // Without the key: beside a run whose barrier does not wait for it.
        const auto& app = context.scenario().scenario.reference_nav;
        return reference_nav::NavigatorOnBus(context, app.value_or(scenario::ReferenceNav{})).run();
      });
}
