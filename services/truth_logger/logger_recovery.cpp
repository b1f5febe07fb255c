// What LoggerOnBus does so that a log goes on after its process was killed, and to note that others were.

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/host/host.hpp"
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
               static_cast<double>(host::realtime_now().count() - head->kept_realtime_ns) * 1e-9);
  state.run_id = *run;
  return state;
}

sim::LoggerState LoggerOnBus::state() const {
  sim::LoggerState state;
  state.path = log_.path();
  state.generation = generation_;
  for (const auto& [topic, monitor] : streams_) {
    state.streams.push_back({topic, monitor.samples(), monitor.first_missing()});
  }
  for (const Channel& channel : channels_) state.channel_counts.push_back(channel.count);
  state.once.assign(once_.begin(), once_.end());
  state.run_began = run_began_;
  state.run_ended = run_ended_;
  state.clock = clock_;
  for (const auto& [service, heard] : services_) state.services.push_back({service.first, service.second, heard.state});
  for (const auto& [topic, samples] : sent_) state.sent.push_back({topic, samples, 0});
  return state;
}

/// From now on `run` is the run. What has been taken before is flushed next, so that nothing of it is in the tail
/// alone.
void LoggerOnBus::begin_run(const RunId& run) {
  if (run == run_id_) return;
  run_id_ = run;
  say_of_the_log(false);
  checkpoint_.begin(run);
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
  run_id_ = interrupted_->run_id;
  run_began_ = interrupted_->run_began;
  run_ended_ = interrupted_->run_ended;
  run_ended_at_ = host::monotonic_now();
  clock_ = interrupted_->clock;
  for (const sim::LoggedStream& stream : interrupted_->streams) {
    const auto monitor = streams_.find(stream.topic);
    if (monitor != streams_.end()) monitor->second.go_on(run_id_, stream.samples, stream.next_sequence);
  }
  for (std::size_t i = 0; i < std::min(channels_.size(), interrupted_->channel_counts.size()); ++i) {
    channels_[i].count = interrupted_->channel_counts[i];
  }
  once_.insert(interrupted_->once.begin(), interrupted_->once.end());
  for (const sim::LoggedService& service : interrupted_->services) {
    services_[{service.service, service.number}] = {service.state, host::monotonic_now()};
  }
  for (const sim::LoggedStream& stream : interrupted_->sent) sent_[stream.topic] = stream.samples;
  board_.set_run(run_id_);
  say_of_the_log(false);
  std::uint64_t rescued = 0;
  replaying_ = true;
  open_tail();
  if (tail_) {
    tail_->for_each(interrupted_->generation, [&](const sim::LogTail::Message& message) {
      if (message.channel >= channels_.size()) return;
      take({message.channel, {message.data, message.data + message.size}, message.received_realtime_ns});
      ++rescued;
    });
  }
  replaying_ = false;
  generation_ = interrupted_->generation;
  log_.add_recovery("log", {{"rescued_messages", std::to_string(rescued)}});
  flush();
}

/// Everything taken so far is in the file, and the next process would know it.
void LoggerOnBus::flush() {
  try {
    log_.file().flush();
  } catch (const files::WriteError& error) {
    note_failure(error.what());
    return;
  }
  if (run_id_ == RunId{}) return;
  ++generation_;
  const bool kept = checkpoint_.keep(checkpoint_.state([&](state::StateWriter& to) { to(state()); }));
  if (tail_) tail_->begin(generation_);
  // Of a state that does not know what is in the file by now the log would get messages twice.
  if (!kept) checkpoint_.forget();
}

/// A stream that comes from another participant than before comes from a service that was started again.
void LoggerOnBus::watch_the_sender(const std::string& topic, const StreamHeader& header, const Message& message) {
  Source& source = sources_[topic];
  const bool another = source.sender != dds::ParticipantKey{} && message.sender != source.sender && !replaying_;
  if (another) {
    const double silence_s = static_cast<double>(message.received_realtime_ns - source.received_realtime_ns) * 1e-9;
    spdlog::warn("{}: its service was started again; sample {} came {:.3f} s after sample {}", topic,
                 header.sequence_number, silence_s, source.sequence_number);
    log_.add_recovery(topic, {{"last_sequence_before", std::to_string(source.sequence_number)},
                              {"first_sequence_after", std::to_string(header.sequence_number)},
                              {"first_sim_time_after_ns", std::to_string(header.sim_time_ns)},
                              {"silence_s", fmt::format("{:.3f}", silence_s)}});
  }
  if (!replaying_) source = {message.sender, message.received_realtime_ns, header.sequence_number};
}

}  // namespace inslab::truth_logger
