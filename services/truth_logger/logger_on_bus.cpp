#include "inslab/services/truth_logger/logger_on_bus.hpp"

#include <spdlog/spdlog.h>

#include <filesystem>

#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/last_word.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/referee/score/score_json.hpp"
#include "inslab/referee/score/score_text.hpp"
#include "inslab/scenario/service_names.hpp"

namespace inslab::truth_logger {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// Counts a sample; false when it came before.
bool LoggerOnBus::note(Stream& stream, const StreamHeader& header, const Message& message) {
  if (!run_.takes(header.run_id)) return false;
  if (!stream.monitor.received(header, message.received_realtime_ns)) return false;
  stream.demand.came(host::monotonic_now());
  watch_the_sender(stream.monitor.topic(), header, message);
  board_.set_run(header.run_id);
  board_.set_sim_time(header.sim_time_ns);
  if (failure_.empty()) board_.enter(ServiceState::Running);
  return true;
}

void LoggerOnBus::log(const Channel& channel, const StreamHeader& header, const Message& message,
                      const std::vector<std::uint8_t>& cdr) {
  if (!failure_.empty()) return;
  log_.file().write(channel.log_id, static_cast<std::uint32_t>(header.sequence_number),
                    static_cast<std::uint64_t>(message.received_realtime_ns),
                    static_cast<std::uint64_t>(header.publish_realtime_ns), cdr.data(), cdr.size());
}

/// Says how far a stream is in the log, and asks for what is missing.
void LoggerOnBus::give_credit(Stream& stream, bool moved) {
  if (run_.run() == RunId{}) return;
  const streams::StreamMonitor& monitor = stream.monitor;
  const auto sent = sent_.find(monitor.topic());
  streams::Known known;
  known.next = monitor.first_missing();
  known.newer_came = known.next < monitor.next_sequence();
  known.more_was_sent = sent != sent_.end() && monitor.next_sequence() < sent->second;
  known.more_may_have_been_sent = sent == sent_.end();
  known.moved = moved;
  const auto ask = stream.demand.look(known, host::monotonic_now());
  if (!ask) return;
  Credit credit;
  credit.run_id = run_.run();
  credit.consumer = context_.service();
  credit.topic = monitor.topic();
  credit.next_sequence = known.next;
  credit.resend = ask->resend;
  if (!credits_.write(credit)) spdlog::warn("a credit could not be sent");
}

/// Whether the others must stay for it.
void LoggerOnBus::say_of_the_log(bool is_closed) {
  if (run_.run() == RunId{}) return;
  if (!log_words_.write(streams::log_word(run_.run(), is_closed)))
    spdlog::warn("the word on the log could not be sent");
}

void LoggerOnBus::change_demands() {
  for (auto& [topic, stream] : streams_) {
    stream.demand.change(streams::demand_of_log(run_.clock(), run_.has_ended()), host::monotonic_now());
  }
}

/// A hundred times a second, however many messages come. Whom this process did not hear while it was stopped was not
/// silent.
void LoggerOnBus::look_around() {
  constexpr time::Nanoseconds kPeriod = milliseconds(10);
  constexpr time::Nanoseconds kStandstill = seconds(2);
  const time::Nanoseconds now = host::monotonic_now();
  if (now - looked_at_ < kPeriod) return;
  if (now - looked_at_ > kStandstill) {
    for (auto& [service, heard] : services_) heard.at = now;
  }
  looked_at_ = now;
  for (auto& [topic, stream] : streams_) give_credit(stream, false);
  account_for_the_app(false);
}

/// One error is kept and said; the file is left as it is.
void LoggerOnBus::note_failure(const std::string& what) {
  if (!failure_.empty()) return;
  failure_ = what;
  spdlog::error("{}", failure_);
  board_.enter(ServiceState::Fault, failure_);
}

void LoggerOnBus::handle(const Message& message) {
  if (tail_ && failure_.empty()) {
    if (tail_->is_long()) flush();
    try {
      tail_->add({static_cast<std::uint32_t>(message.channel), message.received_realtime_ns, message.bytes.data(),
                  message.bytes.size(), message.origin.writer, message.origin.number});
    } catch (const std::exception& error) {
      spdlog::warn("killed, this service would lose what it has not written yet: {}", error.what());
      tail_.reset();
    }
  }
  take(message);
}

void LoggerOnBus::take(const Message& message) {
  try {
    channels_[message.channel].take(message);
  } catch (const files::WriteError& error) {
    note_failure(error.what());
  }
}

/// What this service waits for before it is ready; empty when nothing.
std::string LoggerOnBus::missing() const {
  for (const Channel& channel : channels_) {
    if (channel.matched()) continue;
    const bool is_of_app = channel.topic == catalog::kNav.name;
    return (is_of_app ? scenario::kWaitsForApp : std::string("waits for ")) + "a writer of " + channel.topic;
  }
  return "";
}

/// Names the services that have not said that they ended; empty when all have.
std::string LoggerOnBus::unfinished_services() const {
  std::string names;
  for (const auto& [service, number] : scenario::required_services(context_.scenario())) {
    if (service == catalog::kTruthLogger) continue;
    const auto found = services_.find({service, number});
    const bool ended = found != services_.end() &&
                       (found->second.state == ServiceState::Finished || found->second.state == ServiceState::Fault);
    if (!ended) names += (names.empty() ? "" : ", ") + service + " " + std::to_string(number);
  }
  return names;
}

/// Every service has said that it ended, or has been silent for long. After a kill the trajectory server waits some
/// seconds for acknowledgements of the reader that is gone, and says nothing meanwhile.
bool LoggerOnBus::all_services_ended() const {
  constexpr time::Nanoseconds kSilence = seconds(15);
  for (const auto& [service, heard] : services_) {
    const bool ended = heard.state == ServiceState::Finished || heard.state == ServiceState::Fault;
    if (service.first != catalog::kTruthLogger && !ended && host::monotonic_now() - heard.at < kSilence) return false;
  }
  return true;
}

/// Everything that the services say they sent.
bool LoggerOnBus::all_samples_here() const {
  for (const auto& [topic, stream] : streams_) {
    const auto sent = sent_.find(topic);
    if (sent != sent_.end() && stream.monitor.came() < sent->second) return false;
  }
  return true;
}

bool LoggerOnBus::finished() const {
  // The others do not stay for longer.
  constexpr time::Nanoseconds kPatience = streams::kTimeToComeBack - seconds(5);
  return run_.has_ended() &&
         ((all_services_ended() && all_samples_here()) || run_.ended_before(kPatience, host::monotonic_now()));
}

int LoggerOnBus::run() {
  while (!grace_.must_stop(run_.has_begun()) && !finished()) {
    if (const auto message = mailbox_.take(milliseconds(50))) handle(*message);
    look_around();
    if (board_.state() == ServiceState::Starting) {
      const std::string waits_for = missing();
      board_.enter(waits_for.empty() ? ServiceState::Ready : ServiceState::Starting, waits_for);
    }
    board_.tick();
    if (host::monotonic_now() < next_flush_ || !failure_.empty()) continue;
    next_flush_ = host::monotonic_now() + milliseconds(500);
    flush();
  }
  return end();
}

/// What came of the navigation app, into the log. A logger that was killed has not heard all of it and says nothing:
/// the log, which has it all, can be scored.
void LoggerOnBus::add_score() {
  scorer_.finish();
  if (run_.is_lockstep()) scorer_.without_latency(score::kLockstepHasNoLatency);
  if (interrupted_) return;
  const auto verdicts = score::judge(scorer_, context_.scenario().scenario.acceptance);
  log_.file().metadata("score", {{"json", score::score_json(scorer_, verdicts).dump(2)}});
}

int LoggerOnBus::end() {
  while (const auto message = mailbox_.take(milliseconds(0))) handle(*message);
  const bool by_signal = host::shutdown_requested() && !run_.has_ended();
  if (failure_.empty() && !by_signal && !all_samples_here())
    failure_ = "samples that were sent are missing from the log";
  if (failure_.empty() && !by_signal && !unfinished_services().empty()) {
    failure_ = "did not say what they sent: " + unfinished_services();
  }
  if (mailbox_.dropped() > 0)
    failure_ = std::to_string(mailbox_.dropped()) + " messages came faster than the disk took them";
  if (failure_.empty() && by_signal && run_.has_begun())
    failure_ = std::string(scenario::kEndedBySignal) + ": the rest is missing";
  board_.enter(failure_.empty() ? ServiceState::Finished : ServiceState::Fault,
               failure_.empty() && by_signal ? "ended by a signal before a run" : failure_);
  // The others stay for the log and go on saying so, once a second each: there is no end of messages to wait for.
  const time::Nanoseconds closes_at = host::monotonic_now() + milliseconds(200);
  while (host::monotonic_now() < closes_at) {
    if (const auto message = mailbox_.take(milliseconds(20))) handle(*message);
  }
  try {
    account_for_the_app(true);
    add_score();
    log_.file().close();
  } catch (const files::WriteError& error) {
    note_failure(error.what());
  }
  checkpoint_.forget();
  say_of_the_log(true);
  board_.flush(seconds(2));
  log_words_.wait_for_acknowledgments(seconds(2));
  spdlog::info("log {} ({:.1f} MB)", log_.path(), static_cast<double>(log_.file().file_size()) * 1e-6);
  if (!failure_.empty()) spdlog::error("{}", failure_);
  return host::after_the_last_word(failure_.empty() && context_.writers().fault().empty() ? host::kOk : host::kFailed);
}

}  // namespace inslab::truth_logger
