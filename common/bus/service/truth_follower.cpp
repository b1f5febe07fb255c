#include "inslab/bus/service/truth_follower.hpp"

#include <spdlog/spdlog.h>

#include "inslab/data/catalog/profile_rules.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/last_word.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/scenario/service_names.hpp"

namespace inslab::service {

using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

/// Lets callbacks serve as long as it lives; made and ended by who has the turn.
class ServesAtOnce {
 public:
  explicit ServesAtOnce(bool& flag) : flag_(flag) { flag_ = true; }
  ~ServesAtOnce() { flag_ = false; }
  ServesAtOnce(const ServesAtOnce&) = delete;
  ServesAtOnce& operator=(const ServesAtOnce&) = delete;

 private:
  bool& flag_;
};

}  // namespace

TruthFollower::TruthFollower(Context& context, std::uint32_t sensor_number, TruthConsumer& consumer)
    : context_(context),
      service_(context.service()),
      sensor_number_(sensor_number),
      consumer_(consumer),
      run_(context.identity().run_id),
      truth_(dds::topics::truth().name),
      checkpoint_(context),
      board_(context, sensor_number,
             [this](ServiceStatus& status) {
               status.streams.push_back(truth_.monitor().status());
               status.queue_depth_max = static_cast<std::uint32_t>(mailbox_.deepest());
               consumer_.report(status);
             }),
      credits_(context.participant(), dds::topics::credit()),
      status_reader_(context, dds::topics::sim_status(),
                     [this](const SimStatus& status, const dds::SampleOrigin&) { mailbox_.put(status); }),
      credit_reader_(context, dds::topics::credit(),
                     [this](const Credit& credit, const dds::SampleOrigin&) {
                       if (credit.topic != dds::topics::truth().name) mailbox_.put(credit);
                     }),
      truth_reader_(context, dds::topics::truth(context.scenario().scenario.truth_rate_hz),
                    [this](const TruthState& state, const dds::SampleOrigin&) {
                      hear({{state}, host::realtime_now().count()});
                    }),
      block_reader_(context, dds::topics::block(dds::topics::truth(context.scenario().scenario.truth_rate_hz)),
                    [this](const Block<TruthState>& block, const dds::SampleOrigin&) {
                      mailbox_.put(streams::Arrived<TruthState>{block.samples, host::realtime_now().count()});
                    }) {
  for_each(catalog::ProfileKinds{},
           [this, &context](auto profile) { read_journal<typename decltype(profile)::type>(context); });
  if (const std::string topic = consumer_.paced_by_nav_app(); !topic.empty()) {
    nav_reader_ = std::make_unique<dds::OpenReader<NavSolution>>(
        context.participant(), dds::topics::nav(),
        context.writers().only_the_app(dds::topics::nav().name, context.scenario().scenario.reference_nav.has_value(),
                                       [this, topic](const NavSolution& solution, const dds::SampleOrigin&) {
                                         Credit credit;
                                         credit.consumer = scenario::kNavApp;
                                         credit.topic = topic;
                                         credit.next_sequence = solution.imu_sequence + 1;
                                         mailbox_.put(credit);
                                       }));
  }
}

template <class Profile>
void TruthFollower::read_journal(Context& context) {
  auto reader = std::make_shared<SetReader<Profile>>(
      context, dds::topics::journal<Profile>(),
      [this](const Profile& entry, const dds::SampleOrigin&) { mailbox_.put(catalog::AnyProfile(entry)); });
  journal_readers_.push_back({reader, [reader] { return reader->matched_writers() > 0; }});
}

/// What this service waits for before it is ready; empty when nothing.
std::string TruthFollower::missing() const {
  for (const JournalReader& journal : journal_readers_) {
    if (!journal.matched()) return "waits for the trajectory server";
  }
  if (truth_reader_.matched_writers() == 0 || block_reader_.matched_writers() == 0 ||
      status_reader_.matched_writers() == 0) {
    return "waits for the trajectory server";
  }
  if (nav_reader_ && nav_reader_->matched_writers() == 0)
    return std::string(scenario::kWaitsForApp) + "a writer of inslab/nav";
  return consumer_.missing_readers();
}

void TruthFollower::hear(streams::Arrived<TruthState> arrived) {
  if (!serve_at_once(arrived)) mailbox_.put(std::move(arrived));
}

