// What LoggerOnBus does so that a log goes on after its process was killed, and to note that others were.

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/services/truth_logger/logger_on_bus.hpp"

namespace inslab::truth_logger {

using std::chrono::seconds;

/// What a process before this one left of the run that is going on. Only after one that did not end in order is there
/// anything to find out, and then the run's status, if any, is there within a moment; who started this process may
/// know.
std::optional<sim::LoggerState> LoggerOnBus::interrupted(service::Context& context, service::Checkpoint& checkpoint) {
  auto run = host::run_id_of(context.options().go_on);
  if (!run && !checkpoint.left_behind()) return std::nullopt;
  if (!run) {
    host::Mailbox<SimStatus> mailbox;
    const service::SetReader<SimStatus> reader(
        context, dds::topics::sim_status(),
        [&](const SimStatus& status, const dds::SampleOrigin&) { mailbox.put(status); });
    const auto status = mailbox.take(seconds(2));
    if (!status) return std::nullopt;
    run = status->run_id;
  }
  checkpoint.begin(*run);
  sim::LoggerState state;
  const auto head = checkpoint.resume([&](state::StateReader& from) { from(state); });
  if (!head) return std::nullopt;
  spdlog::warn("goes on with {}, {:.3f} s after its last flush", state.path,
               time::to_seconds(host::realtime_now().count() - head->kept_realtime_ns));
  state.run_id = *run;
  return state;
}

sim::LoggerState LoggerOnBus::state() const {
  sim::LoggerState state;
  state.path = log_.path();
  state.file_size = log_.file_size();
  state.generation = generation_;
  for (const auto& [topic, stream] : streams_) state.streams.push_back({topic, stream.monitor.progress()});
  for (const auto& [topic, source] : sources_) {
    state.sources.push_back({topic, {}, source.received_realtime_ns, source.sequence_number});
    std::copy(source.sender.begin(), source.sender.end(), state.sources.back().participant.bytes.begin());
  }
  state.app_writers = app_messages_.state();
  for (const Channel& channel : channels_) state.channel_counts.push_back(channel.count);
  state.once.assign(once_.begin(), once_.end());
  state.run_began = run_.has_begun();
  state.run_ended = run_.has_ended();
  state.clock = run_.clock();
  for (const auto& [service, heard] : services_) state.services.push_back({service.first, service.second, heard.state});
  for (const auto& [topic, samples] : sent_) state.sent.push_back({topic, samples});
  return state;
}

/// There is another run now. What has been taken before is flushed next, so that nothing of it is in the tail
/// alone.
void LoggerOnBus::begin_run() {
  for (auto& [topic, stream] : streams_) {
    stream.demand.begin(streams::demand_of_log(run_.clock(), run_.has_ended()), host::monotonic_now());
  }
  say_of_the_log(false);
  checkpoint_.begin(run_.run());
  open_tail();
  if (tail_) tail_->begin(generation_);
  next_flush_ = time::Nanoseconds(0);
}

void LoggerOnBus::open_tail() {
  tail_.reset();
  try {
    tail_ = std::make_unique<sim::LogTail>(checkpoint_.path("tail"));
  } catch (const std::exception& error) {
    spdlog::warn("killed, this service would lose what it has not written yet: {}", error.what());
  }
}

void LoggerOnBus::go_on() {
  using Phase = streams::RunFollower::Phase;
  const Phase begun = interrupted_->run_began ? Phase::Begun : Phase::Waiting;
  const Phase phase = interrupted_->run_ended ? Phase::Ended : begun;
  run_.go_on(interrupted_->run_id, interrupted_->clock, phase, host::monotonic_now());
  for (const sim::LoggedStream& logged : interrupted_->streams) {
    const auto stream = streams_.find(logged.topic);
    if (stream != streams_.end()) stream->second.monitor.go_on(run_.run(), logged.progress);
  }
  for (const sim::LoggedSource& logged : interrupted_->sources) {
    Source& source = sources_[logged.topic];
    std::copy_n(logged.participant.bytes.begin(), source.sender.size(), source.sender.begin());
    source.received_realtime_ns = logged.received_realtime_ns;
    source.sequence_number = logged.sequence_number;
  }
  for (auto& [topic, stream] : streams_) {
    stream.demand.begin(streams::demand_of_log(run_.clock(), run_.has_ended()), host::monotonic_now());
  }
  for (std::size_t i = 0; i < std::min(channels_.size(), interrupted_->channel_counts.size()); ++i) {
    channels_[i].count = interrupted_->channel_counts[i];
  }
  once_.insert(interrupted_->once.begin(), interrupted_->once.end());
  for (const sim::LoggedService& service : interrupted_->services) {
    services_[{service.service, service.number}] = {service.state, host::monotonic_now()};
  }
  for (const sim::SentStream& stream : interrupted_->sent) sent_[stream.topic] = stream.samples;
  board_.set_run(run_.run());
  say_of_the_log(false);
  app_messages_.go_on(interrupted_->app_writers);
  std::uint64_t rescued = 0;
  open_tail();
  if (tail_) {
    tail_->for_each(interrupted_->generation, [&](const sim::LogTail::Message& message) {
      if (message.channel >= channels_.size()) return;
      take({message.channel,
            {message.data, message.data + message.size},
            message.received_realtime_ns,
            {message.writer, message.number, 0}});
      ++rescued;
    });
  }
  app_messages_.begin_account();
  generation_ = interrupted_->generation;
  log_.add_recovery("log", {{"rescued_messages", std::to_string(rescued)}});
  flush();
}

/// Once what the app's writers keep has come: says which of its solutions the log lacks of the time between the kill
/// and now.
void LoggerOnBus::account_for_the_app(bool at_the_end) {
  if (!app_messages_.accounts()) return;
  const bool they_keep = std::any_of(channels_.begin(), channels_.end(),
                                     [](const Channel& channel) { return channel.is_kept && channel.is_kept(); });
  if (!at_the_end && !app_messages_.account_is_due(they_keep, host::monotonic_now())) return;
  app_messages_.end_account();
  for (const auto& [topic, missing] : app_messages_.missing()) {
    log_.add_recovery(topic, {{"missing_messages", std::to_string(missing)}});
    if (missing == 0) {
      spdlog::info("{}: everything that was sent while this service was away is in the log", topic);
    } else {
      spdlog::warn(
          "{}: {} messages that were sent while this service was away are missing: their writer did not keep "
          "them",
          topic, missing);
    }
  }
}

/// Everything taken so far is in the file, and the next process would know it; killed before it is told, that one cuts
/// the file back and takes the same from the tail.
void LoggerOnBus::flush() {
  try {
    log_.file().flush();
  } catch (const files::WriteError& error) {
    note_failure(error.what());
    return;
  }
  if (run_.run() == RunId{}) return;
  ++generation_;
  const bool kept = checkpoint_.keep(checkpoint_.state([&](state::StateWriter& to) { to(state()); }));
  if (tail_) tail_->begin(generation_);
  // Of a state that does not know what is in the file by now the log would get messages twice.
  if (!kept) checkpoint_.forget();
}

/// A stream that comes from another participant than before comes from a service that was started again.
void LoggerOnBus::watch_the_sender(const std::string& topic, const StreamHeader& header, const Message& message) {
  Source& source = sources_[topic];
  const dds::ParticipantKey sender = dds::participant_of(message.origin);
  const bool another = source.sender != dds::ParticipantKey{} && sender != source.sender;
  if (another) {
    const double silence_s = time::to_seconds(message.received_realtime_ns - source.received_realtime_ns);
    spdlog::warn("{}: its service was started again; sample {} came {:.3f} s after sample {}", topic,
                 header.sequence_number, silence_s, source.sequence_number);
    log_.add_recovery(topic, {{"last_sequence_before", std::to_string(source.sequence_number)},
                              {"first_sequence_after", std::to_string(header.sequence_number)},
                              {"first_sim_time_after_ns", std::to_string(header.sim_time_ns)},
                              {"silence_s", fmt::format("{:.3f}", silence_s)}});
  }
  source = {sender, message.received_realtime_ns, header.sequence_number};
}

}  // namespace inslab::truth_logger
