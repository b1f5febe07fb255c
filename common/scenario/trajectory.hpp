#pragma once

#include <optional>
#include <string>
#include <vector>

#include "inslab/foundation/fields/field.hpp"
#include "inslab/foundation/fields/violation.hpp"
#include "inslab/nav/gravity.hpp"
#include "inslab/scenario/file_motion.hpp"
#include "inslab/scenario/live_vehicle.hpp"
#include "inslab/scenario/vehicle_class.hpp"
#include "inslab/scenario/waypoint.hpp"

/// The motion part of a scenario: where the vehicle starts and what it does, segment after segment.
///
/// Frames: n is local NED at the vehicle, v is forward-right-down at the vehicle's reference point.
/// Source: thesis 3.2.1 and table 3-1, with the extensions named in docs/models.md.
namespace inslab::scenario {

inline constexpr std::size_t kMaxSegments = 100000;
inline constexpr double kMaxTrajectoryLength_s = 1e9;
/// What a gun gives a shell is within: 1e4 g, and 300 turns a second.
inline constexpr double kMaxMotion_m_per_s2 = 1e6;
inline constexpr double kMaxMotion_deg_per_s = 1e6;

/// What one motion does. Numbers in the comments are the types of the thesis's table 3-1.
enum class MotionType : std::uint32_t {
  Uniform,        ///< 1: rest or constant velocity
  DeltaSpeed,     ///< 2: a change of speed, acceleration a trapezoid
  TargetSpeed,    ///< 3: to a speed, acceleration a trapezoid
  ConstantAccel,  ///< 4
  SineAccel,      ///< 5: A sin(2 pi t/T)
  RampAccel,      ///< 6: linear from one value to another
  Turn,           ///< 7: through an angle, angular acceleration of two triangles
  ConstantRate,   ///< 8: a circle
  SineRate,       ///< 9: A sin(2 pi t/T)
  CosineRate,     ///< 91: A cos(2 pi t/T)
  RampRate,       ///< 10: linear from one value to another
  Ballistic,      ///< gravity and drag alone; the attitude follows the velocity
};

/// An axis of v.
enum class Axis : std::uint32_t { X, Y, Z };

/// One motion along or about one axis of v. Which parameters it has depends on `type`: visitors that describe the
/// struct (schema, reference page) walk `fields` once for every value of `type`.
struct Motion {
  static constexpr bool has_discriminator = true;

  MotionType type = MotionType::Uniform;
  std::optional<Axis> axis;            ///< absent: see axis_of()
  double speed_change_m_per_s = 0.0;   ///< delta_speed
  double final_speed_m_per_s = 0.0;    ///< target_speed
  double acceleration_m_per_s2 = 0.0;  ///< constant_accel
  double amplitude_m_per_s2 = 0.0;     ///< sine_accel
  double from_m_per_s2 = 0.0;          ///< ramp_accel
  double to_m_per_s2 = 0.0;            ///< ramp_accel
  double angle_deg = 0.0;              ///< turn
  double rate_deg_per_s = 0.0;         ///< constant_rate
  double amplitude_deg_per_s = 0.0;    ///< sine_rate, cosine_rate
  double from_deg_per_s = 0.0;         ///< ramp_rate
  double to_deg_per_s = 0.0;           ///< ramp_rate
  double period_s = 1.0;               ///< sine_accel, sine_rate, cosine_rate
  double ramp_fraction = 0.25;         ///< delta_speed, target_speed, turn
  double drag_per_m = 0.0;             ///< ballistic
  double spin_deg_per_s = 0.0;         ///< ballistic
  double spin_decay_s = 0.0;           ///< ballistic
  bool until_start_height = false;     ///< ballistic

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit);
};

/// A stretch of time in which the same motions act together.
struct Segment {
  std::string name;
  double duration_s = 0.0;
  std::vector<Motion> motions;
  bool keep_velocity_on_nose = true;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("name", "for messages and reports"), self.name);
    visit(Field("duration_s", "rounded to the nanosecond").in(1e-6, 1e7).required(), self.duration_s);
    visit(Field("motions", "act together; none: uniform").at_most(16), self.motions);
    visit(Field("keep_velocity_on_nose", "the velocity turns with the vehicle; false: it keeps its direction (sway)"),
          self.keep_velocity_on_nose);
  }
};