/// False when the worker must do it: it has the turn, something came before, the sample is not the next one, or (in
/// lockstep) serving it could wait for acknowledgements that this thread would have to take.
bool TruthFollower::serve_at_once(const streams::Arrived<TruthState>& arrived) {
  const std::unique_lock<std::mutex> turn(turn_, std::try_to_lock);
  if (!turn || !serves_at_once_ || failure_ || run_.is_lockstep() || board_.state() != ServiceState::Running)
    return false;
  if (!truth_.empty() || !mailbox_.empty() || arrived.samples.front().header.sequence_number != truth_.next())
    return false;
  try {
    burst_ = 0;  // who is this near has no burst to pace
    add_truth(arrived);
    process_pending();
  } catch (...) {
    failure_ = std::current_exception();
    mailbox_.put(streams::Arrived<TruthState>{});  // wakes the worker
  }
  return true;
}

void TruthFollower::handle(Message message) {
  if (const auto* arrived = std::get_if<streams::Arrived<TruthState>>(&message)) {
    add_truth(*arrived);
  } else if (const auto* entry = std::get_if<catalog::AnyProfile>(&message)) {
    obey(*entry);
    waiting_since_ = host::monotonic_now();
  } else if (auto* credit = std::get_if<Credit>(&message)) {
    if (credit->consumer == scenario::kNavApp) credit->run_id = run_.run();
    if (!run_.take(*credit)) consumer_.take(*credit);
  } else {
    handle(std::get<SimStatus>(message));
  }
}

/// An entry is judged where it is obeyed too: whoever wrote it, what breaks a rule never reaches a model.
void TruthFollower::obey(const catalog::AnyProfile& entry) {
  const auto broken = catalog::broken_rule(entry);
  if (!broken) return consumer_.add(entry);
  context_.writers().note_fault("entry " + std::to_string(catalog::request_of(entry).journal_number) +
                                " of the journal is not obeyed: " + broken->path + ": " + broken->reason);
}

void TruthFollower::handle(const SimStatus& status) {
  if (run_.hear(status, host::monotonic_now()) == streams::RunFollower::Heard::TheRun) begin_run();
}

void TruthFollower::begin_run() {
  board_.set_run(run_.run());
  checkpoint_.begin(run_.run());
  consumer_.begin_run(run_.run(), run_.clock());
  truth_.begin_run(run_.run(), streams::demand_of_truth(run_.clock()), host::monotonic_now());
  if (!resume()) {
    checkpoint_.keep(checkpoint());
  } else if (run_.has_begun()) {
    board_.enter(ServiceState::Running);
  }
}

/// Goes on where a process before this one stopped in the same run. False when there was none.
bool TruthFollower::resume() {
  std::uint64_t next = 0;
  const auto head = checkpoint_.resume([&](state::StateReader& reader) {
    reader(next);
    consumer_.load(reader);
  });
  if (!head) return false;
  truth_.go_on(next);
  delivered_ = next;
  resumed_at_ = host::monotonic_now();
  if (next > 0) run_.note_sample(host::monotonic_now());
  spdlog::warn("goes on with truth sample {}, {:.3f} s after the last sign of life", next,
               time::to_seconds(host::realtime_now().count() - head->kept_realtime_ns));
  return true;
}

std::vector<std::uint8_t> TruthFollower::checkpoint() const {
  return checkpoint_.state([this](state::StateWriter& writer) {
    writer(truth_.next());
    consumer_.save(writer);
  });
}

void TruthFollower::add_truth(const streams::Arrived<TruthState>& arrived) {
  if (arrived.samples.empty()) return;
  if (truth_.empty()) waiting_since_ = host::monotonic_now();
  truth_.add(arrived, host::monotonic_now());
  board_.enter(ServiceState::Running);
}

/// What a process that was started again sends before it knows its readers never reaches them.
bool TruthFollower::readers_are_back() {
  constexpr time::Nanoseconds kPatience = seconds(3);
  if (resumed_at_ == time::Nanoseconds(0)) return true;
  if (!consumer_.missing_readers().empty() && host::monotonic_now() - resumed_at_ < kPatience) return false;
  resumed_at_ = time::Nanoseconds(0);
  return true;
}

