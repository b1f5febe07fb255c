#include "inslab/services/reference_nav/navigator_on_bus.hpp"

#include <spdlog/spdlog.h>

#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/last_word.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/models/navigation/app_setup.hpp"
#include "inslab/scenario/service_names.hpp"

namespace inslab::reference_nav {

using host::monotonic_now;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

/// Solutions in a message, in lockstep.
constexpr std::size_t kBlockSolutions = 32;
/// Sent at once in real time, before the readers must have them.
constexpr std::size_t kBurstSolutions = 128;

/// For a logger that was away. While it asks for them, new ones take the place of the oldest: hence so many.
dds::Topic<NavSolution> kept_solutions() {
  dds::Topic<NavSolution> topic = dds::topics::kept(dds::topics::nav());
  topic.nominal_rate_hz *= 2.0;
  return topic;
}

navigation::Navigator navigator_for(const scenario::LoadedScenario& scenario, const scenario::ReferenceNav& app) {
  const navigation::AppSetup setup = navigation::setup_for(scenario, app);
  return navigation::Navigator(setup.parameters, setup.gravity);
}

}  // namespace

NavigatorOnBus::NavigatorOnBus(service::Context& context, const scenario::ReferenceNav& app)
    : context_(context),
      app_(app),
      sources_(app),
      truth_grid_(context.scenario().truth_grid()),
      navigator_(navigator_for(context.scenario(), app)),
      run_(context.identity().run_id),
      sent_(dds::topics::nav().name, StreamDirection::Out),
      board_(context, 0,
             [this](ServiceStatus& status) {
               status.streams = {imu_.status(), gnss_.status(), sent_.status()};
               for_each_of(aids_, [&status](const auto& aid) { aid.report(status); });
               status.queue_depth_max = static_cast<std::uint32_t>(mailbox_.deepest());
             }),
      solutions_(context.participant(), kept_solutions()),
      blocks_(context.participant(), dds::topics::kept(dds::topics::block(dds::topics::nav()))),
      imu_(context, dds::topics::stream<ImuSample>(app.imu, context.scenario().sensor<catalog::Imu>(app.imu).rate.hz()),
           [this](streams::Arrived<ImuSample> arrived) { mailbox_.put(std::move(arrived)); }),
      gnss_(context,
            dds::topics::stream<GnssFix>(app.gnss, context.scenario().sensor<catalog::Gnss>(app.gnss).rate.hz()),
            [this](streams::Arrived<GnssFix> arrived) { mailbox_.put(std::move(arrived)); }),
      aids_(aids_of(scenario::AidKinds{})),
      credits_(context, dds::topics::credit(),
               [this](const Credit& credit, const dds::SampleOrigin&) {
                 const bool counts =
                     credit.topic == dds::topics::truth().name && sources_.has(credit.consumer, credit.consumer_number);
                 if (counts || credit.topic == dds::topics::service_status().name) mailbox_.put(credit);
               }),
      service_status_(context, dds::topics::service_status(),
                      [this](const ServiceStatus& status, const dds::SampleOrigin&) { mailbox_.put(status); }),
      sim_status_(context, dds::topics::sim_status(),
                  [this](const SimStatus& status, const dds::SampleOrigin&) { mailbox_.put(status); }) {}

template <class... Kind>
NavigatorOnBus::Aids NavigatorOnBus::aids_of(Types<Kind...>) {
  return Aids(AidInput<Kind>(context_, app_, [this](ArrivedOf<Kind> arrived) { mailbox_.put(std::move(arrived)); })...);
}

void NavigatorOnBus::handle(const Message& message) {
  std::visit([this](const auto& what) { handle(what); }, message);
}

void NavigatorOnBus::handle(const streams::Arrived<ImuSample>& arrived) {
  imu_.add(arrived);
  while (const auto sample = imu_.take()) {
    navigator_.add(*sample);
    board_.set_sim_time(sample->header.sim_time_ns);
  }
}

void NavigatorOnBus::handle(const streams::Arrived<GnssFix>& arrived) {
  gnss_.add(arrived);
  while (const auto fix = gnss_.take()) {
    navigator_.add(*fix);
    next_fix_ = fix->header.sequence_number + 1;
  }
}

/// Of another sensor.
template <class Arrived>
void NavigatorOnBus::handle(const Arrived& arrived) {
  std::get<AidInput<typename Arrived::Source>>(aids_).add(arrived,
                                                          [this](const auto& sample) { navigator_.add(sample); });
}

void NavigatorOnBus::handle(const SimStatus& status) {
  if (run_.hear(status, monotonic_now()) != streams::RunFollower::Heard::TheRun) return;
  sources_.all_complete_up_to(run_.is_lockstep() ? -1 : Sources::kEver);
  navigator_.fixes_complete_up_to(sources_.complete_up_to());
  board_.set_run(run_.run());
  imu_.begin_run(run_.run(), run_.clock());
  gnss_.begin_run(run_.run(), run_.clock());
  for_each_of(aids_, [this](auto& aid) { aid.begin_run(run_.run(), run_.clock()); });
}

/// What the sensors' services say when they have done.
void NavigatorOnBus::handle(const ServiceStatus& status) {
  if (status.run_id != run_.run() || (status.state != ServiceState::Finished && status.state != ServiceState::Fault)) {
    return;
  }
  sources_.complete_up_to(status.service, status.sensor_number, Sources::kEver);
  navigator_.fixes_complete_up_to(sources_.complete_up_to());
  if (status.service != catalog::Imu::service || status.sensor_number != app_.imu) return;
  for (const StreamStatus& stream : status.streams) {
    if (stream.topic == imu_.topic() && stream.direction == StreamDirection::Out) imu_sent_ = stream.samples;
  }
}

