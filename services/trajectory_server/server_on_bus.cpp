#include "inslab/services/trajectory_server/server_on_bus.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "inslab/data/streams/stamp.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/last_word.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/scenario/service_names.hpp"

namespace inslab::trajectory_server {

using host::monotonic_now;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

/// Enough truth for a service that is started again to catch up: half a minute, within bounds.
std::size_t truth_kept(const scenario::LoadedScenario& scenario) {
  constexpr double kKept_s = 30.0;
  return static_cast<std::size_t>(std::clamp(scenario.truth_grid().hz() * kKept_s, 1000.0, 30'000.0));
}

}  // namespace

ServerOnBus::ServerOnBus(service::Context& context)
    : context_(context),
      scenario_(context.scenario()),
      shortest_period_s_(scenario_.truth_grid().shortest_period_s()),
      run_id_(context.identity().run_id == RunId{} ? host::random_run_id() : context.identity().run_id),
      others_(run_id_),
      run_(run_id_),
      control_(scenario_.scenario.clock.mode, scenario_.scenario.clock.start_paused),
      clock_(time::Nanoseconds(0), scenario_.scenario.clock.rate),
      truth_(context, dds::topics::truth(scenario_.truth_grid().hz()),
             {scenario::truth_consumers(scenario_), false, 2 * service::StreamOutput<TruthState>::kWindowSamples,
              truth_kept(scenario_)}),
      board_(context, 0,
             [this](ServiceStatus& status) {
               status.streams.push_back(truth_.status());
               if (vehicle_ && source_) vehicle_->fill(status, *source_->vehicle_link());
               status.overruns = status_.overruns;
               status.queue_depth_max = static_cast<std::uint32_t>(mailbox_.deepest());
             }),
      sim_status_(context.participant(), dds::topics::sim_status()),
      installation_(context.participant(), dds::topics::installation()),
      time_mark_(context.participant(), dds::topics::time_mark()),
      acks_(context.participant(), dds::topics::profile_ack()),
      commands_(context.participant(), dds::topics::sim_command(),
                [this](const SimCommand& command, const dds::SampleOrigin&) { mailbox_.put(command); }),
      service_status_(context, dds::topics::service_status(),
                      [this](const ServiceStatus& status, const dds::SampleOrigin&) { mailbox_.put(status); }),
      credits_(context, dds::topics::credit(), [this](const Credit& credit, const dds::SampleOrigin&) {
        if (credit.topic == truth_.topic() || credit.topic == catalog::kServiceStatus.name) mailbox_.put(credit);
      }) {
  for_each(catalog::ProfileKinds{}, [this, &context](auto profile) {
    open_profile_topics<typename decltype(profile)::type>(context.participant());
  });
  if (scenario_.scenario.trajectory.source == scenario::TrajectorySource::VehicleState) {
    vehicle_ = std::make_unique<VehicleOnBus>(context, scenario_.scenario.trajectory.vehicle,
                                              [this](const VehicleState& state) { mailbox_.put(state); });
  }
  status_.run_id = run_id_;
  status_.scenario = scenario_.scenario.name;
  status_.clock = scenario_.scenario.clock.mode;
  status_.rate = clock_.rate();
  truth_.begin_run(run_id_, status_.clock);
  board_.set_run(run_id_);
}

template <class Profile>
void ServerOnBus::open_profile_topics(dds::Participant& participant) {
  auto journal = std::make_shared<dds::Writer<Profile>>(participant, dds::topics::journal<Profile>());
  write_journal_[Profile::kind] = [journal](const catalog::AnyProfile& entry) {
    if (!journal->write(std::get<Profile>(entry))) spdlog::error("a journal entry could not be sent");
  };
  entities_.push_back(journal);
  entities_.push_back(std::make_shared<dds::OpenReader<Profile>>(
      participant, dds::topics::request<Profile>(),
      [this](const Profile& request, const dds::SampleOrigin&) { mailbox_.put(catalog::AnyProfile(request)); }));
}

void ServerOnBus::judge(const catalog::AnyProfile& request) {
  auto verdict = has_ended(status_.state) ? sim::rejected(request, "request.apply_at_ns", "the run has ended")
                                          : source_->submit(request);
  if (const auto* entry = std::get_if<catalog::AnyProfile>(&verdict)) {
    write_journal_[catalog::kind_of(*entry)](*entry);
    status_.journal_entries = source_->journal_size();
    spdlog::info("journal {}: {} '{}' for {} from {:.3f} s on", catalog::request_of(*entry).journal_number,
                 enum_name(catalog::kind_of(*entry)), catalog::name_of(*entry),
                 catalog::sensor_name(catalog::target_of(*entry)),
                 time::to_seconds(catalog::request_of(*entry).apply_at_ns));
    return;
  }
  auto& rejection = std::get<ProfileAck>(verdict);
  rejection.run_id = run_id_;
  rejection.service = context_.service();
  acks_.write(rejection);
  spdlog::warn("rejected {} for {}: {}: {}", enum_name(rejection.kind), catalog::sensor_name(rejection.target),
               rejection.field, rejection.reason);
}

/// What became of a command stands in the status at once.
void ServerOnBus::obey(const SimCommand& command) {
  const sim::RunControl::Verdict verdict = control_.judge(command, source_->taken());
  status_.last_command_id = command.request_id;
  status_.last_command_refusal = verdict.refusal;
  if (!verdict.refusal.empty()) spdlog::warn("refused {}: {}", enum_name(command.kind), verdict.refusal);
  if (verdict.rate) {
    clock_.set_rate(monotonic_now(), *verdict.rate);
    status_.rate = *verdict.rate;
  }
  if (verdict.pace_changed && status_.state != RunState::Waiting && !control_.paused() && source_->taken() == 0) {
    begin();  // held at its start it begins only now, and may be asked to do so on a whole second
  } else if (verdict.pace_changed && status_.state != RunState::Waiting) {
    control_.paused() ? clock_.pause(monotonic_now()) : clock_.resume(monotonic_now());
    status_.state = control_.paused() ? RunState::Paused : RunState::Running;
    truth_.flush_block();
  }
  next_report_ = time::Nanoseconds(0);
  report_status();
}

/// Takes what has arrived; waits up to `patience` for the first.
void ServerOnBus::handle_messages(time::Nanoseconds patience) {
  for (auto message = mailbox_.take(patience); message; message = mailbox_.take(time::Nanoseconds(0))) {
    if (const auto* request = std::get_if<catalog::AnyProfile>(&*message)) {
      judge(*request);
    } else if (const auto* command = std::get_if<SimCommand>(&*message)) {
      obey(*command);
    } else if (const auto* credit = std::get_if<Credit>(&*message)) {
      if (!run_.take(*credit)) truth_.take(*credit);
    } else if (const auto* state = std::get_if<VehicleState>(&*message)) {
      // Before the run there is no time that a state could be of.
      if (status_.state == RunState::Running) vehicle_->take(*state, *source_);
    } else {
      const auto& status = std::get<ServiceStatus>(*message);
      others_.hear(status, monotonic_now());
      const bool is_fault = status.state == ServiceState::Fault && status.run_id == run_id_;
      fault_heard_ = fault_heard_ || is_fault;
      services_[{status.service, status.sensor_number}] = {status.state, status.message, is_fault};
    }
  }
}

void ServerOnBus::begin() {
  host::use_precise_timers();
  // Sim time 0 lies a little ahead, so that the first deadlines are met too.
  const time::Nanoseconds realtime = host::realtime_now();
  // An app whose answers pace the run must be heard from its first one on: it may know our readers a little later than
  // we know its writer.
  time::Nanoseconds zero = monotonic_now() + milliseconds(scenario_.scenario.require_nav_app ? 500 : 100);
  if (scenario_.scenario.clock.whole_second_start) {
    const time::Nanoseconds into_second = realtime % seconds(1);
    zero = monotonic_now() + seconds(1) - into_second + (into_second > milliseconds(900) ? seconds(1) : seconds(0));
  }
  clock_ = sim::RunClock(zero, clock_.rate());
  if (control_.paused()) clock_.pause(zero);
  status_.state = control_.paused() ? RunState::Paused : RunState::Running;
  next_report_ = time::Nanoseconds(0);
  report_status();
  board_.enter(ServiceState::Running);
}

void ServerOnBus::wait_paused() {
  handle_messages(milliseconds(20));
  report_status();
  board_.tick();
}

void ServerOnBus::send(TruthState& sample) {
  truth_.put(sample);
  status_.sim_time_ns = sample.header.sim_time_ns;
  status_.truth_samples = source_->taken();
  board_.set_sim_time(sample.header.sim_time_ns);
  if (control_.note_sent(source_->taken())) {
    clock_.pause(monotonic_now());
    status_.state = RunState::Paused;
    truth_.flush_block();
    next_report_ = time::Nanoseconds(0);
  }
}

void ServerOnBus::send_at_deadline() {
  // A long wait is cut, so that a command or a signal is heard during it.
  constexpr time::Nanoseconds kLongestSleep = milliseconds(50);
  const time::Nanoseconds deadline = clock_.deadline(source_->next_time());
  if (deadline - monotonic_now() > kLongestSleep) {
    handle_messages(kLongestSleep / 2);
    report_status();
    board_.tick();
    return;
  }
  host::sleep_until(deadline);
  handle_messages(time::Nanoseconds(0));
  if (control_.paused() || clock_.deadline(source_->next_time()) > monotonic_now()) return;  // a command moved it
  TruthState sample = source_->take();
  const time::Nanoseconds late = monotonic_now() - clock_.deadline(time::Nanoseconds(sample.header.sim_time_ns));
  sample.header.published_late = time::to_seconds(late) > shortest_period_s_ / clock_.rate();
  if (sample.header.published_late) ++status_.overruns;
  status_.lag_max_s = std::max(status_.lag_max_s, time::to_seconds(late));
  send(sample);
  if (sample.header.sim_time_ns >= static_cast<std::int64_t>(time_marks_) * 1'000'000'000) send_time_mark();
  report_status();
  board_.tick();
  source_->prepare();
}

/// Blocks end where something else happens: at an epoch of a receiver, where a swap takes effect, at the end.
bool ServerOnBus::ends_block(const TruthState& sample) const {
  if (!source_->has_next() || source_->is_swap_time(time::Nanoseconds(sample.header.sim_time_ns))) return true;
  return std::any_of(scenario_.gnss.begin(), scenario_.gnss.end(), [&sample](const auto& gnss) {
    return gnss.rate.contains(time::Nanoseconds(sample.header.sim_time_ns));
  });
}

void ServerOnBus::send_in_lockstep() {
  if (source_->taken() == 0 && monotonic_now() < clock_.deadline(time::Nanoseconds(0))) {
    handle_messages(milliseconds(5));
  } else if (!truth_.has_room()) {
    truth_.flush_block();
    handle_messages(milliseconds(20));
    watch_consumers();
  } else {
    if (blocked_since_ != time::Nanoseconds(0)) status_.message.clear();
    blocked_since_ = time::Nanoseconds(0);
    handle_messages(time::Nanoseconds(0));
    if (control_.paused()) return;
    TruthState sample = source_->take();
    send(sample);
    if (ends_block(sample)) truth_.flush_block();
  }
  report_status();
  board_.tick();
}

void ServerOnBus::send_time_mark() {
  ++time_marks_;
  TimeMark mark;
  mark.run_id = run_id_;
  const time::Nanoseconds before = monotonic_now();
  const time::Nanoseconds realtime = host::realtime_now();
  const time::Nanoseconds after = monotonic_now();
  const time::Nanoseconds sim_time = clock_.sim_time(before + (after - before) / 2);
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
  warn_of_other_versions();
  if (vehicle_ && status_.state == RunState::Running) vehicle_->report(*source_, run_id_, status_.sim_time_ns);
}

int ServerOnBus::end(RunState state, const std::string& message) {
  status_.state = state;
  say(message);
  truth_.flush_block();
  if (vehicle_) vehicle_->report(*source_, run_id_, status_.sim_time_ns);
  sim_status_.write(status_);
  const bool there_was_a_run = source_->taken() > 0;
  run_.hear(status_, monotonic_now());
  serve_stragglers(there_was_a_run ? streams::kTimeToComeBack : seconds(10));
  const time::Nanoseconds deadline = monotonic_now() + seconds(2);
  truth_.wait_for_acknowledgments(deadline);
  sim_status_.wait_for_acknowledgments(service::time_left(deadline));
  if (vehicle_) vehicle_->flush(seconds(5));
  const bool good = state != RunState::Fault && context_.writers().fault().empty();
  board_.enter(good ? ServiceState::Finished : ServiceState::Fault, message);
  board_.flush(seconds(2));
  if (there_was_a_run) stay_for_the_log();
  spdlog::info("{}: {} truth samples, {} overruns, largest lag {:.3f} ms{}", enum_name(state), source_->taken(),
               status_.overruns, status_.lag_max_s * 1e3, message.empty() ? "" : ": " + message);
  return host::after_the_last_word(good ? host::kOk : host::kFailed);
}

int ServerOnBus::run() {
  source_ = std::make_unique<sim::TruthSource>(scenario_, scenario_.start(host::realtime_now()), run_id_);
  for_each_sensor(scenario_, [this](auto tag, const auto& sensor) {
    using Kind = typename decltype(tag)::type;
    const InstallationProfile& nominal = sensor.nominal_installation;
    const Vector3 rpy_deg = Kind::has_axes ? nominal.mounting_rpy_deg : Vector3::Zero();
    installation_.write({{Kind::kind, sensor.number}, nominal.lever_arm_v_m, rpy_deg, nominal.second_lever_arm_v_m});
  });
  if (!wait_until_ready()) {
    if (const auto exit_code = end_run_without_server()) return *exit_code;
    if (!host::shutdown_requested() && !control_.stop_requested()) return end(RunState::Fault, status_.message);
    return end(RunState::Stopped, "stopped while it waited for " + missing_peers());
  }
  begin();
  try {
    return run_to_end();
  } catch (const std::exception& error) {  // the vehicle left the domain, or its states stayed out
    return end(RunState::Fault, error.what());
  }
}

int ServerOnBus::run_to_end() {
  const double max_lag_s = scenario_.scenario.clock.max_lag_ms * 1e-3;
  while (source_->has_next() && !host::shutdown_requested() && !control_.stop_requested()) {
    if (control_.paused()) {
      wait_paused();
    } else if (status_.clock == ClockMode::Lockstep) {
      send_in_lockstep();
    } else {
      send_at_deadline();
    }
    if (const std::string fault = fault_of_a_service(); !fault.empty()) return end(RunState::Fault, fault);
    if (status_.lag_max_s > max_lag_s) {
      return end(RunState::Fault,
                 fmt::format("a sample was {:.3f} ms late, more than the scenario's clock.max_lag_ms of {:g}: the "
                             "machine is too busy or the limit too tight",
                             status_.lag_max_s * 1e3, max_lag_s * 1e3));
    }
  }
  return source_->has_next() ? end(RunState::Stopped, "stopped before its end") : end(RunState::Finished, "");
}

}  // namespace inslab::trajectory_server