bool TruthFollower::can_process() {
  const auto* front = truth_.front(host::monotonic_now());
  return front != nullptr && consumer_.ready_for(front->sample) && consumer_.has_room() && readers_are_back();
}

/// A writer keeps about a second of its stream for readers that lag. A process that catches up with more than that, in
/// real time, waits now and then until they have what it sent; one that is gone must not keep it for long.
void TruthFollower::pace_the_burst() {
  constexpr std::uint64_t kSamples = 128;
  constexpr time::Nanoseconds kPatience = milliseconds(50);
  burst_ = truth_.empty() && mailbox_.empty() ? 0 : burst_ + 1;
  if (burst_ % kSamples == kSamples - 1) consumer_.flush(host::monotonic_now() + kPatience);
}

void TruthFollower::process_pending() {
  while (can_process()) {
    const auto& front = *truth_.front(host::monotonic_now());
    board_.set_sim_time(front.sample.header.sim_time_ns);
    consumer_.process(front.sample);
    const bool ends_block = front.ends_message;
    truth_.pop();
    run_.note_sample(host::monotonic_now());
    waiting_since_ = host::monotonic_now();
    stalled_ = false;
    if (!run_.is_lockstep()) {
      checkpoint_.keep(checkpoint());
      pace_the_burst();
    } else if (ends_block) {
      consumer_.flush_blocks();
      marks_.push_back({truth_.next(), consumer_.outputs_end(), checkpoint()});
    }
  }
  if (run_.is_lockstep() && !consumer_.has_room()) consumer_.flush_blocks();
}

/// In lockstep: what everybody has by now needs no truth again.
void TruthFollower::deliver() {
  auto undelivered = marks_.begin();
  while (undelivered != marks_.end() && consumer_.outputs_delivered(undelivered->outputs_end)) ++undelivered;
  const bool moved = undelivered != marks_.begin();
  if (moved) {
    delivered_ = std::prev(undelivered)->truth_end;
    checkpoint_.keep(std::prev(undelivered)->checkpoint);
    marks_.erase(marks_.begin(), undelivered);
  }
  give_credit(moved);
}

/// Asks for truth that was sent and has not come, and says how far this service is.
void TruthFollower::give_credit(bool moved) {
  streams::Receiver<TruthState>::Consumer consumer;
  consumer.moved = moved;
  consumer.has_work = !marks_.empty();
  if (run_.has_ended()) consumer.sent = run_.truth_samples();
  const auto ask = truth_.look(consumer, host::monotonic_now());
  if (!ask) return;
  Credit credit;
  credit.run_id = run_.run();
  credit.consumer = service_;
  credit.consumer_number = sensor_number_;
  credit.topic = dds::topics::truth().name;
  // What lies between the two is needed again if this process is killed before its outputs are delivered.
  credit.next_sequence = run_.is_lockstep() ? delivered_ : truth_.next();
  credit.resend = ask->resend;
  if (!credits_.write(credit)) spdlog::warn("a credit could not be sent");
}

void TruthFollower::watch_the_journal() {
  const auto* front = truth_.front(host::monotonic_now());
  if (front == nullptr || stalled_ || host::monotonic_now() - waiting_since_ < seconds(2)) return;
  if (consumer_.ready_for(front->sample)) return;
  stalled_ = true;  // until it is processed
  board_.enter(board_.state(), "waits for entries of the journal that the truth says are in effect");
  spdlog::error("waits for the journal: truth sample {} needs {} entries", front->sample.header.sequence_number,
                front->sample.journal_in_effect);
}

/// What was asked for again and again and does not come is no longer kept: without it there is no going on. Empty when
/// nothing is lost.
std::string TruthFollower::lost() const {
  if (const auto lost = truth_.lost(host::monotonic_now())) {
    return "truth samples " + std::to_string(lost->first) + " to " + std::to_string(lost->second) +
           " cannot be had: there is no checkpoint of this run to go on from, or it is too old";
  }
  const auto* front = truth_.front(host::monotonic_now());
  if (stalled_ && front != nullptr && host::monotonic_now() - waiting_since_ > seconds(8)) {
    return "truth sample " + std::to_string(truth_.next()) + " needs " +
           std::to_string(front->sample.journal_in_effect) + " entries of the journal, and some of them cannot be had";
  }
  return "";
}

