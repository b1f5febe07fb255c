#include "services/truth_logger/logger_on_bus.hpp"

#include "app/exit_code.hpp"
#include "app/host.hpp"
#include "app/service_names.hpp"
#include "app/shutdown.hpp"
#include "io/error.hpp"

namespace inslab::logger {

using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

double rate_hz(const time::Rate& rate) { return 1.0 / rate.period_s(); }

}  // namespace

LoggerOnBus::LoggerOnBus(app::Context& context, const std::string& path)
    : context_(context),
      log_(path, context.scenario(), app::cpu_features()),
      board_(context.participant(), context.service(), 0, [this](ServiceStatus& status) {
        for (const auto& [topic, monitor] : streams_) status.streams.push_back(monitor.status());
        status.queue_depth_max = static_cast<std::uint32_t>(mailbox_.deepest());
      }) {
  // Callbacks hold indices into the list, and the worker looks them up: it must not move once readers exist.
  channels_.reserve(64);
  const scenario::LoadedScenario& scenario = context.scenario();
  add_stream(context, dds::topics::truth(rate_hz(scenario.truth_rate)));
  for (const auto& imu : scenario.imus) {
    add_stream(context, dds::topics::imu(imu.number, rate_hz(imu.rate)));
    add_stream(context, dds::topics::imu_truth(imu.number, rate_hz(imu.rate)));
  }
  for (const auto& gnss : scenario.gnss) add_stream(context, dds::topics::gnss(gnss.number, rate_hz(gnss.rate)));
  add_channel(context, dds::topics::nav(), Writers::Anybody);
  if (scenario.scenario.trajectory.source == scenario::TrajectorySource::VehicleState) add_vehicle_channels(context);
  add_profile_channels<ImuErrorProfile>(context);
  add_profile_channels<VibrationProfile>(context);
  add_profile_channels<InstallationProfile>(context);
  add_profile_channels<GnssErrorProfile>(context);
  add_profile_channels<FaultProfile>(context);
  add_control_channels(context);
}

template <class T>
LoggerOnBus::Channel& LoggerOnBus::add_channel(app::Context& context, const dds::Topic<T>& topic, Writers writers) {
  const std::size_t index = channels_.size();
  channels_.emplace_back();
  Channel& channel = channels_.back();
  channel.topic = topic.name;
  channel.log_id = io::LogChannel<T>(log_.file(), topic.name).id();
  const auto enqueue = [this, index](const dds::Received<T>& sample, const dds::SampleOrigin&) {
    mailbox_.put({index, sample.cdr, app::realtime_now().count()});
  };
  if (writers == Writers::Anybody) {
    channel.reader = std::make_shared<dds::OpenReader<T>>(context.participant(), topic, enqueue);
    channel.matched = [] { return true; };
  } else {
    auto reader = std::make_shared<dds::Reader<T>>(context.participant(), topic, enqueue);
    channel.matched = [reader] { return reader->matched_writers() > 0; };
    channel.reader = reader;
  }
  return channel;
}

template <class T>
void LoggerOnBus::add_stream(app::Context& context, const dds::Topic<T>& topic) {
  streams_.emplace(topic.name, app::StreamMonitor(topic.name, StreamDirection::In));
  app::StreamMonitor& monitor = streams_.at(topic.name);
  add_channel(context, topic).on_message = [this, &monitor](const Message& message, Place& place) {
    T sample;
    if (!wire::decode(message.bytes.data(), message.bytes.size(), sample)) return;
    monitor.received(sample.header, message.received_realtime_ns);
    place = {static_cast<std::uint32_t>(sample.header.sequence_number),
             static_cast<std::uint64_t>(sample.header.publish_realtime_ns)};
    board_.set_run(sample.header.run_id);
    board_.set_sim_time(sample.header.sim_time_ns);
    if (failure_.empty()) board_.enter(ServiceState::Running);
  };
}