/// The sensor's service has done with the truth before this credit, and this service has every sample that came of it.
void NavigatorOnBus::handle(const Credit& credit) {
  if (run_.take(credit)) return;
  if (!run_.is_lockstep() || credit.run_id != run_.run() || credit.next_sequence == 0) return;
  sources_.complete_up_to(credit.consumer, credit.consumer_number, truth_grid_.at(credit.next_sequence - 1).count());
  navigator_.fixes_complete_up_to(sources_.complete_up_to());
}

void NavigatorOnBus::navigate() {
  while (const auto step = navigator_.step()) {
    board_.enter(ServiceState::Running);
    next_imu_ = step->imu_sequence + 1;
    run_.note_sample(monotonic_now());
    if (step->solution) publish(*step->solution);
  }
  flush_block();
  if (mailbox_.empty()) burst_ = 0;
  const std::string& why = navigator_.filter().alignment_refusal();
  if (refusals_.note(why)) spdlog::warn("aligns anew: {}; not said again", why);
}

void NavigatorOnBus::publish(const NavSolution& solution) {
  sent_.sent();
  if (!run_.is_lockstep()) {
    if (!solutions_.write(solution)) spdlog::warn("a solution could not be sent");
    // One that was stopped, and catches up, must not overrun the readers' buffers: each hole costs them dearly.
    if (++burst_ % kBurstSolutions == 0) solutions_.wait_for_acknowledgments(milliseconds(50));
    return;
  }
  gathered_.samples.push_back(solution);
  if (gathered_.samples.size() == kBlockSolutions) flush_block();
}

void NavigatorOnBus::flush_block() {
  if (gathered_.samples.empty()) return;
  if (!blocks_.write(gathered_)) spdlog::warn("a block of solutions could not be sent");
  gathered_.samples.clear();
}

/// What this service waits for before it is ready; empty when nothing.
std::string NavigatorOnBus::missing() const {
  if (sim_status_.matched_writers() == 0) return "waits for the trajectory server";
  if (!imu_.matched()) return "waits for a writer of " + imu_.topic();
  if (!gnss_.matched()) return "waits for a writer of " + gnss_.topic();
  std::string aid_is_missing;
  for_each_of(aids_, [&](const auto& aid) {
    if (aid_is_missing.empty()) aid_is_missing = aid.missing();
  });
  if (!aid_is_missing.empty()) return aid_is_missing;
  return solutions_.matched_readers() > 0 && blocks_.matched_readers() > 0 ? "" : "waits for the logger";
}

bool NavigatorOnBus::finished() const {
  if (!run_.has_ended()) return false;
  // What has not come some seconds after the end will not come.
  return (imu_sent_ && next_imu_ >= *imu_sent_) || run_.ended_before(seconds(5), monotonic_now());
}

int NavigatorOnBus::run() {
  while (!grace_.must_stop(run_.has_begun()) && !finished()) {
    if (const auto message = mailbox_.take(milliseconds(50))) handle(*message);
    navigate();
    imu_.tick(next_imu_);
    gnss_.tick(next_fix_);
    for_each_of(aids_, [](auto& aid) { aid.tick(); });
    if (board_.state() == ServiceState::Starting) {
      const std::string waits_for = missing();
      board_.enter(waits_for.empty() ? ServiceState::Ready : ServiceState::Starting, waits_for);
    }
    board_.tick();
  }
  return end();
}

void NavigatorOnBus::stay_for_the_log() {
  while (next_imu_ > 0 && run_.stays_for_the_log(monotonic_now()) && !host::shutdown_requested()) {
    const auto message = mailbox_.take(milliseconds(50));
    if (message && std::holds_alternative<Credit>(*message)) handle(*message);
    board_.tick();
    if (!run_.tells_the_wait(monotonic_now())) continue;
    spdlog::info("waits until the logger has closed its log, at most {} s",
                 std::chrono::duration_cast<seconds>(streams::kTimeToComeBack).count());
  }
}

int NavigatorOnBus::end() {
  const auto& counts = navigator_.filter().counts();
  spdlog::info("{} solutions; fixes not used {}, too old {}; IMU samples not valid {}, gaps {}; begun anew {} times",
               sent_.samples(), counts.fixes_not_used, counts.fixes_too_old, counts.imu_not_valid, counts.imu_gaps,
               counts.restarts);
  solutions_.wait_for_acknowledgments(seconds(2));
  blocks_.wait_for_acknowledgments(seconds(2));
  const bool by_signal = host::shutdown_requested() && !run_.has_ended();
  std::string failure;
  if (!run_.fault().empty()) {
    failure = "the run ended as a fault: " + run_.fault();
  } else if (by_signal && run_.has_begun()) {
    failure = scenario::kEndedBySignal;
  } else if (!by_signal && (!imu_sent_ || next_imu_ < *imu_sent_)) {
    failure = "IMU samples are missing";
  }
  if (!failure.empty()) spdlog::error("{}", failure);
  board_.enter(failure.empty() ? ServiceState::Finished : ServiceState::Fault,
               failure.empty() && by_signal ? "ended by a signal before a run" : failure);
  board_.flush(seconds(2));
  stay_for_the_log();
  return host::after_the_last_word(failure.empty() && context_.writers().fault().empty() ? host::kOk : host::kFailed);
}

}  // namespace inslab::reference_nav
