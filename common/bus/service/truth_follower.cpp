#include "inslab/bus/service/truth_follower.hpp"

#include <spdlog/spdlog.h>

#include "inslab/data/catalog/profile_rules.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/last_word.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/scenario/service_names.hpp"

namespace inslab::service {

using std::chrono::milliseconds;
using std::chrono::seconds;

TruthFollower::TruthFollower(Context& context, std::uint32_t sensor_number, TruthConsumer& consumer)
    : context_(context),
      service_(context.service()),
      sensor_number_(sensor_number),
      consumer_(consumer),
      truth_monitor_(dds::topics::truth().name, StreamDirection::In),
      checkpoint_(context),
      board_(context, sensor_number,
             [this](ServiceStatus& status) {
               status.streams.push_back(truth_monitor_.status());
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
                      mailbox_.put(Arrived{{state}, host::realtime_now().count()});
                    }),
      block_reader_(context, dds::topics::block(dds::topics::truth(context.scenario().scenario.truth_rate_hz)),
                    [this](const Block<TruthState>& block, const dds::SampleOrigin&) {
                      mailbox_.put(Arrived{block.samples, host::realtime_now().count()});
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

void TruthFollower::handle(Message message) {
  if (const auto* arrived = std::get_if<Arrived>(&message)) {
    add_truth(*arrived);
  } else if (const auto* entry = std::get_if<catalog::AnyProfile>(&message)) {
    obey(*entry);
    waiting_since_ = host::monotonic_now();
  } else if (auto* credit = std::get_if<Credit>(&message)) {
    if (credit->consumer == scenario::kNavApp) credit->run_id = run_id_;
    if (!log_word_.take(*credit)) consumer_.take(*credit);
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
  if (!context_.obeys(status.run_id)) return;
  // Once a run has begun this process serves no other: a second trajectory server must not turn its head.
  if (status.run_id != run_id_ && run_began_) return;
  if (status.run_id != run_id_) begin_run(status);
  run_began_ = run_began_ || next_ > 0 || status.state != RunState::Waiting;
  if (!has_ended(status.state)) return;
  run_ended_ = true;
  run_ended_at_ = host::monotonic_now();
  truth_samples_of_run_ = status.truth_samples;
  if (status.state == RunState::Fault) fault_ = status.message;
}

void TruthFollower::begin_run(const SimStatus& status) {
  run_id_ = status.run_id;
  clock_ = status.clock;
  board_.set_run(run_id_);
  checkpoint_.begin(run_id_);
  consumer_.begin_run(run_id_, clock_);
  if (!resume()) {
    checkpoint_.keep(checkpoint());
  } else if (status.state != RunState::Waiting) {
    board_.enter(ServiceState::Running);
  }
  give_credit(true);
}

/// Goes on where a process before this one stopped in the same run. False when there was none.
bool TruthFollower::resume() {
  const auto head = checkpoint_.resume([this](state::StateReader& reader) {
    reader(next_);
    consumer_.load(reader);
  });
  if (!head) return false;
  delivered_ = next_;
  resumed_at_ = host::monotonic_now();
  truth_monitor_.go_on(run_id_, next_, next_);
  spdlog::warn("goes on with truth sample {}, {:.3f} s after the last sign of life", next_,
               static_cast<double>(host::realtime_now().count() - head->kept_realtime_ns) * 1e-9);
  return true;
}

std::vector<std::uint8_t> TruthFollower::checkpoint() const {
  return checkpoint_.state([this](state::StateWriter& writer) {
    writer(next_);
    consumer_.save(writer);
  });
}

void TruthFollower::add_truth(const Arrived& arrived) {
  if (arrived.samples.empty()) return;
  if (pending_.empty()) waiting_since_ = host::monotonic_now();
  for (const TruthState& state : arrived.samples) {
    if (state.header.run_id != run_id_) continue;  // its status has not come yet: it will be asked for again
    truth_monitor_.received(state.header, arrived.received_realtime_ns);
    const std::uint64_t sequence = state.header.sequence_number;
    if (sequence >= next_) pending_.insert_or_assign(sequence, Pending{state, &state == &arrived.samples.back()});
  }
  truth_came_at_ = host::monotonic_now();
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
  return !pending_.empty() && pending_.begin()->first == next_ && consumer_.ready_for(pending_.begin()->second.state) &&
         consumer_.has_room() && readers_are_back();
}

/// A writer keeps about a second of its stream for readers that lag. A process that catches up with more than that, in
/// real time, waits now and then until they have what it sent; one that is gone must not keep it for long.
void TruthFollower::pace_the_burst() {
  constexpr std::uint64_t kSamples = 128;
  constexpr time::Nanoseconds kPatience = milliseconds(50);
  burst_ = pending_.empty() && mailbox_.empty() ? 0 : burst_ + 1;
  if (burst_ % kSamples == kSamples - 1) consumer_.flush(host::monotonic_now() + kPatience);
}

void TruthFollower::process_pending() {
  while (can_process()) {
    const Pending& front = pending_.begin()->second;
    board_.set_sim_time(front.state.header.sim_time_ns);
    consumer_.process(front.state);
    const bool ends_block = front.ends_block;
    pending_.erase(pending_.begin());
    ++next_;
    waiting_since_ = host::monotonic_now();
    stalled_ = false;
    if (clock_ != ClockMode::Lockstep) {
      checkpoint_.keep(checkpoint());
      pace_the_burst();
    } else if (ends_block) {
      consumer_.flush_blocks();
      marks_.push_back({next_, consumer_.outputs_end(), checkpoint()});
    }
  }
  if (clock_ != ClockMode::Lockstep) return;
  if (!consumer_.has_room()) consumer_.flush_blocks();
  auto undelivered = marks_.begin();
  while (undelivered != marks_.end() && consumer_.outputs_delivered(undelivered->outputs_end)) ++undelivered;
  if (undelivered == marks_.begin()) return;
  delivered_ = std::prev(undelivered)->truth_end;
  checkpoint_.keep(std::prev(undelivered)->checkpoint);
  marks_.erase(marks_.begin(), undelivered);
  give_credit(false);
}

/// Says how far this service is. In lockstep it repeats that now and then: a credit that got lost must not stop the
/// run.
void TruthFollower::give_credit(bool resend) {
  constexpr time::Nanoseconds kRepeat = milliseconds(200);
  next_credit_ = host::monotonic_now() + kRepeat;
  Credit credit;
  credit.run_id = run_id_;
  credit.consumer = service_;
  credit.consumer_number = sensor_number_;
  credit.topic = dds::topics::truth().name;
  // What lies between the two is needed again if this process is killed before its outputs are delivered.
  credit.next_sequence = clock_ == ClockMode::Lockstep ? delivered_ : next_;
  credit.resend = resend;
  if (!credits_.write(credit)) spdlog::warn("a credit could not be sent");
}

/// Truth that was sent and has not come is asked for again.
void TruthFollower::watch_for_gaps() {
  if (run_id_ == RunId{}) return;
  const bool gap = !pending_.empty() && pending_.begin()->first > next_;
  if (!gap) gap_since_ = time::Nanoseconds(0);
  // What was asked for has come and is not all: ask for the rest at once.
  const bool answered = gap && gap_since_ != time::Nanoseconds(0) && next_ > asked_from_;
  if (!answered && host::monotonic_now() < next_credit_) return;
  if (gap && (answered || gap_since_ == time::Nanoseconds(0))) gap_since_ = host::monotonic_now();
  asked_from_ = next_;
  const bool tail_is_missing = run_ended_ && pending_.empty() && next_ < truth_samples_of_run_;
  // In lockstep the next block follows upon a credit; one that was sent before this process listened is sent again.
  const bool silence = clock_ == ClockMode::Lockstep && pending_.empty() && marks_.empty() && !run_ended_ &&
                       host::monotonic_now() - truth_came_at_ > milliseconds(400);
  if (gap || tail_is_missing || silence) {
    give_credit(true);
  } else if (clock_ == ClockMode::Lockstep) {
    give_credit(false);
  }
}

void TruthFollower::watch_the_journal() {
  if (pending_.empty() || stalled_ || host::monotonic_now() - waiting_since_ < seconds(2)) return;
  const TruthState& front = pending_.begin()->second.state;
  if (front.header.sequence_number != next_ || consumer_.ready_for(front)) return;
  stalled_ = true;  // until it is processed
  board_.enter(board_.state(), "waits for entries of the journal that the truth says are in effect");
  spdlog::error("waits for the journal: truth sample {} needs {} entries", front.header.sequence_number,
                front.journal_in_effect);
}

/// What was asked for again and again and does not come is no longer kept: without it there is no going on. Empty when
/// nothing is lost.
std::string TruthFollower::lost() const {
  constexpr time::Nanoseconds kPatience = seconds(8);
  if (gap_since_ != time::Nanoseconds(0) && host::monotonic_now() - gap_since_ > kPatience) {
    return "truth samples " + std::to_string(next_) + " to " + std::to_string(pending_.begin()->first - 1) +
           " cannot be had: there is no checkpoint of this run to go on from, or it is too old";
  }
  if (stalled_ && host::monotonic_now() - waiting_since_ > kPatience) {
    const TruthState& front = pending_.begin()->second.state;
    return "truth sample " + std::to_string(next_) + " needs " + std::to_string(front.journal_in_effect) +
           " entries of the journal, and some of them cannot be had";
  }
  return "";
}

bool TruthFollower::finished() const {
  if (!run_ended_) return false;
  // What has not come some seconds after the end, asked for again and again, will not come. A logger that is killed at
  // the end asks for what it lacks when it is back.
  const bool logged = consumer_.outputs_logged() || log_word_.is_closed(run_id_);
  const bool delivered = clock_ == ClockMode::RealTime ? logged : marks_.empty();
  const time::Nanoseconds patience = logged ? seconds(8) : kTimeToComeBack;
  return (next_ >= truth_samples_of_run_ && delivered) || host::monotonic_now() - run_ended_at_ > patience;
}

void TruthFollower::tell_the_wait() {
  if (told_wait_ || !run_ended_ || host::monotonic_now() - run_ended_at_ < seconds(2)) return;
  told_wait_ = true;
  spdlog::info("waits until the logger has closed its log, at most {} s",
               std::chrono::duration_cast<seconds>(kTimeToComeBack).count());
}

/// A logger that was killed has what came before, and hears the last word of this service when it is back. One that was
/// told to end, and one that has left the run before its end, have no time for that.
void TruthFollower::stay_for_the_log() {
  if (!run_ended_ || next_ == 0) return;
  const time::Nanoseconds deadline = run_ended_at_ + kTimeToComeBack;
  while (!log_word_.is_closed(run_id_) && !host::shutdown_requested() && host::monotonic_now() < deadline) {
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
  while (!grace_.must_stop(run_began_) && !finished()) {
    if (auto message = mailbox_.take(milliseconds(50))) handle(std::move(*message));
    process_pending();
    watch_for_gaps();
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
  if (run_ended_) consumer_.end_run(run_id_);
  consumer_.flush(host::monotonic_now() + seconds(2));
  const bool complete = run_ended_ && fault_.empty() && mailbox_.dropped() == 0 && next_ == truth_samples_of_run_;
  const bool left_no_run = host::shutdown_requested() && !run_began_;
  if (left_no_run) {
    board_.enter(ServiceState::Finished, "ended by a signal before a run");
  } else if (host::shutdown_requested() && !run_ended_) {
    const std::string reason = std::string(scenario::kEndedBySignal) + ", after truth sample " + std::to_string(next_);
    board_.enter(ServiceState::Fault, reason);
    spdlog::error("{}: what follows of this run is missing", reason);
  } else if (!fault_.empty()) {
    board_.enter(ServiceState::Fault, "the run ended as a fault: " + fault_);
    spdlog::error("the run ended as a fault: {}", fault_);
  } else if (!complete) {
    board_.enter(ServiceState::Fault, "truth samples are missing");
    spdlog::error("{} of {} truth samples came", truth_monitor_.samples(), truth_samples_of_run_);
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
