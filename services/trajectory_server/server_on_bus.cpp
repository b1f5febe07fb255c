#include "services/trajectory_server/server_on_bus.hpp"

#include <fmt/format.h>

#include "app/exit_code.hpp"
#include "app/host.hpp"
#include "app/service_names.hpp"
#include "app/shutdown.hpp"
#include "app/stamp.hpp"

namespace inslab::trajectory {

using app::monotonic_now;
using std::chrono::milliseconds;
using std::chrono::seconds;

ServerOnBus::ServerOnBus(app::Context& context)
    : context_(context),
      scenario_(context.scenario()),
      run_id_(app::random_run_id()),
      truth_sent_(dds::topics::truth().name, StreamDirection::Out),
      board_(context.participant(), context.service(), 0,
             [this](ServiceStatus& status) {
               status.streams.push_back(truth_sent_.status());
               if (vehicle_ && source_) vehicle_->fill(status, *source_->vehicle_link());
               status.overruns = status_.overruns;
               status.queue_depth_max = static_cast<std::uint32_t>(mailbox_.deepest());
             }),
      truth_(context.participant(), dds::topics::truth(scenario_.scenario.truth_rate_hz)),
      sim_status_(context.participant(), dds::topics::sim_status()),
      installation_(context.participant(), dds::topics::installation()),
      time_mark_(context.participant(), dds::topics::time_mark()),
      acks_(context.participant(), dds::topics::profile_ack()),
      commands_(context.participant(), dds::topics::sim_command(),
                [this](const SimCommand& command, const dds::SampleOrigin&) { mailbox_.put(command); }),
      service_status_(context.participant(), dds::topics::service_status(),
                      [this](const ServiceStatus& status, const dds::SampleOrigin&) { mailbox_.put(status); }) {
  open_profile_topics<ImuErrorProfile>(context.participant());
  open_profile_topics<VibrationProfile>(context.participant());
  open_profile_topics<InstallationProfile>(context.participant());
  open_profile_topics<GnssErrorProfile>(context.participant());
  open_profile_topics<FaultProfile>(context.participant());
  if (scenario_.scenario.trajectory.source == scenario::TrajectorySource::VehicleState) {
    vehicle_ = std::make_unique<VehicleOnBus>(context.participant(), scenario_.scenario.trajectory.vehicle,
                                              [this](const VehicleState& state) { mailbox_.put(state); });
  }
  status_.run_id = run_id_;
  status_.scenario = scenario_.scenario.name;
  board_.set_run(run_id_);
}

template <class Profile>
void ServerOnBus::open_profile_topics(dds::Participant& participant) {
  auto journal = std::make_shared<dds::Writer<Profile>>(participant, dds::topics::journal<Profile>());
  write_journal_[Profile::kind] = [journal](const AnyProfile& entry) {
    if (!journal->write(std::get<Profile>(entry))) spdlog::error("a journal entry could not be sent");
  };
  entities_.push_back(journal);
  entities_.push_back(std::make_shared<dds::OpenReader<Profile>>(
      participant, dds::topics::request<Profile>(),
      [this](const Profile& request, const dds::SampleOrigin&) { mailbox_.put(AnyProfile(request)); }));
}

void ServerOnBus::judge(const AnyProfile& request) {
  auto verdict = source_->submit(request);
  if (const auto* entry = std::get_if<AnyProfile>(&verdict)) {
    write_journal_[kind_of(*entry)](*entry);
    status_.journal_entries = source_->journal_size();
    spdlog::info("journal {}: {} '{}' for {} from {:.3f} s on", request_of(*entry).journal_number,
                 enum_name(kind_of(*entry)), name_of(*entry), sensor_name(target_of(*entry)),
                 static_cast<double>(request_of(*entry).apply_at_ns) * 1e-9);
    return;
  }
  auto& rejection = std::get<ProfileAck>(verdict);
  rejection.run_id = run_id_;
  rejection.service = context_.service();
  acks_.write(rejection);
  spdlog::warn("rejected {} for {}: {}: {}", enum_name(rejection.kind), sensor_name(rejection.target), rejection.field,
               rejection.reason);
}

/// Takes what has arrived; waits up to `patience` for the first.
void ServerOnBus::handle_messages(time::Nanoseconds patience) {
  for (auto message = mailbox_.take(patience); message; message = mailbox_.take(time::Nanoseconds(0))) {
    if (const auto* request = std::get_if<AnyProfile>(&*message)) {
      judge(*request);
    } else if (std::holds_alternative<SimCommand>(*message)) {
      stop_requested_ = true;
    } else if (const auto* state = std::get_if<VehicleState>(&*message)) {
      // Before the run there is no time that a state could be of.
      if (status_.state == RunState::Running) vehicle_->take(*state, *source_);
    } else {
      const auto& status = std::get<ServiceStatus>(*message);
      services_[{status.service, status.sensor_number}] = status.state;
    }
  }
}

std::vector<std::string> ServerOnBus::missing_services() const {
  std::vector<std::string> missing;
  for (const auto& [service, number] : app::required_services(scenario_)) {
    const auto found = services_.find({service, number});
    if (found == services_.end() || found->second != ServiceState::Ready) {
      missing.push_back(service + " (sensor " + std::to_string(number) + ")");
    }
  }
  return missing;
}

/// Names who else is not there yet; empty when everybody is.
std::string ServerOnBus::missing_peers() const {
  std::string names;
  for (const std::string& name : missing_services()) names += (names.empty() ? "" : ", ") + name;
  if (!names.empty()) return names;
  const auto needed_readers = static_cast<int>(app::required_services(scenario_).size());
  if (truth_.matched_readers() < needed_readers) return "a reader of inslab/truth";
  return vehicle_ && !vehicle_->connected() ? "a writer of inslab/vehicle_state" : "";
}

/// The barrier before the first sample. False when it timed out or a signal came.
bool ServerOnBus::wait_until_ready() {
  const auto timeout = time::from_seconds(scenario_.scenario.real_time.ready_timeout_s);
  const auto deadline = monotonic_now() + timeout;
  board_.enter(ServiceState::Ready);
  for (std::string names = missing_peers(); !names.empty(); names = missing_peers()) {
    if (app::shutdown_requested() || stop_requested_) return false;
    if (monotonic_now() > deadline) {
      spdlog::error("not ready after {} s: {}", scenario_.scenario.real_time.ready_timeout_s, names);
      status_.message = ("not ready: " + names).substr(0, 256);
      return false;
    }
    handle_messages(milliseconds(2));
    report_status();
    board_.tick();
  }
  return true;
}

void ServerOnBus::begin() {
  app::use_precise_timers();
  // Sim time 0 lies a little ahead, so that the first deadlines are met too.
  time::Nanoseconds realtime = app::realtime_now();
  zero_ = monotonic_now() + milliseconds(100);
  if (scenario_.scenario.real_time.whole_second_start) {
    const time::Nanoseconds into_second = realtime % seconds(1);
    zero_ = monotonic_now() + seconds(1) - into_second + (into_second > milliseconds(900) ? seconds(1) : seconds(0));
  }
  status_.state = RunState::Running;
  next_report_ = time::Nanoseconds(0);
  report_status();
  board_.enter(ServiceState::Running);
}

void ServerOnBus::send_next() {
  const time::Nanoseconds deadline = zero_ + source_->next_time();
  app::sleep_until(deadline);
  handle_messages(time::Nanoseconds(0));
  TruthState sample = source_->take();
  const time::Nanoseconds late = monotonic_now() - deadline;
  if (truth_.write(app::stamped(sample))) truth_sent_.sent();
  if (late > scenario_.truth_rate.period()) ++status_.overruns;
  status_.lag_max_s = std::max(status_.lag_max_s, time::to_seconds(late));
  status_.sim_time_ns = sample.header.sim_time_ns;
  status_.truth_samples = source_->taken();
  board_.set_sim_time(sample.header.sim_time_ns);
  if (sample.header.sim_time_ns >= static_cast<std::int64_t>(time_marks_) * 1'000'000'000) send_time_mark();
  report_status();
  board_.tick();
  source_->prepare();
}

void ServerOnBus::send_time_mark() {
  ++time_marks_;
  TimeMark mark;
  mark.run_id = run_id_;
  const time::Nanoseconds before = monotonic_now();
  const time::Nanoseconds realtime = app::realtime_now();
  const time::Nanoseconds after = monotonic_now();
  const time::Nanoseconds sim_time = before + (after - before) / 2 - zero_;
  const time::GpsTime gps = scenario_.start(realtime - sim_time) + sim_time;
  mark.sim_time_ns = sim_time.count();
  mark.gps_week = gps.week;
  mark.gps_time_of_week_ns = gps.time_of_week_ns;
  mark.realtime_ns = realtime.count();
  mark.uncertainty_ns = (after - before).count();
  time_mark_.write(mark);
}

/// Ten times a second.
void ServerOnBus::report_status() {
  if (monotonic_now() < next_report_) return;
  next_report_ = monotonic_now() + milliseconds(100);
  sim_status_.write(status_);
  if (vehicle_ && status_.state == RunState::Running) vehicle_->report(*source_, run_id_, status_.sim_time_ns);
}

int ServerOnBus::end(RunState state, const std::string& message) {
  status_.state = state;
  status_.message = message.substr(0, 256);
  truth_.wait_for_acknowledgments(seconds(5));
  if (vehicle_) {
    vehicle_->report(*source_, run_id_, status_.sim_time_ns);
    vehicle_->flush(seconds(5));
  }
  sim_status_.write(status_);
  sim_status_.wait_for_acknowledgments(seconds(5));
  const bool good = state == RunState::Finished || (state == RunState::Stopped && source_->taken() > 0);
  board_.enter(good ? ServiceState::Finished : ServiceState::Fault, message);
  board_.flush(seconds(2));
  spdlog::info("{}: {} truth samples, {} overruns, largest lag {:.3f} ms{}", enum_name(state), source_->taken(),
               status_.overruns, status_.lag_max_s * 1e3, message.empty() ? "" : ": " + message);
  return good ? app::kOk : app::kFailed;
}

int ServerOnBus::run() {
  source_ = std::make_unique<TruthSource>(scenario_, scenario_.start(app::realtime_now()), run_id_);
  for (const auto& imu : scenario_.imus) {
    installation_.write({{SensorKind::Imu, imu.number},
                         imu.nominal_installation.lever_arm_v_m,
                         imu.nominal_installation.mounting_rpy_deg});
  }
  for (const auto& gnss : scenario_.gnss) {
    installation_.write({{SensorKind::Gnss, gnss.number}, gnss.nominal_installation.lever_arm_v_m, Vector3::Zero()});
  }
  if (!wait_until_ready()) {
    return end(app::shutdown_requested() || stop_requested_ ? RunState::Stopped : RunState::Fault, status_.message);
  }
  begin();
  const double max_lag_s = scenario_.scenario.real_time.max_lag_ms * 1e-3;
  try {
    while (source_->has_next() && !app::shutdown_requested() && !stop_requested_) {
      send_next();
      if (status_.lag_max_s > max_lag_s) {
        return end(RunState::Fault, fmt::format("a sample was {:.3f} ms late; max_lag_ms is {:g}",
                                                status_.lag_max_s * 1e3, max_lag_s * 1e3));
      }
    }
  } catch (const std::exception& error) {  // the vehicle left the domain, or its states stayed out
    return end(RunState::Fault, error.what());
  }
  return source_->has_next() ? end(RunState::Stopped, "stopped before its end") : end(RunState::Finished, "");
}

}  // namespace inslab::trajectory