template <class Profile>
void LoggerOnBus::add_profile_channels(app::Context& context) {
  add_channel(context, dds::topics::request<Profile>(), Writers::Anybody);
  add_channel(context, dds::topics::journal<Profile>()).on_message = [this](const Message& message, Place&) {
    Profile entry;
    if (wire::decode(message.bytes.data(), message.bytes.size(), entry)) log_.add_profile(entry);
  };
}

void LoggerOnBus::add_vehicle_channels(app::Context& context) {
  const double nominal_hz = context.scenario().scenario.trajectory.vehicle.nominal_rate_hz;
  add_channel(context, dds::topics::vehicle_state(nominal_hz), Writers::Anybody);
  add_stream(context, dds::topics::vehicle_state_used(nominal_hz));
  add_channel(context, dds::topics::vehicle_link());
}

void LoggerOnBus::add_control_channels(app::Context& context) {
  add_channel(context, dds::topics::installation());
  add_channel(context, dds::topics::time_mark());
  add_channel(context, dds::topics::profile_ack()).on_message = [this](const Message& message, Place&) {
    ProfileAck ack;
    if (wire::decode(message.bytes.data(), message.bytes.size(), ack)) log_.add_ack(ack);
  };
  add_channel(context, dds::topics::sim_status()).on_message = [this](const Message& message, Place&) {
    SimStatus status;
    if (!wire::decode(message.bytes.data(), message.bytes.size(), status)) return;
    if (status.state == RunState::Waiting || status.state == RunState::Running || run_ended_) return;
    run_ended_ = true;
    run_ended_at_ = app::monotonic_now();
    sent_[dds::topics::truth().name] = status.truth_samples;
  };
  add_channel(context, dds::topics::service_status()).on_message = [this](const Message& message, Place&) {
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
  Channel& channel = channels_[message.channel];
  const auto received = static_cast<std::uint64_t>(message.received_realtime_ns);
  Place place{channel.count++, received};
  try {
    if (channel.on_message) channel.on_message(message, place);
    if (!failure_.empty()) return;
    log_.file().write(channel.log_id, place.sequence, received, place.publish_time_ns, message.bytes.data(),
                      message.bytes.size());
  } catch (const io::WriteError& error) {
    note_failure(error.what());
  }
}

bool LoggerOnBus::matched() const {
  for (const Channel& channel : channels_) {
    if (!channel.matched()) return false;
  }
  return true;
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

/// Every service has said that it ended, or has been silent for three heartbeats.
bool LoggerOnBus::all_services_ended() const {
  constexpr time::Nanoseconds kSilence = seconds(3);
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
  // Reliable samples that have not come some seconds after the end will not come.
  return run_ended_ &&
         ((all_services_ended() && all_samples_here()) || app::monotonic_now() - run_ended_at_ > seconds(8));
}

int LoggerOnBus::run() {
  time::Nanoseconds next_flush = app::monotonic_now();
  while (!app::shutdown_requested() && !finished()) {
    if (const auto message = mailbox_.take(milliseconds(50))) handle(*message);
    if (board_.state() == ServiceState::Starting && matched()) board_.enter(ServiceState::Ready);
    board_.tick();
    if (app::monotonic_now() < next_flush || !failure_.empty()) continue;
    next_flush = app::monotonic_now() + milliseconds(500);
    try {
      log_.file().flush();
    } catch (const io::WriteError& error) {
      note_failure(error.what());
    }
  }
  return end();
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
  board_.enter(failure_.empty() ? ServiceState::Finished : ServiceState::Fault,
               failure_.empty() && by_signal ? "ended by a signal" : failure_);
  while (const auto message = mailbox_.take(milliseconds(200))) handle(*message);
  try {
    log_.file().close();
  } catch (const io::WriteError& error) {
    note_failure(error.what());
  }
  board_.flush(seconds(2));
  spdlog::info("log {} ({:.1f} MB)", log_.path(), static_cast<double>(log_.file().file_size()) * 1e-6);
  if (!failure_.empty()) spdlog::error("{}", failure_);
  return failure_.empty() ? app::kOk : app::kFailed;
}

}  // namespace inslab::logger