/// Where and how the vehicle starts.
struct InitialState {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double height_m = 0.0;
  double speed_m_per_s = 0.0;
  double roll_deg = 0.0;
  double pitch_deg = 0.0;
  double yaw_deg = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("latitude_deg", "WGS-84").in(-nav::kMaxLatitudeDeg, nav::kMaxLatitudeDeg).required(),
          self.latitude_deg);
    visit(Field("longitude_deg", "WGS-84, east positive").in(-180.0, 360.0).required(), self.longitude_deg);
    visit(Field("height_m", "above the ellipsoid").in(nav::kMinHeightM, nav::kMaxHeightM).required(), self.height_m);
    visit(Field("speed_m_per_s", "along x_v, relative to the Earth").in(-1e4, 1e4), self.speed_m_per_s);
    visit(Field("roll_deg", "right side down").in(-180.0, 180.0), self.roll_deg);
    visit(Field("pitch_deg", "nose up").in(-90.0, 90.0), self.pitch_deg);
    visit(Field("yaw_deg", "of the nose, from north towards east").in(-180.0, 360.0), self.yaw_deg);
  }
};

/// How much gravity varies with place.
enum class GravityTerrain : std::uint32_t { Plain, Hills, Mountains };

/// Gravity that varies with place, drawn from the scenario's seed: see scenario::gravity_field.
struct GravityVariation {
  GravityTerrain terrain = GravityTerrain::Hills;
  std::optional<double> deflection_rms_arcsec = std::nullopt;
  double correlation_m = 20000.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("terrain",
                "RMS of one component of the deflection of the vertical: plain 2, hills 6, mountains 15 arcsec"),
          self.terrain);
    visit(Field("deflection_rms_arcsec", "instead of the terrain's").in(0.0, 60.0), self.deflection_rms_arcsec);
    visit(Field("correlation_m", "D of the third-order model of the undulation").in(5e3, 1e6), self.correlation_m);
  }
};

/// The Earth's gravity. Of the model a navigation filter knows; what departs from it, none does.
struct GravityOptions {
  nav::GravityModel model = nav::GravityModel::Normal;
  double disturbance_mgal = 0.0;
  double deflection_north_arcsec = 0.0;
  double deflection_east_arcsec = 0.0;
  std::optional<GravityVariation> variation = std::nullopt;
  std::string grid_file;  ///< LoadedScenario::gravity_grid has what it says

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(
        Field(
            "model",
            "normal: the exact field of the ellipsoid; somigliana: WGS-84 closed form, second order in height, without "
            "the part to the north (8.1 mGal at 10 km, 80 at 99 km, 45 deg); series: GRS80 series, as many filters "
            "have "
            "it"),
        self.model);
    visit(Field("disturbance_mgal", "added to the magnitude").in(-1000.0, 1000.0), self.disturbance_mgal);
    visit(Field("deflection_north_arcsec", "xi: the plumb line's zenith lies north of the normal").in(-200.0, 200.0),
          self.deflection_north_arcsec);
    visit(Field("deflection_east_arcsec", "eta: the plumb line's zenith lies east of the normal").in(-200.0, 200.0),
          self.deflection_east_arcsec);
    visit(Field("variation", "what varies with place, besides"), self.variation);
    visit(
        Field("grid_file",
              "file with what varies with place, besides: latitude deg, longitude deg, and what is added to the north, "
              "to the east and down, mGal, at the knots of a regular grid; it holds at every height")
            .at_most(4096),
        self.grid_file);
  }
};

/// What the motion is made from.
enum class TrajectorySource : std::uint32_t {
  MotionTable,   ///< segments, one after the other; after the last the vehicle goes on as it is
  File,          ///< the rows of a file; LoadedScenario has them
  Waypoints,     ///< places passed at given speeds, the attitude from the path
  VehicleState,  ///< a simulator outside sends inslab/vehicle_state
};

/// The motion of the vehicle. Which parameters it has depends on `source`.
struct Trajectory {
  static constexpr bool has_discriminator = true;

