#include "app/truth_follower.hpp"

#include "app/exit_code.hpp"
#include "app/host.hpp"
#include "app/shutdown.hpp"

namespace inslab::app {

using std::chrono::milliseconds;
using std::chrono::seconds;

TruthFollower::TruthFollower(Context& context, std::uint32_t sensor_number, TruthConsumer& consumer)
    : consumer_(consumer),
      truth_monitor_(dds::topics::truth().name, StreamDirection::In),
      board_(context.participant(), context.service(), sensor_number,
             [this](ServiceStatus& status) {
               status.streams.push_back(truth_monitor_.status());
               status.queue_depth_max = static_cast<std::uint32_t>(mailbox_.deepest());
               consumer_.report(status);
             }),
      status_reader_(context.participant(), dds::topics::sim_status(),
                     [this](const SimStatus& status, const dds::SampleOrigin&) { mailbox_.put(status); }),
      truth_reader_(context.participant(), dds::topics::truth(context.scenario().scenario.truth_rate_hz),
                    [this](const TruthState& state, const dds::SampleOrigin&) {
                      mailbox_.put(Truth{state, realtime_now().count()});
                    }) {
  read_journal<ImuErrorProfile>(context.participant());
  read_journal<VibrationProfile>(context.participant());
  read_journal<InstallationProfile>(context.participant());
  read_journal<GnssErrorProfile>(context.participant());
  read_journal<FaultProfile>(context.participant());
}

template <class Profile>
void TruthFollower::read_journal(dds::Participant& participant) {
  auto reader = std::make_shared<dds::Reader<Profile>>(
      participant, dds::topics::journal<Profile>(),
      [this](const Profile& entry, const dds::SampleOrigin&) { mailbox_.put(AnyProfile(entry)); });
  journal_readers_.push_back({reader, [reader] { return reader->matched_writers() > 0; }});
}

bool TruthFollower::matched() const {
  for (const JournalReader& journal : journal_readers_) {
    if (!journal.matched()) return false;
  }
  return truth_reader_.matched_writers() > 0 && status_reader_.matched_writers() > 0 && consumer_.outputs_matched();
}

void TruthFollower::handle(Message message) {
  if (const auto* truth = std::get_if<Truth>(&message)) {
    truth_monitor_.received(truth->state.header, truth->received_realtime_ns);
    run_id_ = truth->state.header.run_id;
    board_.set_run(run_id_);
    board_.enter(ServiceState::Running);
    if (pending_.empty()) pending_since_ = monotonic_now();
    pending_.push_back(truth->state);
  } else if (const auto* entry = std::get_if<AnyProfile>(&message)) {
    consumer_.add(*entry);
  } else {
    const auto& status = std::get<SimStatus>(message);
    if (status.state == RunState::Waiting || status.state == RunState::Running) return;
    run_ended_ = true;
    run_ended_at_ = monotonic_now();
    truth_samples_of_run_ = status.truth_samples;
  }
}

void TruthFollower::process_pending() {
  while (!pending_.empty() && consumer_.ready_for(pending_.front())) {
    board_.set_sim_time(pending_.front().header.sim_time_ns);
    consumer_.process(pending_.front());
    pending_.pop_front();
    pending_since_ = monotonic_now();
    stalled_ = false;
  }
}

void TruthFollower::watch_the_journal() {
  if (pending_.empty() || stalled_ || monotonic_now() - pending_since_ < seconds(2)) return;
  stalled_ = true;
  board_.enter(board_.state(), "waits for entries of the journal that the truth says are in effect");
  spdlog::error("waits for the journal: truth sample {} needs {} entries", pending_.front().header.sequence_number,
                pending_.front().journal_in_effect);
}

bool TruthFollower::finished() const {
  if (!run_ended_) return false;
  const bool all_here = truth_monitor_.next_sequence() >= truth_samples_of_run_ && pending_.empty();
  // Reliable samples that have not come by then will not come: their writer keeps one second of them.
  return all_here || monotonic_now() - run_ended_at_ > seconds(5);
}

int TruthFollower::run() {
  while (!shutdown_requested() && !finished()) {
    if (auto message = mailbox_.take(milliseconds(50))) handle(std::move(*message));
    process_pending();
    watch_the_journal();
    if (board_.state() == ServiceState::Starting && matched()) board_.enter(ServiceState::Ready);
    board_.tick();
  }
  return end();
}

int TruthFollower::end() {
  consumer_.flush(seconds(5));
  const bool complete = run_ended_ && truth_monitor_.lost() == 0 && mailbox_.dropped() == 0 && pending_.empty() &&
                        truth_monitor_.next_sequence() == truth_samples_of_run_;
  if (shutdown_requested() && !run_ended_) {
    board_.enter(ServiceState::Finished, "ended by a signal");
  } else if (!complete) {
    board_.enter(ServiceState::Fault, "truth samples are missing");
    spdlog::error("{} of {} truth samples came", truth_monitor_.samples(), truth_samples_of_run_);
  } else {
    board_.enter(ServiceState::Finished);
  }
  board_.flush(seconds(2));
  return complete || (shutdown_requested() && !run_ended_) ? kOk : kFailed;
}

}  // namespace inslab::app
