#pragma once

#include <optional>
#include <string>

#include "inslab/foundation/fields/field.hpp"
#include "inslab/foundation/fields/violation.hpp"

namespace inslab::scenario {

/// How the truth follows a vehicle that is simulated elsewhere and sends inslab/vehicle_state.
struct LiveVehicle {
  double nominal_rate_hz = 100.0;
  double latency_ms = 20.0;
  double extrapolation_limit_ms = 500.0;
  double return_time_ms = 500.0;
  double jump_limit_m = 10.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("nominal_rate_hz", "how often the simulator sends; what is missing is counted by it")
              .in(10.0, 1000.0)
              .required(),
          self.nominal_rate_hz);
    visit(Field("latency_ms",
                "the truth is the vehicle's state of so long ago: at least a period of the states, and as "
                "much more as they may be late")
              .in(0.0, 1000.0)
              .required(),
          self.latency_ms);
    visit(Field("extrapolation_limit_ms", "no new state for longer than this ends the run as a fault").in(1.0, 1e4),
          self.extrapolation_limit_ms);
    visit(
        Field("return_time_ms", "in which the truth is led back to the states after an extrapolation, 99 % of the way")
            .in(100.0, 1e4),
        self.return_time_ms);
    visit(Field("jump_limit_m", "a state further than this from where the last one's velocity leads is refused")
              .in(1e-3, 1e5),
          self.jump_limit_m);
  }
};

/// The first rule broken, or nothing.
inline std::optional<Violation> violation(const LiveVehicle& vehicle) {
  if (vehicle.latency_ms * vehicle.nominal_rate_hz >= 1000.0 * (1.0 - 1e-9)) return std::nullopt;
  return Violation{Rule::VehicleLatency, "latency_ms",
                   "is shorter than one period of the states at nominal_rate_hz, so the truth would always be "
                   "extrapolated"};
}

}  // namespace inslab::scenario