  TrajectorySource source = TrajectorySource::MotionTable;
  GravityOptions gravity;
  InitialState initial;                     ///< motion_table, vehicle_state
  std::vector<Segment> segments;            ///< motion_table
  std::string segments_file;                ///< motion_table; load() puts what it says into `segments`
  FileMotion file;                          ///< file
  std::vector<Waypoint> waypoints;          ///< waypoints
  double max_acceleration_m_per_s2 = 30.0;  ///< waypoints
  double leg_acceleration_m_per_s2 = 2.0;   ///< waypoints
  VehicleAttitude attitude_from_path;       ///< waypoints
  LiveVehicle vehicle;                      ///< vehicle_state

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("source", "what the motion is made from; the other parameters depend on it"), self.source);
    visit(Field("gravity"), self.gravity);
    switch (self.source) {
      case TrajectorySource::MotionTable:
        visit(Field("initial", "state at the scenario's start").required(), self.initial);
        visit(Field("segments", "one after the other").at_most(kMaxSegments), self.segments);
        visit(Field("segments_file", "file with them as a plain matrix (CSV): type, duration_s and two parameters")
                  .at_most(4096),
              self.segments_file);
        break;
      case TrajectorySource::File:
        visit(Field("file", "the rows and how the motion is made from them").required(), self.file);
        break;
      case TrajectorySource::Waypoints:
        visit(Field("waypoints", "passed in this order; sim time 0 is the first").at_most(10000).required(),
              self.waypoints);
        visit(Field("max_acceleration_m_per_s2", "a path that needs more, in a bend or between speeds, is refused")
                  .in(1e-3, 1e4),
              self.max_acceleration_m_per_s2);
        visit(Field("leg_acceleration_m_per_s2",
                    "the largest along the path with which a leg of its own speed speeds up and brakes")
                  .in(1e-4, 1e3),
              self.leg_acceleration_m_per_s2);
        visit(Field("attitude_from_path"), self.attitude_from_path);
        break;
      case TrajectorySource::VehicleState:
        visit(Field("initial", "state at the scenario's start").required(), self.initial);
        visit(Field("vehicle", "how the truth follows what a simulator outside sends").required(), self.vehicle);
        break;
    }
  }
};

/// True for the motions that turn the vehicle, false for those that accelerate it (and for uniform).
bool is_angular(MotionType type);

/// The axis a motion acts along or about: the one it names, or else z_v for angular and x_v for linear motions.
Axis axis_of(const Motion& motion);

/// How its waypoints become a route: one curve passes through the stops of a vehicle whose nose follows the path, while
/// a multirotor leaves a stop in any direction.
RouteOptions route_options(const Trajectory& trajectory);

/// The first rule that the trajectory breaks and that no single field's limits express, or nothing.
std::optional<Violation> violation(const Trajectory& trajectory);

