#include "inslab/services/truth_logger/logger_on_bus.hpp"

#include <spdlog/spdlog.h>

#include <filesystem>

#include "inslab/foundation/files/error.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/last_word.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/referee/score/score_json.hpp"
#include "inslab/referee/score/score_text.hpp"
#include "inslab/scenario/service_names.hpp"

namespace inslab::logger {

using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

/// More than a tail grows to: chunks end with a flush of the tail, so that a message is either in the file or there.
constexpr std::size_t kChunkBytes = std::size_t{2} << 20;

/// What the score is made of; perfect IMUs and vehicle states are not.
void add_to(score::Scorer& scorer, const TruthState& truth) { scorer.add(truth); }
void add_to(score::Scorer& scorer, const ImuSample& imu) { scorer.add(imu); }
void add_to(score::Scorer& scorer, const GnssFix& fix) { scorer.add(fix); }
template <class T>
void add_to(score::Scorer& /*scorer*/, const T& /*sample*/) {}

/// What a logger before this one has written is not thrown away.
RunLog new_log(const app::Context& context, const std::string& path) {
  if (!context.options().go_on.empty() && std::filesystem::exists(path)) {
    throw std::runtime_error(path + ": cannot be gone on with: the logger that was killed could keep no state");
  }
  return RunLog(path, context.scenario(), app::cpu_features(), kChunkBytes);
}

std::uint64_t hash_of(const std::vector<std::uint8_t>& bytes) {
  return std::hash<std::string_view>()({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace

LoggerOnBus::LoggerOnBus(app::Context& context, const std::string& path)
    : context_(context),
      checkpoint_(context),
      interrupted_(interrupted(context, checkpoint_)),
      log_(interrupted_ ? RunLog(interrupted_->path, kChunkBytes) : new_log(context, path)),
      scorer_(context.scenario().scenario),
      board_(context, 0,
             [this](ServiceStatus& status) {
               for (const auto& [topic, monitor] : streams_) status.streams.push_back(monitor.status());
               status.queue_depth_max = static_cast<std::uint32_t>(mailbox_.deepest());
               if (status.state == ServiceState::Running) status.message = score::score_so_far(scorer_);
             }),
      credits_(context.participant(), dds::topics::credit()) {
  // Callbacks hold indices into the list, and the worker looks them up: it must not move once readers exist.
  channels_.reserve(128);
  const scenario::LoadedScenario& scenario = context.scenario();
  add_stream(context, dds::topics::truth(scenario.truth_grid().hz()));
  for (const auto& imu : scenario.imus) {
    add_stream(context, dds::topics::imu(imu.number, imu.rate.hz()));
    add_stream(context, dds::topics::imu_truth(imu.number, imu.rate.hz()));
  }
  for (const auto& gnss : scenario.gnss) add_stream(context, dds::topics::gnss(gnss.number, gnss.rate.hz()));
  add_nav_channels(context);
  for (const auto& imu : scenario.imus) scorer_.add(imu.installation, -1);
  for (const auto& gnss : scenario.gnss) scorer_.add(gnss.installation, -1);
  if (scenario.scenario.trajectory.source == scenario::TrajectorySource::VehicleState) add_vehicle_channels(context);
  add_profile_channels<ImuErrorProfile>(context);
  add_profile_channels<VibrationProfile>(context);
  add_profile_channels<InstallationProfile>(context);
  add_profile_channels<GnssErrorProfile>(context);
  add_profile_channels<FaultProfile>(context);
  add_control_channels(context);
  if (interrupted_) go_on();
}

template <class T>
LoggerOnBus::Channel& LoggerOnBus::add_reader(app::Context& context, const dds::Topic<T>& topic, Writers writers) {
  const std::size_t index = channels_.size();
  channels_.emplace_back();
  Channel& channel = channels_.back();
  channel.topic = topic.name;
  const auto enqueue = [this, index](const dds::Received<T>& sample, const dds::SampleOrigin& origin) {
    mailbox_.put({index, sample.cdr, app::realtime_now().count(), dds::participant_of(origin)});
  };
  if (writers == Writers::Anybody) {
    channel.reader = std::make_shared<dds::OpenReader<T>>(context.participant(), topic, enqueue);
    channel.matched = [] { return true; };
  } else if (writers == Writers::OneApp) {
    const bool is_nav = std::is_same_v<T, NavSolution> || std::is_same_v<T, Block<NavSolution>>;
    const std::string stream = is_nav ? dds::topics::nav().name : topic.name;
    const bool is_reference_nav = is_nav && context.scenario().scenario.reference_nav.has_value();
    auto reader = std::make_shared<dds::OpenReader<T>>(
        context.participant(), topic, context.writers().only_the_app(stream, is_reference_nav, enqueue));
    channel.matched = [reader] { return reader->matched_writers() > 0; };
    channel.reader = reader;
  } else {
    auto reader = std::make_shared<app::SetReader<T>>(context, topic, enqueue);
    channel.matched = [reader] { return reader->matched_writers() > 0; };
    channel.reader = reader;
  }
  return channel;
}

/// A topic that goes to the log as it comes, each message numbered and timed by its arrival.
template <class T>
LoggerOnBus::Channel& LoggerOnBus::add_channel(app::Context& context, const dds::Topic<T>& topic, Writers writers) {
  Channel& channel = add_reader(context, topic, writers);
  channel.log_id = io::LogChannel<T>(log_.file(), topic.name).id();
  channel.take = [this, &channel](const Message& message) {
    if (channel.on_message) channel.on_message(message);
    if (!failure_.empty()) return;
    const auto received = static_cast<std::uint64_t>(message.received_realtime_ns);
    log_.file().write(channel.log_id, channel.count++, received, received, message.bytes.data(), message.bytes.size());
  };
  return channel;
}

/// Of a topic whose messages come again to whoever joins late, each is logged once: a logger that was started again
/// hears of everything that the one before it had.
void LoggerOnBus::log_once(Channel& channel) {
  channel.take = [this, log_it = channel.take](const Message& message) {
    if (once_.insert(hash_of(message.bytes)).second) log_it(message);
  };
}

/// A stream that comes as single samples alone.
template <class T>
LoggerOnBus::Channel& LoggerOnBus::add_singles(app::Context& context, const dds::Topic<T>& topic) {
  app::StreamMonitor& monitor =
      streams_.emplace(topic.name, app::StreamMonitor(topic.name, StreamDirection::In)).first->second;
  Channel& singles = add_channel(context, topic);
  singles.take = [this, &monitor, &singles](const Message& message) {
    T sample;
    if (!wire::decode(message.bytes.data(), message.bytes.size(), sample)) return;
    if (!note(monitor, sample.header, message)) return;
    add_to(scorer_, sample);
    log(singles, sample.header, message, message.bytes);
  };
  return singles;
}

/// A stream that comes as single samples or in blocks, and goes to one channel of the log either way.
template <class T>
void LoggerOnBus::add_stream(app::Context& context, const dds::Topic<T>& topic) {
  Channel& singles = add_singles(context, topic);
  app::StreamMonitor& monitor = streams_.at(topic.name);
  Channel& blocks = add_reader<Block<T>>(context, dds::topics::block(topic), Writers::Ours);
  blocks.take = [this, &monitor, &singles](const Message& message) {
    Block<T> block;
    if (!wire::decode(message.bytes.data(), message.bytes.size(), block)) return;
    for (const T& sample : block.samples) {
      if (!note(monitor, sample.header, message)) continue;
      add_to(scorer_, sample);
      wire::encode(sample, encoded_);
      log(singles, sample.header, message, encoded_);
    }
    if (clock_ == ClockMode::Lockstep) give_credit(singles.topic, monitor.first_missing(), false);
  };
}

/// Counts a sample; false when it came before.
bool LoggerOnBus::note(app::StreamMonitor& monitor, const StreamHeader& header, const Message& message) {
  if (!context_.obeys(header.run_id) || (run_id_ != RunId{} && header.run_id != run_id_)) return false;
  if (!monitor.received(header, message.received_realtime_ns)) return false;
  watch_the_sender(monitor.topic(), header, message);
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

void LoggerOnBus::give_credit(const std::string& topic, std::uint64_t next_sequence, bool resend) {
  Credit credit;
  credit.run_id = run_id_;
  credit.consumer = context_.service();
  credit.topic = topic;
  credit.next_sequence = next_sequence;
  credit.resend = resend;
  if (!credits_.write(credit)) spdlog::warn("a credit could not be sent");
}

/// Whether the others must stay for it.
void LoggerOnBus::say_of_the_log(bool is_closed) {
  if (run_id_ == RunId{}) return;
  if (!credits_.write(app::log_word(run_id_, is_closed))) spdlog::warn("a credit could not be sent");
}

/// Asks again for what is missing; in lockstep also says again how far this service is, since a credit that got lost
/// must not stop the run, and so it does when the run has ended: the others stay until everything is here.
void LoggerOnBus::repeat_credits() {
  if (run_id_ == RunId{} || app::monotonic_now() < next_credits_) return;
  next_credits_ = app::monotonic_now() + milliseconds(run_ended_ ? 50 : 200);
  for (const auto& [topic, monitor] : streams_) {
    const auto sent = sent_.find(topic);
    // In lockstep the next block follows upon a credit; one that was sent before this process listened is sent again.
    // At the end of a run nothing follows the last sample that would show that it is missing.
    const auto silence_ns = app::realtime_now().count() - sources_[topic].received_realtime_ns;
    const time::Nanoseconds patience = milliseconds(clock_ == ClockMode::Lockstep ? 400 : 1000);
    const bool silent = (clock_ == ClockMode::Lockstep || run_ended_) && silence_ns > patience.count();
    const bool lacks = silent || monitor.first_missing() < monitor.next_sequence() ||
                       (sent != sent_.end() && monitor.next_sequence() < sent->second);
    if (lacks || run_ended_ || clock_ == ClockMode::Lockstep) give_credit(topic, monitor.first_missing(), lacks);
  }
}

template <class Profile>
void LoggerOnBus::add_profile_channels(app::Context& context) {
  add_channel(context, dds::topics::request<Profile>(), Writers::Anybody);
  Channel& journal = add_channel(context, dds::topics::journal<Profile>());
  log_once(journal);
  journal.on_message = [this](const Message& message) {
    Profile entry;
    if (!wire::decode(message.bytes.data(), message.bytes.size(), entry)) return;
    log_.add_profile(entry);
    if constexpr (std::is_same_v<Profile, InstallationProfile>) scorer_.add(entry, entry.request.apply_at_ns);
  };
}

/// The answers of the app under test, single or in blocks: they go to one channel of the log either way.
void LoggerOnBus::add_nav_channels(app::Context& context) {
  Channel& singles = add_channel(context, dds::topics::nav(), Writers::OneApp);
  singles.on_message = [this](const Message& message) {
    NavSolution solution;
    if (!wire::decode(message.bytes.data(), message.bytes.size(), solution)) return;
    scorer_.add(solution, message.received_realtime_ns);
  };
  Channel& blocks = add_reader<Block<NavSolution>>(context, dds::topics::block(dds::topics::nav()), Writers::OneApp);
  blocks.take = [&singles](const Message& message) {
    Block<NavSolution> block;
    if (!wire::decode(message.bytes.data(), message.bytes.size(), block)) return;
    Message single{message.channel, {}, message.received_realtime_ns, message.sender};
    for (const NavSolution& solution : block.samples) {
      wire::encode(solution, single.bytes);
      singles.take(single);
    }
  };
  const bool is_required = context.scenario().scenario.require_nav_app;
  singles.matched = blocks.matched = [is_required, in_singles = singles.matched, in_blocks = blocks.matched] {
    return !is_required || in_singles() || in_blocks();
  };
}

void LoggerOnBus::add_vehicle_channels(app::Context& context) {
  const double nominal_hz = context.scenario().scenario.trajectory.vehicle.nominal_rate_hz;
  // It may come late: the barrier of the trajectory server knows whether the run waits for it.
  add_channel(context, dds::topics::vehicle_state(nominal_hz), Writers::OneApp).matched = [] { return true; };
  add_singles(context, dds::topics::vehicle_state_used(nominal_hz));
  add_channel(context, dds::topics::vehicle_link());
}

void LoggerOnBus::add_control_channels(app::Context& context) {
  add_channel(context, dds::topics::installation());
  add_channel(context, dds::topics::time_mark());
  Channel& acks = add_channel(context, dds::topics::profile_ack());
  log_once(acks);
  acks.on_message = [this](const Message& message) {
    ProfileAck ack;
    if (!replaying_ && wire::decode(message.bytes.data(), message.bytes.size(), ack)) log_.add_ack(ack);
  };
  add_channel(context, dds::topics::sim_status()).on_message = [this](const Message& message) {
    SimStatus status;
    if (!wire::decode(message.bytes.data(), message.bytes.size(), status)) return;
    if (!context_.obeys(status.run_id)) return;
    // Once a run has begun this process logs no other.
    if (run_id_ != RunId{} && status.run_id != run_id_ && run_began_) return;
    begin_run(status.run_id);
    run_began_ = run_began_ || status.state != RunState::Waiting;
    clock_ = status.clock;
    if (!has_ended(status.state) || run_ended_) return;
    run_ended_ = true;
    run_ended_at_ = app::monotonic_now();
    next_credits_ = time::Nanoseconds(0);
    sent_[dds::topics::truth().name] = status.truth_samples;
  };
  add_channel(context, dds::topics::service_status()).on_message = [this](const Message& message) {
    ServiceStatus status;
    if (!wire::decode(message.bytes.data(), message.bytes.size(), status)) return;
    services_[{status.service, status.sensor_number}] = {status.state, app::monotonic_now()};
    if (status.state != ServiceState::Finished && status.state != ServiceState::Fault) return;
    for (const StreamStatus& stream : status.streams) {
      if (stream.direction == StreamDirection::Out) sent_[stream.topic] = stream.samples;
    }
  };
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
                  message.bytes.size()});
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
  } catch (const io::WriteError& error) {
    note_failure(error.what());
  }
}

/// What this service waits for before it is ready; empty when nothing.
std::string LoggerOnBus::missing() const {
  for (const Channel& channel : channels_) {
    if (channel.matched()) continue;
    const bool is_of_app = channel.topic == wire::topic_names::kNav;
    return (is_of_app ? app::kWaitsForApp : std::string("waits for ")) + "a writer of " + channel.topic;
  }
  return "";
}

/// Names the services that have not said that they ended; empty when all have.
std::string LoggerOnBus::unfinished_services() const {
  std::string names;
  for (const auto& [service, number] : app::required_services(context_.scenario())) {
    if (service == app::kTruthLogger) continue;
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
    if (service.first != app::kTruthLogger && !ended && app::monotonic_now() - heard.at < kSilence) return false;
  }
  return true;
}

/// Everything that the services say they sent.
bool LoggerOnBus::all_samples_here() const {
  for (const auto& [topic, monitor] : streams_) {
    const auto sent = sent_.find(topic);
    if (sent != sent_.end() && monitor.samples() < sent->second) return false;
  }
  return true;
}

bool LoggerOnBus::finished() const {
  // The others do not stay for longer.
  constexpr time::Nanoseconds kPatience = app::kTimeToComeBack - seconds(5);
  return run_ended_ &&
         ((all_services_ended() && all_samples_here()) || app::monotonic_now() - run_ended_at_ > kPatience);
}

int LoggerOnBus::run() {
  while (!grace_.must_stop(run_began_) && !finished()) {
    if (const auto message = mailbox_.take(milliseconds(50))) handle(*message);
    repeat_credits();
    if (board_.state() == ServiceState::Starting) {
      const std::string waits_for = missing();
      board_.enter(waits_for.empty() ? ServiceState::Ready : ServiceState::Starting, waits_for);
    }
    board_.tick();
    if (app::monotonic_now() < next_flush_ || !failure_.empty()) continue;
    next_flush_ = app::monotonic_now() + milliseconds(500);
    flush();
  }
  return end();
}

/// What came of the navigation app, into the log. A logger that was killed has not heard all of it and says nothing:
/// the log, which has it all, can be scored.
void LoggerOnBus::add_score() {
  scorer_.finish();
  if (clock_ == ClockMode::Lockstep) scorer_.without_latency(score::kLockstepHasNoLatency);
  if (interrupted_) return;
  const auto verdicts = score::judge(scorer_, context_.scenario().scenario.acceptance);
  log_.file().metadata("score", {{"json", score::score_json(scorer_, verdicts).dump(2)}});
}

int LoggerOnBus::end() {
  while (const auto message = mailbox_.take(milliseconds(0))) handle(*message);
  const bool by_signal = app::shutdown_requested() && !run_ended_;
  if (failure_.empty() && !by_signal && !all_samples_here())
    failure_ = "samples that were sent are missing from the log";
  if (failure_.empty() && !by_signal && !unfinished_services().empty()) {
    failure_ = "did not say what they sent: " + unfinished_services();
  }
  if (mailbox_.dropped() > 0)
    failure_ = std::to_string(mailbox_.dropped()) + " messages came faster than the disk took them";
  if (failure_.empty() && by_signal && run_began_)
    failure_ = std::string(app::kEndedBySignal) + ": the rest is missing";
  board_.enter(failure_.empty() ? ServiceState::Finished : ServiceState::Fault,
               failure_.empty() && by_signal ? "ended by a signal before a run" : failure_);
  // The others stay for the log and go on saying so, once a second each: there is no end of messages to wait for.
  const time::Nanoseconds closes_at = app::monotonic_now() + milliseconds(200);
  while (app::monotonic_now() < closes_at) {
    if (const auto message = mailbox_.take(milliseconds(20))) handle(*message);
  }
  try {
    add_score();
    log_.file().close();
  } catch (const io::WriteError& error) {
    note_failure(error.what());
  }
  checkpoint_.forget();
  say_of_the_log(true);
  board_.flush(seconds(2));
  credits_.wait_for_acknowledgments(seconds(2));
  spdlog::info("log {} ({:.1f} MB)", log_.path(), static_cast<double>(log_.file().file_size()) * 1e-6);
  if (!failure_.empty()) spdlog::error("{}", failure_);
  return app::after_the_last_word(failure_.empty() && context_.writers().fault().empty() ? app::kOk : app::kFailed);
}

}  // namespace inslab::logger