bool TruthFollower::finished() const {
  if (!run_.has_ended()) return false;
  // What has not come some seconds after the end, asked for again and again, will not come. A logger that is killed at
  // the end asks for what it lacks when it is back.
  const bool logged = consumer_.outputs_logged() || run_.log_is_closed();
  const bool delivered = run_.is_lockstep() ? marks_.empty() : logged;
  return (truth_.next() >= run_.truth_samples() && delivered) ||
         run_.ended_before(logged ? time::Nanoseconds(seconds(8)) : streams::kTimeToComeBack, host::monotonic_now());
}

void TruthFollower::tell_the_wait() {
  if (!run_.tells_the_wait(host::monotonic_now())) return;
  spdlog::info("waits until the logger has closed its log, at most {} s",
               std::chrono::duration_cast<seconds>(streams::kTimeToComeBack).count());
}

/// One that was told to end, and one that has left the run before its end, have no time for that.
void TruthFollower::stay_for_the_log() {
  while (truth_.next() > 0 && run_.stays_for_the_log(host::monotonic_now()) && !host::shutdown_requested()) {
    auto message = mailbox_.take(milliseconds(50));
    if (message && std::holds_alternative<Credit>(*message)) handle(std::move(*message));
    tell_the_wait();
    board_.tick();
  }
}

int TruthFollower::run() {
  try {
    return follow();
  } catch (const std::exception& error) {
    return fail(error.what());
  }
}

/// Leaves the run, and says why: others must not wait for what does not come.
int TruthFollower::fail(const std::string& reason) {
  spdlog::error("{}", reason);
  board_.enter(ServiceState::Fault, reason);
  board_.flush(seconds(2));
  return host::after_the_last_word(host::kFailed);
}

int TruthFollower::follow() {
  std::unique_lock<std::mutex> turn(turn_);
  const ServesAtOnce serves_at_once(serves_at_once_);
  while (!grace_.must_stop(run_.has_begun()) && !finished()) {
    turn.unlock();
    auto message = mailbox_.take(milliseconds(50));
    turn.lock();
    if (failure_) std::rethrow_exception(failure_);
    if (message) handle(std::move(*message));
    process_pending();
    deliver();
    watch_the_journal();
    if (const std::string reason = lost(); !reason.empty()) return fail(reason);
    if (board_.state() == ServiceState::Starting) {
      const std::string waits_for = missing();
      board_.enter(waits_for.empty() ? ServiceState::Ready : ServiceState::Starting, waits_for);
    }
    tell_the_wait();
    board_.tick();
  }
  return end();
}

int TruthFollower::end() {
  consumer_.flush_blocks();
  if (run_.has_ended()) consumer_.end_run(run_.run());
  consumer_.flush(host::monotonic_now() + seconds(2));
  const bool complete =
      run_.has_ended() && run_.fault().empty() && mailbox_.dropped() == 0 && truth_.next() == run_.truth_samples();
  const bool left_no_run = host::shutdown_requested() && !run_.has_begun();
  if (left_no_run) {
    board_.enter(ServiceState::Finished, "ended by a signal before a run");
  } else if (host::shutdown_requested() && !run_.has_ended()) {
    const std::string reason =
        std::string(scenario::kEndedBySignal) + ", after truth sample " + std::to_string(truth_.next());
    board_.enter(ServiceState::Fault, reason);
    spdlog::error("{}: what follows of this run is missing", reason);
  } else if (!run_.fault().empty()) {
    board_.enter(ServiceState::Fault, "the run ended as a fault: " + run_.fault());
    spdlog::error("the run ended as a fault: {}", run_.fault());
  } else if (!complete) {
    board_.enter(ServiceState::Fault, "truth samples are missing");
    spdlog::error("{} of {} truth samples came", truth_.monitor().samples(), run_.truth_samples());
  } else {
    board_.enter(ServiceState::Finished);
  }
  board_.flush(seconds(2));
  stay_for_the_log();
  checkpoint_.forget();
  const bool good = (complete && context_.writers().fault().empty()) || left_no_run;
  return host::after_the_last_word(good ? host::kOk : host::kFailed);
}

}  // namespace inslab::service