template <class Self, class Visitor>
void Motion::fields(Self& self, Visitor& visit) {
  visit(Field("type", "the other parameters depend on it").required(), self.type);
  if (self.type != MotionType::Uniform && self.type != MotionType::Ballistic) {
    visit(Field("axis", "of the vehicle; absent: x for accelerations, z for turns and rates"), self.axis);
  }
  const Field ramp_fraction =
      Field("ramp_fraction", "share of the duration that the rise takes, and the fall").in(1e-6, 0.5);
  const Field period = Field("period_s", "of the sinusoid").in(1e-3, 1e7).required();
  switch (self.type) {
    case MotionType::Uniform:
      break;
    case MotionType::DeltaSpeed:
      visit(Field("speed_change_m_per_s", "reached at the end").in(-1e4, 1e4).required(), self.speed_change_m_per_s);
      visit(ramp_fraction, self.ramp_fraction);
      break;
    case MotionType::TargetSpeed:
      visit(Field("final_speed_m_per_s", "along the axis, reached at the end").in(-1e4, 1e4).required(),
            self.final_speed_m_per_s);
      visit(ramp_fraction, self.ramp_fraction);
      break;
    case MotionType::ConstantAccel:
      visit(Field("acceleration_m_per_s2").in(-kMaxMotion_m_per_s2, kMaxMotion_m_per_s2).required(),
            self.acceleration_m_per_s2);
      break;
    case MotionType::SineAccel:
      visit(Field("amplitude_m_per_s2", "peak").in(-kMaxMotion_m_per_s2, kMaxMotion_m_per_s2).required(),
            self.amplitude_m_per_s2);
      visit(period, self.period_s);
      break;
    case MotionType::RampAccel:
      visit(Field("from_m_per_s2", "at the segment's start").in(-kMaxMotion_m_per_s2, kMaxMotion_m_per_s2).required(),
            self.from_m_per_s2);
      visit(Field("to_m_per_s2", "at the segment's end").in(-kMaxMotion_m_per_s2, kMaxMotion_m_per_s2).required(),
            self.to_m_per_s2);
      break;
    case MotionType::Turn:
      visit(Field("angle_deg", "about z: right positive").in(-1e5, 1e5).required(), self.angle_deg);
      visit(ramp_fraction, self.ramp_fraction);
      break;
    case MotionType::ConstantRate:
      visit(
          Field("rate_deg_per_s", "about z: right positive").in(-kMaxMotion_deg_per_s, kMaxMotion_deg_per_s).required(),
          self.rate_deg_per_s);
      break;
    case MotionType::SineRate:
    case MotionType::CosineRate:
      visit(Field("amplitude_deg_per_s", "peak").in(-kMaxMotion_deg_per_s, kMaxMotion_deg_per_s).required(),
            self.amplitude_deg_per_s);
      visit(period, self.period_s);
      break;
    case MotionType::RampRate:
      visit(
          Field("from_deg_per_s", "at the segment's start").in(-kMaxMotion_deg_per_s, kMaxMotion_deg_per_s).required(),
          self.from_deg_per_s);
      visit(Field("to_deg_per_s", "at the segment's end").in(-kMaxMotion_deg_per_s, kMaxMotion_deg_per_s).required(),
            self.to_deg_per_s);
      break;
    case MotionType::Ballistic:
      visit(Field("drag_per_m", "deceleration over speed squared: half of density, drag coefficient and area over mass")
                .in(0.0, 1.0),
            self.drag_per_m);
      visit(
          Field("spin_deg_per_s", "about the velocity, at the segment's start; clockwise as seen from behind positive")
              .in(-kMaxMotion_deg_per_s, kMaxMotion_deg_per_s),
          self.spin_deg_per_s);
      visit(Field("spin_decay_s", "time in which the air slows the spin to 1/e of it; 0: it does not").in(0.0, 1e6),
            self.spin_decay_s);
      visit(Field("until_start_height",
                  "the segment ends when the vehicle is back at the height of its start, after duration_s at the "
                  "latest; with the last segment ends the run"),
            self.until_start_height);
      break;
  }
}

}  // namespace inslab::scenario

namespace inslab {

template <>
struct EnumNames<nav::GravityModel> {
  static constexpr std::string_view type = "GravityModel";
  static constexpr std::string_view prefix = "GRAVITY_";
  static constexpr std::array<std::string_view, 3> values{"somigliana", "normal", "series"};
};
template <>
struct EnumNames<scenario::GravityTerrain> {
  static constexpr std::string_view type = "GravityTerrain";
  static constexpr std::string_view prefix = "TERRAIN_";
  static constexpr std::array<std::string_view, 3> values{"plain", "hills", "mountains"};
};
template <>
struct EnumNames<scenario::MotionType> {
  static constexpr std::string_view type = "MotionType";
  static constexpr std::string_view prefix = "MOTION_";
  static constexpr std::array<std::string_view, 12> values{
      "uniform", "delta_speed",   "target_speed", "constant_accel", "sine_accel", "ramp_accel",
      "turn",    "constant_rate", "sine_rate",    "cosine_rate",    "ramp_rate",  "ballistic"};
  static constexpr std::array<std::uint32_t, 11> numbers{1, 2, 3, 4, 5, 6, 7, 8, 9, 91, 10};  ///< thesis, table 3-1
};
template <>
struct EnumNames<scenario::TrajectorySource> {
  static constexpr std::string_view type = "TrajectorySource";
  static constexpr std::string_view prefix = "TRAJECTORY_";
  static constexpr std::array<std::string_view, 4> values{"motion_table", "file", "waypoints", "vehicle_state"};
};
template <>
struct EnumNames<scenario::Axis> {
  static constexpr std::string_view type = "Axis";
  static constexpr std::string_view prefix = "AXIS_";
  static constexpr std::array<std::string_view, 3> values{"x", "y", "z"};
};

}  // namespace inslab
