// What LoggerOnBus listens to, and what becomes of each message.

#include <spdlog/spdlog.h>

#include <filesystem>

#include "inslab/foundation/host/host.hpp"
#include "inslab/referee/score/score_text.hpp"
#include "inslab/scenario/service_names.hpp"
#include "inslab/services/truth_logger/logger_on_bus.hpp"

namespace inslab::truth_logger {

using std::chrono::milliseconds;

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
sim::RunLog new_log(const service::Context& context, const std::string& path) {
  if (!context.options().go_on.empty() && std::filesystem::exists(path)) {
    throw std::runtime_error(path + ": cannot be gone on with: the logger that was killed could keep no state");
  }
  return sim::RunLog(path, context.scenario(), host::cpu_features(), kChunkBytes);
}

std::uint64_t hash_of(const std::vector<std::uint8_t>& bytes) {
  return std::hash<std::string_view>()({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace

LoggerOnBus::LoggerOnBus(service::Context& context, const std::string& path)
    : context_(context),
      checkpoint_(context),
      interrupted_(interrupted(context, checkpoint_)),
      log_(interrupted_ ? sim::RunLog(interrupted_->path, interrupted_->file_size, kChunkBytes)
                        : new_log(context, path)),
      scorer_(context.scenario().scenario),
      run_(context.identity().run_id),
      board_(context, 0,
             [this](ServiceStatus& status) {
               for (const auto& [topic, stream] : streams_) status.streams.push_back(stream.monitor.status());
               status.queue_depth_max = static_cast<std::uint32_t>(mailbox_.deepest());
               if (status.state == ServiceState::Running) status.message = score::score_so_far(scorer_);
             }),
      credits_(context.participant(), dds::topics::credit()),
      log_words_(context.participant(), dds::topics::credit()) {
  // Callbacks hold indices into the list, and the worker looks them up: it must not move once readers exist.
  channels_.reserve(512);
  const scenario::LoadedScenario& scenario = context.scenario();
  add_stream(context, dds::topics::truth(scenario.truth_grid().hz()));
  for_each_sensor(scenario, [&](auto kind, const auto& sensor) {
    for_each(catalog::SamplesOf<typename decltype(kind)::type>{}, [&](auto sample) {
      using Sample = typename decltype(sample)::type;
      add_stream(context, dds::topics::stream<Sample>(sensor.number, sensor.rate.hz()));
    });
  });
  add_nav_channels(context);
  for_each_sensor(scenario, [this](auto, const auto& sensor) { scorer_.add(sensor.installation, -1); });
  if (scenario.scenario.trajectory.source == scenario::TrajectorySource::VehicleState) add_vehicle_channels(context);
  for_each(catalog::ProfileKinds{},
           [&](auto profile) { add_profile_channels<typename decltype(profile)::type>(context); });
  add_control_channels(context);
  if (interrupted_) go_on();
}

template <class T>
LoggerOnBus::Channel& LoggerOnBus::add_reader(service::Context& context, const dds::Topic<T>& topic, Writers writers) {
  const std::size_t index = channels_.size();
  channels_.emplace_back();
  Channel& channel = channels_.back();
  channel.topic = topic.name;
  const auto enqueue = [this, index](const dds::Received<T>& sample, const dds::SampleOrigin& origin) {
    mailbox_.put({index, sample.cdr, host::realtime_now().count(), origin});
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
    if (!interrupted_ || !is_nav) return channel;
    // What was written while no logger listened was not late: it is logged with the time at which it was written.
    const auto enqueue_kept = [this, index](const dds::Received<T>& sample, const dds::SampleOrigin& origin) {
      const bool was_away = origin.written_realtime_ns < listens_since_realtime_ns_;
      const std::int64_t at_ns = was_away ? origin.written_realtime_ns : host::realtime_now().count();
      mailbox_.put({index, sample.cdr, at_ns, origin, !was_away});
    };
    auto kept =
        std::make_shared<dds::Reader<T>>(context.participant(), dds::topics::kept(topic),
                                         context.writers().only_the_app(stream, is_reference_nav, enqueue_kept));
    channel.is_kept = [kept] { return kept->matched_writers() > 0; };
    channel.reader_of_what_is_kept = kept;
  } else {
    auto reader = std::make_shared<service::SetReader<T>>(context, topic, enqueue);
    channel.matched = [reader] { return reader->matched_writers() > 0; };
    channel.reader = reader;
  }
  return channel;
}

/// A topic that goes to the log as it comes, each message numbered and timed by its arrival.
template <class T>
LoggerOnBus::Channel& LoggerOnBus::add_channel(service::Context& context, const dds::Topic<T>& topic, Writers writers) {
  Channel& channel = add_reader(context, topic, writers);
  channel.log_id = log::LogChannel<T>(log_.file(), topic.name).id();
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
LoggerOnBus::Channel& LoggerOnBus::add_singles(service::Context& context, const dds::Topic<T>& topic) {
  Stream& stream =
      streams_.emplace(topic.name, Stream{streams::StreamMonitor(topic.name, StreamDirection::In), {}}).first->second;
  Channel& singles = add_channel(context, topic);
  singles.take = [this, &stream, &singles](const Message& message) {
    T sample;
    if (!wire::decode(message.bytes.data(), message.bytes.size(), sample)) return;
    if (!note(stream, sample.header, message)) return;
    add_to(scorer_, sample);
    log(singles, sample.header, message, message.bytes);
  };
  return singles;
}

/// A stream that comes as single samples or in blocks, and goes to one channel of the log either way.
template <class T>
void LoggerOnBus::add_stream(service::Context& context, const dds::Topic<T>& topic) {
  Channel& singles = add_singles(context, topic);
  Stream& stream = streams_.at(topic.name);
  Channel& blocks = add_reader<Block<T>>(context, dds::topics::block(topic), Writers::Ours);
  blocks.take = [this, &stream, &singles](const Message& message) {
    Block<T> block;
    if (!wire::decode(message.bytes.data(), message.bytes.size(), block)) return;
    for (const T& sample : block.samples) {
      if (!note(stream, sample.header, message)) continue;
      add_to(scorer_, sample);
      wire::encode(sample, encoded_);
      log(singles, sample.header, message, encoded_);
    }
    if (run_.is_lockstep()) give_credit(stream, true);
  };
}

template <class Profile>
void LoggerOnBus::add_profile_channels(service::Context& context) {
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

/// The answers of the app under test, single or in blocks: they go to one channel of the log either way, each once,
/// however often its writer gives them to a logger that is started again.
void LoggerOnBus::add_nav_channels(service::Context& context) {
  Channel& singles = add_channel(context, dds::topics::nav(), Writers::OneApp);
  singles.on_message = [this](const Message& message) {
    NavSolution solution;
    if (!wire::decode(message.bytes.data(), message.bytes.size(), solution)) return;
    scorer_.add(solution, message.received_realtime_ns);
  };
  const auto log_it = singles.take;
  singles.take = [this, log_it, topic = singles.topic](const Message& message) {
    if (message.follows_what_was_kept) app_messages_.caught_up();
    if (app_messages_.take(topic, message.origin, host::monotonic_now())) log_it(message);
  };
  Channel& blocks = add_reader<Block<NavSolution>>(context, dds::topics::block(dds::topics::nav()), Writers::OneApp);
  blocks.take = [this, log_it, topic = blocks.topic](const Message& message) {
    Block<NavSolution> block;
    if (!wire::decode(message.bytes.data(), message.bytes.size(), block)) return;
    if (message.follows_what_was_kept) app_messages_.caught_up();
    if (!app_messages_.take(topic, message.origin, host::monotonic_now())) return;
    Message single{message.channel, {}, message.received_realtime_ns, message.origin};
    for (const NavSolution& solution : block.samples) {
      wire::encode(solution, single.bytes);
      log_it(single);
    }
  };
  const bool is_required = context.scenario().scenario.require_nav_app;
  singles.matched = blocks.matched = [is_required, in_singles = singles.matched, in_blocks = blocks.matched] {
    return !is_required || in_singles() || in_blocks();
  };
}

void LoggerOnBus::add_vehicle_channels(service::Context& context) {
  const double nominal_hz = context.scenario().scenario.trajectory.vehicle.nominal_rate_hz;
  // It may come late: the barrier of the trajectory server knows whether the run waits for it.
  add_channel(context, dds::topics::vehicle_state(nominal_hz), Writers::OneApp).matched = [] { return true; };
  add_singles(context, dds::topics::vehicle_state_used(nominal_hz));
  add_channel(context, dds::topics::vehicle_link());
}

void LoggerOnBus::add_control_channels(service::Context& context) {
  add_channel(context, dds::topics::installation());
  add_channel(context, dds::topics::time_mark());
  Channel& acks = add_channel(context, dds::topics::profile_ack());
  log_once(acks);
  acks.on_message = [this](const Message& message) {
    ProfileAck ack;
    if (wire::decode(message.bytes.data(), message.bytes.size(), ack)) log_.add_ack(ack);
  };
  add_channel(context, dds::topics::sim_status()).on_message = [this](const Message& message) {
    SimStatus status;
    if (!wire::decode(message.bytes.data(), message.bytes.size(), status)) return;
    const streams::RunFollower::Heard heard = run_.hear(status, host::monotonic_now());
    if (heard == streams::RunFollower::Heard::TheRun) begin_run();
    if (heard == streams::RunFollower::Heard::ItsEnd) change_demands();
    const bool news = heard == streams::RunFollower::Heard::TheRun || heard == streams::RunFollower::Heard::ItsEnd;
    if (news && run_.has_ended()) sent_[dds::topics::truth().name] = run_.truth_samples();
  };
  add_channel(context, dds::topics::service_status()).on_message = [this](const Message& message) {
    ServiceStatus status;
    if (!wire::decode(message.bytes.data(), message.bytes.size(), status)) return;
    services_[{status.service, status.sensor_number}] = {status.state, host::monotonic_now()};
    if (status.state != ServiceState::Finished && status.state != ServiceState::Fault) return;
    for (const StreamStatus& stream : status.streams) {
      if (stream.direction == StreamDirection::Out) sent_[stream.topic] = stream.samples;
    }
  };
}

}  // namespace inslab::truth_logger
