#pragma once

#include <optional>

#include "inslab/foundation/fields/field.hpp"
#include "inslab/foundation/fields/violation.hpp"
#include "inslab/scenario/path_piece.hpp"

namespace inslab::scenario {

/// What holds a vehicle's attitude while it follows waypoints, or a file's rows that have no attitude.
enum class VehicleClass : std::uint32_t {
  NoseAlongTrack,  ///< yaw and pitch of the path, bank of a coordinated turn
  Multirotor,      ///< thrust along -z_v carries it, so the specific force tilts it; the nose turns as it is told
  Ship,            ///< yaw of the path, level but for roll and pitch in the waves
  FixedWing,       ///< yaw and pitch of the path, banked so that it feels no side force
};

/// How an attitude is made from a path (math in docs/models.md). Which parameters it has depends on `vehicle_class`.
struct VehicleAttitude {
  static constexpr bool has_discriminator = true;

  VehicleClass vehicle_class = VehicleClass::NoseAlongTrack;
  double max_bank_deg = 30.0;             ///< nose_along_track, fixed_wing
  double standstill_speed_m_per_s = 0.3;  ///< nose_along_track, ship, fixed_wing
  double max_tilt_deg = 35.0;             ///< multirotor
  double drag_per_s = 0.0;                ///< multirotor
  double yaw_deg = 0.0;                   ///< multirotor
  double roll_amplitude_deg = 0.0;        ///< ship
  double roll_period_s = 10.0;            ///< ship
  double pitch_amplitude_deg = 0.0;       ///< ship
  double pitch_period_s = 7.0;            ///< ship
  double heave_amplitude_m = 0.0;         ///< ship
  double heave_period_s = 8.0;            ///< ship
  double angle_of_attack_deg = 0.0;       ///< fixed_wing
  double lift_off_speed_m_per_s = 0.0;    ///< fixed_wing

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("vehicle_class", "what holds the attitude; the other parameters depend on it"), self.vehicle_class);
    const Field standstill =
        Field("standstill_speed_m_per_s",
              "of a file's rows: horizontal speed below which yaw and pitch of the path stay as they are; along "
              "waypoints the nose follows the line at rest too")
            .in(1e-3, 100.0);
    switch (self.vehicle_class) {
      case VehicleClass::NoseAlongTrack:
        visit(Field("max_bank_deg", "the bank of a coordinated turn is cut off here; 0: a vehicle that stays level")
                  .in(0.0, 85.0),
              self.max_bank_deg);
        visit(standstill, self.standstill_speed_m_per_s);
        break;
      case VehicleClass::Multirotor:
        visit(Field("max_tilt_deg", "of the thrust from the vertical: a path that needs more is refused").in(1.0, 80.0),
              self.max_tilt_deg);
        visit(Field("drag_per_s", "deceleration by the air over speed, which the thrust leans against").in(0.0, 10.0),
              self.drag_per_s);
        visit(Field("yaw_deg", "of the nose along a file's rows, and until a waypoint has one of its own")
                  .in(-180.0, 360.0),
              self.yaw_deg);
        break;
      case VehicleClass::Ship:
        visit(Field("roll_amplitude_deg", "of a sinusoid, at the quay too").in(0.0, 45.0), self.roll_amplitude_deg);
        visit(Field("roll_period_s").in(1.0, 1e3), self.roll_period_s);
        visit(Field("pitch_amplitude_deg", "of a sinusoid, at the quay too").in(0.0, 45.0), self.pitch_amplitude_deg);
        visit(Field("pitch_period_s").in(1.0, 1e3), self.pitch_period_s);
        visit(Field("heave_amplitude_m", "of a sinusoid in height over the path, at the quay too").in(0.0, 20.0),
              self.heave_amplitude_m);
        visit(Field("heave_period_s").in(1.0, 1e3), self.heave_period_s);
        visit(standstill, self.standstill_speed_m_per_s);
        break;
      case VehicleClass::FixedWing:
        visit(Field("max_bank_deg", "the bank is cut off here").in(0.0, 85.0), self.max_bank_deg);
        visit(Field("angle_of_attack_deg", "of the nose above the path, in the air").in(-20.0, 20.0),
              self.angle_of_attack_deg);
        visit(Field("lift_off_speed_m_per_s",
                    "below it the wings are level and the nose is on the path; above 1.25 times it the aircraft flies")
                  .in(0.0, 1e3),
              self.lift_off_speed_m_per_s);
        visit(standstill, self.standstill_speed_m_per_s);
        break;
    }
  }
};

/// The first rule across its fields that it breaks, or nothing: a ship does not heave harder than the sea can.
std::optional<Violation> violation(const VehicleAttitude& attitude);

/// A lean beyond what a multirotor can, and when.
struct ExcessTilt {
  double tilt_deg = 0.0;
  double at_s = 0.0;
};
/// The first at the start, the middle or the end of a piece of its path; nothing for another class.
std::optional<ExcessTilt> excess_tilt(const PathPiece& piece, const VehicleAttitude& attitude);

}  // namespace inslab::scenario

namespace inslab {

template <>
struct EnumNames<scenario::VehicleClass> {
  static constexpr std::string_view type = "VehicleClass";
  static constexpr std::string_view prefix = "VEHICLE_";
  static constexpr std::array<std::string_view, 4> values{"nose_along_track", "multirotor", "ship", "fixed_wing"};
};

}  // namespace inslab
