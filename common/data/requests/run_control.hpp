#pragma once

#include "inslab/data/requests/profile_request.hpp"

namespace inslab {
inline namespace samples {

enum class AckOutcome : std::uint32_t { Applied, Unchanged, Rejected, Superseded };
enum class CommandKind : std::uint32_t { Stop, Pause, Resume, Step, Rate };
enum class RunState : std::uint32_t { Waiting, Running, Paused, Finished, Stopped, Fault };

/// What sets the pace of a run.
enum class ClockMode : std::uint32_t {
  RealTime,  ///< a grid of absolute deadlines, at `rate` times real time
  Lockstep,  ///< as fast as every consumer follows; nothing is lost, samples travel in blocks
};

/// Limits of the rate of a real-time run, sim seconds per second.
inline constexpr double kMinRate = 0.01;
inline constexpr double kMaxRate = 1000.0;

/// Whether nothing more comes of the run.
inline bool has_ended(RunState state) { return state >= RunState::Finished; }

template <>
struct EnumNames<AckOutcome> {
  static constexpr std::string_view type = "AckOutcome";
  static constexpr std::string_view prefix = "ACK_";
  static constexpr std::array<std::string_view, 4> values{"applied", "unchanged", "rejected", "superseded"};
};
template <>
struct EnumNames<CommandKind> {
  static constexpr std::string_view type = "CommandKind";
  static constexpr std::string_view prefix = "COMMAND_";
  static constexpr std::array<std::string_view, 5> values{"stop", "pause", "resume", "step", "rate"};
};
template <>
struct EnumNames<RunState> {
  static constexpr std::string_view type = "RunState";
  static constexpr std::string_view prefix = "RUN_";
  static constexpr std::array<std::string_view, 6> values{"waiting",  "running", "paused",
                                                          "finished", "stopped", "fault"};
};
template <>
struct EnumNames<ClockMode> {
  static constexpr std::string_view type = "ClockMode";
  static constexpr std::string_view prefix = "CLOCK_";
  static constexpr std::array<std::string_view, 2> values{"real_time", "lockstep"};
};

/// What became of a request (idl/control.idl).
struct ProfileAck {
  RunId run_id;
  std::uint64_t request_id = 0;
  ProfileKind kind = ProfileKind::ImuError;
  SensorAddress target;
  std::uint32_t journal_number = 0;
  AckOutcome outcome = AckOutcome::Applied;
  std::string service;
  std::int64_t requested_time_ns = -1;
  std::int64_t apply_time_ns = 0;
  std::int64_t first_sample_time_ns = 0;
  std::uint64_t first_sequence = 0;
  bool requested_in_the_past = false;
  std::string field;
  std::string reason;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("run_id"), self.run_id);
    visit(Field("request_id"), self.request_id);
    visit(Field("kind"), self.kind);
    visit(Field("target_kind"), self.target.kind);
    visit(Field("target_number"), self.target.number);
    visit(Field("journal_number"), self.journal_number);
    visit(Field("outcome"), self.outcome);
    visit(Field("service").at_most(32), self.service);
    visit(Field("requested_time_ns"), self.requested_time_ns);
    visit(Field("apply_time_ns"), self.apply_time_ns);
    visit(Field("first_sample_time_ns"), self.first_sample_time_ns);
    visit(Field("first_sequence"), self.first_sequence);
    visit(Field("requested_in_the_past"), self.requested_in_the_past);
    visit(Field("field").at_most(128), self.field);
    visit(Field("reason").at_most(256), self.reason);
  }
};

/// The arms and angles that the app should believe; apart from the true ones, so that a wrong arm can be tested.
struct Installation {
  SensorAddress target;
  Vector3 lever_arm_v_m = Vector3::Zero();
  Vector3 mounting_rpy_deg = Vector3::Zero();
  Vector3 second_lever_arm_v_m = Vector3::Zero();  ///< of the second antenna, where there are two

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("target_kind").key(), self.target.kind);
    visit(Field("target_number").key(), self.target.number);
    visit(Field("lever_arm_v_m"), self.lever_arm_v_m);
    visit(Field("mounting_rpy_deg"), self.mounting_rpy_deg);
    visit(Field("second_lever_arm_v_m").appended(), self.second_lever_arm_v_m);
  }
};

/// Run control from a client; what became of it stands in SimStatus.
struct SimCommand {
  std::uint64_t request_id = 0;
  CommandKind kind = CommandKind::Stop;
  double value = 0.0;  ///< step: number of truth samples; rate: sim seconds per second; else unused

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("request_id"), self.request_id);
    visit(Field("kind"), self.kind);
    visit(Field("value"), self.value);
  }
};

/// Where the run is.
struct SimStatus {
  RunId run_id;
  RunState state = RunState::Waiting;
  std::int64_t sim_time_ns = 0;
  std::uint64_t truth_samples = 0;
  std::uint32_t journal_entries = 0;
  std::uint32_t overruns = 0;
  double lag_max_s = 0.0;
  ClockMode clock = ClockMode::RealTime;
  double rate = 1.0;                  ///< real time only
  std::uint64_t last_command_id = 0;  ///< request id of the newest command that was judged
  std::string last_command_refusal;   ///< empty when it was obeyed
  std::string scenario;
  std::string message;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("run_id"), self.run_id);
    visit(Field("state"), self.state);
    visit(Field("sim_time_ns"), self.sim_time_ns);
    visit(Field("truth_samples"), self.truth_samples);
    visit(Field("journal_entries"), self.journal_entries);
    visit(Field("overruns"), self.overruns);
    visit(Field("lag_max_s"), self.lag_max_s);
    visit(Field("clock"), self.clock);
    visit(Field("rate"), self.rate);
    visit(Field("last_command_id"), self.last_command_id);
    visit(Field("last_command_refusal").at_most(128), self.last_command_refusal);
    visit(Field("scenario").at_most(64), self.scenario);
    visit(Field("message").at_most(256), self.message);
  }
};

/// One instant in both clocks.
struct TimeMark {
  RunId run_id;
  std::int64_t sim_time_ns = 0;
  std::uint32_t gps_week = 0;
  std::int64_t gps_time_of_week_ns = 0;
  std::int64_t realtime_ns = 0;
  std::int64_t uncertainty_ns = 0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("run_id"), self.run_id);
    visit(Field("sim_time_ns"), self.sim_time_ns);
    visit(Field("gps_week"), self.gps_week);
    visit(Field("gps_time_of_week_ns"), self.gps_time_of_week_ns);
    visit(Field("realtime_ns"), self.realtime_ns);
    visit(Field("uncertainty_ns"), self.uncertainty_ns);
  }
};

}  // namespace samples
}  // namespace inslab
