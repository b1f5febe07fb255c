#include "inslab/sim/log_sink.hpp"

#include <algorithm>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/foundation/host/host.hpp"

namespace inslab::sim {

namespace {

template <class... Profile>
std::tuple<log::LogChannel<Profile>...> journal_channels(mcap::McapWriter& log, Types<Profile...>) {
  return std::tuple<log::LogChannel<Profile>...>(
      log::LogChannel<Profile>(log, catalog::journal_topic(Profile::kind))...);
}

}  // namespace

LogSink::LogSink(const std::string& path, const scenario::LoadedScenario& scenario, const time::GpsTime& start)
    : log_(path, scenario, host::cpu_features(), RunLog::kChunkBytes, files::OutputFile::Kind::Result),
      utc_of_sim_time_zero_ns_(static_cast<std::uint64_t>(time::realtime_from_gps(start).count())),
      latest_utc_ns_(utc_of_sim_time_zero_ns_),
      truth_(log_.file(), catalog::kTruth.name),
      acks_(log_.file(), catalog::kProfileAck.name),
      journals_(journal_channels(log_.file(), catalog::ProfileKinds{})) {
  for_each_sensor(scenario, [this](auto kind, const auto& sensor) {
    for_each(catalog::SamplesOf<typename decltype(kind)::type>{}, [&](auto sample) {
      using Sample = typename decltype(sample)::type;
      std::get<Channels<Sample>>(streams_).emplace_back(log_.file(), catalog::stream_topic<Sample>(sensor.number));
    });
  });
  if (scenario.scenario.reference_nav) nav_.emplace(log_.file(), catalog::kNav.name);
}

template <class T>
void LogSink::write(log::LogChannel<T>& channel, const T& sample, const StreamHeader& header) {
  // What a fault held back was put out later than it is valid.
  latest_utc_ns_ = std::max(latest_utc_ns_, utc_of_sim_time_zero_ns_ + static_cast<std::uint64_t>(header.sim_time_ns));
  channel.write(sample, static_cast<std::uint32_t>(header.sequence_number), latest_utc_ns_, latest_utc_ns_);
}

void LogSink::journal(const catalog::AnyProfile& entry) {
  log_.add_profile(entry);
  std::visit(
      [this](const auto& profile) {
        auto& channel = std::get<log::LogChannel<std::decay_t<decltype(profile)>>>(journals_);
        channel.write(profile, journal_count_++, latest_utc_ns_, latest_utc_ns_);
      },
      entry);
}

void LogSink::vehicle_state(const UsedVehicleState& used) {
  if (!vehicle_states_) vehicle_states_.emplace(log_.file(), catalog::kVehicleStateUsed.name);
  write(*vehicle_states_, used, used.header);
}

void LogSink::truth(const TruthState& truth) { write(truth_, truth, truth.header); }

template <class... Sample>
void LogSink::write_streams(std::size_t index, const Sample&... samples) {
  (write(std::get<Channels<Sample>>(streams_)[index], samples, samples.header), ...);
}

void LogSink::imu(std::size_t index, const ImuSample& sample, const ImuTruth& truth) {
  write_streams(index, sample, truth);
}

void LogSink::gnss(std::size_t index, const GnssFix& fix) { write_streams(index, fix); }
void LogSink::pulse(std::size_t index, const PulsePerSecond& sample, const PulseTruth& truth) {
  write_streams(index, sample, truth);
}
void LogSink::magnetometer(std::size_t index, const MagneticField& sample) { write_streams(index, sample); }
void LogSink::barometer(std::size_t index, const AirPressure& sample) { write_streams(index, sample); }
void LogSink::odometer(std::size_t index, const WheelTravel& sample) { write_streams(index, sample); }
void LogSink::heading(std::size_t index, const BaselineHeading& sample) { write_streams(index, sample); }
void LogSink::air_data(std::size_t index, const Airflow& sample, const AirflowTruth& truth) {
  write_streams(index, sample, truth);
}

void LogSink::nav(const NavSolution& solution) { nav_->write(solution, nav_count_++, latest_utc_ns_, latest_utc_ns_); }

void LogSink::ack(const ProfileAck& ack) {
  log_.add_ack(ack);
  acks_.write(ack, ack_count_++, latest_utc_ns_, latest_utc_ns_);
}

}  // namespace inslab::sim
