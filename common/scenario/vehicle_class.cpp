#include "inslab/scenario/vehicle_class.hpp"

#include <cmath>
#include <sstream>

#include "inslab/foundation/units/units.hpp"

namespace inslab::scenario {

namespace {

constexpr double kG_m_per_s2 = 9.80665;
// Water at the crest of the highest wave, the corner of 120 deg of G. G. Stokes (Considerations relative to the
// greatest height of oscillatory irrotational waves, 1880), accelerates by g/2; a steeper wave breaks.
constexpr double kSteepestWave_m_per_s2 = 0.5 * kG_m_per_s2;

}  // namespace

std::optional<Violation> violation(const VehicleAttitude& attitude) {
  if (attitude.vehicle_class != VehicleClass::Ship) return std::nullopt;
  const double rate = 2.0 * units::kPi / attitude.heave_period_s;
  const double acceleration = attitude.heave_amplitude_m * rate * rate;
  if (acceleration <= kSteepestWave_m_per_s2) return std::nullopt;
  std::ostringstream why;
  why.precision(4);
  why << "means an acceleration of " << acceleration << " m/s^2 with heave_period_s " << attitude.heave_period_s
      << "; expected at most " << kSteepestWave_m_per_s2 << ", that of the steepest wave";
  return Violation{Rule::ShipHeave, "heave_amplitude_m", why.str()};
}

std::optional<ExcessTilt> excess_tilt(const PathPiece& piece, const VehicleAttitude& attitude) {
  if (attitude.vehicle_class != VehicleClass::Multirotor) return std::nullopt;
  const double span_s = time::to_seconds(piece.end - piece.start);
  for (const double part : {0.0, 0.5, 1.0}) {
    // The piece's own axes are level but for its length over the Earth's radius.
    const nav::Vector3 thrust =
        piece.acceleration_k(part * span_s) + attitude.drag_per_s * piece.velocity_k(part * span_s);
    const double tilt_deg =
        units::kDegPerRad * std::atan2(std::hypot(thrust.x(), thrust.y()), kG_m_per_s2 - thrust.z());
    if (tilt_deg > attitude.max_tilt_deg) return ExcessTilt{tilt_deg, time::to_seconds(piece.start) + part * span_s};
  }
  return std::nullopt;
}

}  // namespace inslab::scenario
