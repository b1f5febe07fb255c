#pragma once

#include "inslab/foundation/fields/field.hpp"

namespace inslab {
inline namespace samples {

/// Every reason for which a file or a request is refused. Nothing is refused without naming one, and a test demands
/// that config/invalid holds a file for each, so a new reason begins here and ends there.
enum class Rule : std::uint32_t {
  // The text of a file.
  Readable,   ///< the file is there and can be read
  NotEmpty,   ///< it holds something
  ValidJson,  ///< NaN, Infinity, comments and truncated files are not
  KeysOnce,   ///< no key is given twice in one object
  // One field, against its declaration.
  KnownKey,     ///< every key is declared; its unit is part of it
  RequiredKey,  ///< every required key is there
  ValueType,    ///< a number where a number belongs, a list where a list does
  ValueRange,   ///< finite, and inside the declared limits
  BoundedSize,  ///< lists and texts are no longer than declared
  PlainText,    ///< texts are one line, without control characters
  KnownName,    ///< words out of a fixed set
  // Several fields of a scenario.
  RunName,               ///< a run's name makes a file's name
  RunLength,             ///< at least one period of the truth
  StartInWeek,           ///< the seconds of week are less than a week
  MagneticModelDate,     ///< the run begins in the years of the model of the Earth's field, or it may be extrapolated
  SensorNumberOnce,      ///< no two sensors of a kind share a number
  SensorInstants,        ///< instants of two streams coincide or keep a distance
  OutagePeriod,          ///< an outage ends before it comes again
  OutagePath,            ///< an outage area has points, and legs of at most 10 km
  NamedFile,             ///< files that a scenario names are there
  RecordingFits,         ///< recordings that profiles name are there, and last as long as the run
  GravityGrid,           ///< a grid of gravity reaches to the places of which the scenario speaks
  SensorExists,          ///< swaps and services name sensors of the scenario
  SwapBeforeEnd,         ///< a swap lies inside the run
  SwapsInOrder,          ///< swaps are in order of time
  OneNavApp,             ///< the reference navigation app is the app under test, or another one is
  SubscribedTopic,       ///< foreign readers are demanded on topics of the scenario's sensors
  AcceptanceLimit,       ///< an acceptance line has a limit, and its least is not above its most
  AcceptancePhase,       ///< figures of the whole run have no phase, and swap intervals are those of the scenario
  AcceptanceClock,       ///< latencies are judged in real time: in lockstep the clock waits for the app
  TargetSpeedAlone,      ///< nothing else accelerates along the axis of a target speed
  TargetSpeedOnNose,     ///< the axis of a target speed does not turn away from the velocity
  BallisticAlone,        ///< nothing else moves or turns a ballistic vehicle
  SegmentsOnce,          ///< the segments are in the scenario or in a file, not in both
  MotionMatrix,          ///< a file of segments has the rows of the thesis's matrix
  TrajectoryLength,      ///< at most 1e9 s
  VehicleLatency,        ///< the latency of a live vehicle holds a period of its states
  VehicleClock,          ///< a live vehicle keeps real time
  WaypointCount,         ///< at least two
  WaypointsApart,        ///< neighbours are neither one place nor too far apart
  WaypointSpeeds,        ///< a leg that begins and ends at rest has a speed of its own
  WaypointLegSpeed,      ///< which is not below that of its ends, and the leg is long enough to change speed
  WaypointWait,          ///< waits are at rest
  WaypointTurn,          ///< the path does not turn back on itself
  WaypointAcceleration,  ///< within the scenario's limit
  WaypointTilt,          ///< of a multirotor, likewise
  WaypointYaw,           ///< only a vehicle whose nose is free is told where it points
  ShipHeave,             ///< a ship's heave is within what the steepest wave gives
  FileAttitude,          ///< a class makes the attitude of rows that have none
  RouteCoversRun,        ///< a path that ends in motion reaches to the end of the run
  MethodNeeds,           ///< the file has the columns that the method works on
  FileCoversRun,         ///< the file's rows reach to the end of the run
  // The rows of a trajectory file.
  FileColumns,   ///< known columns, each once, enough of them, and the same number in every row
  FileTime,      ///< time increases
  FileGap,       ///< rows follow each other within the stated limit
  FileVelocity,  ///< the velocity agrees with the positions
  FileStep,      ///< position, velocity and attitude do not jump
  FileOffTrack,  ///< the nose does not point away from the velocity, when that is judged
  // Several fields of a profile.
  ProfileFitsSensor,   ///< a profile goes to a sensor of a kind that has such
  OnlyVibrationFades,  ///< a fade is for vibration
  CorrelationTime,     ///< a Gauss-Markov process with a sigma has a correlation time
  LeverArmLength,      ///< at most 1 km
  AntennaMounting,     ///< an antenna has no axes
  BaselineLength,      ///< two antennas stand apart; others have no second arm
  SolutionsAscend,     ///< lesser solutions go up from the worst, each worse than the profile's own
  FixTypeGiven,        ///< a receiver without any fix is a fault, not an error profile
  FaultFitsSensor,     ///< each fault is one of a kind of sensor, as an outage is one of receivers
  FaultComesAndGoes,   ///< what is intermittent is a fault
  FullScale,           ///< an accelerometer that saturates reads at least 1 g
  NonlinearityScale,   ///< a non-linearity in parts of full scale has a full scale
  CornersInOrder,      ///< corners of the temperature, or of currents, are in order of time
  RandomTable,         ///< a spectral density has two or more corners, in order of frequency
  MotionReach,         ///< a mount moves at most 5 cm and 2 deg
  MotionFrequency,     ///< and at most 2 kHz
  MotionHarmonic,      ///< random vibration is for the sensor domain
  PressureRange,       ///< the largest pressure of a sensor is above its smallest
  WholeCounts,         ///< an encoder has a whole number of counts a revolution
  WindLevels,          ///< heights of the wind go up
  RecordingNamed,      ///< a recording is named by its file and its SHA-256
  // Several fields of a navigation filter's parameters.
  InitialPitch,    ///< a given pitch lies within 90 deg
  RestThresholds,  ///< zero-velocity updates have thresholds that an IMU at rest can keep
  // Requests only.
  ApplyTime,  ///< within the longest scenario
};

template <>
struct EnumNames<Rule> {
  static constexpr std::string_view type = "Rule";
  static constexpr std::string_view prefix = "RULE_";
  static constexpr std::array<std::string_view, 82> values{"readable",
                                                           "not_empty",
                                                           "valid_json",
                                                           "keys_once",
                                                           "known_key",
                                                           "required_key",
                                                           "value_type",
                                                           "value_range",
                                                           "bounded_size",
                                                           "plain_text",
                                                           "known_name",
                                                           "run_name",
                                                           "run_length",
                                                           "start_in_week",
                                                           "magnetic_model_date",
                                                           "sensor_number_once",
                                                           "sensor_instants",
                                                           "outage_period",
                                                           "outage_path",
                                                           "named_file",
                                                           "recording_fits",
                                                           "gravity_grid",
                                                           "sensor_exists",
                                                           "swap_before_end",
                                                           "swaps_in_order",
                                                           "one_nav_app",
                                                           "subscribed_topic",
                                                           "acceptance_limit",
                                                           "acceptance_phase",
                                                           "acceptance_clock",
                                                           "target_speed_alone",
                                                           "target_speed_on_nose",
                                                           "ballistic_alone",
                                                           "segments_once",
                                                           "motion_matrix",
                                                           "trajectory_length",
                                                           "vehicle_latency",
                                                           "vehicle_clock",
                                                           "waypoint_count",
                                                           "waypoints_apart",
                                                           "waypoint_speeds",
                                                           "waypoint_leg_speed",
                                                           "waypoint_wait",
                                                           "waypoint_turn",
                                                           "waypoint_acceleration",
                                                           "waypoint_tilt",
                                                           "waypoint_yaw",
                                                           "ship_heave",
                                                           "file_attitude",
                                                           "route_covers_run",
                                                           "method_needs",
                                                           "file_covers_run",
                                                           "file_columns",
                                                           "file_time",
                                                           "file_gap",
                                                           "file_velocity",
                                                           "file_step",
                                                           "file_off_track",
                                                           "profile_fits_sensor",
                                                           "only_vibration_fades",
                                                           "correlation_time",
                                                           "lever_arm_length",
                                                           "antenna_mounting",
                                                           "baseline_length",
                                                           "solutions_ascend",
                                                           "fix_type_given",
                                                           "fault_fits_sensor",
                                                           "fault_comes_and_goes",
                                                           "full_scale",
                                                           "nonlinearity_scale",
                                                           "corners_in_order",
                                                           "random_table",
                                                           "motion_reach",
                                                           "motion_frequency",
                                                           "motion_harmonic",
                                                           "pressure_range",
                                                           "whole_counts",
                                                           "wind_levels",
                                                           "recording_named",
                                                           "initial_pitch",
                                                           "rest_thresholds",
                                                           "apply_time"};
};
/// Rules that no file can break: the rest is shown by the files of config/invalid.
constexpr bool is_for_requests_only(Rule rule) { return rule >= Rule::ApplyTime; }

static_assert(EnumNames<Rule>::values.size() == static_cast<std::size_t>(Rule::ApplyTime) + 1, "a rule has no name");

}  // namespace samples
}  // namespace inslab
