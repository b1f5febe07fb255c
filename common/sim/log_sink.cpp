#include "inslab/sim/log_sink.hpp"

#include "inslab/data/catalog/topic_names.hpp"
#include "inslab/foundation/host/host.hpp"

namespace inslab::cli {

LogSink::LogSink(const std::string& path, const scenario::LoadedScenario& scenario, const time::GpsTime& start)
    : log_(path, scenario, app::cpu_features(), logger::RunLog::kChunkBytes, io::OutputFile::Kind::Result),
      utc_of_sim_time_zero_ns_(static_cast<std::uint64_t>(time::realtime_from_gps(start).count())),
      latest_utc_ns_(utc_of_sim_time_zero_ns_),
      truth_(log_.file(), wire::topic_names::kTruth),
      acks_(log_.file(), wire::topic_names::kProfileAck),
      journals_(journal_channel<ImuErrorProfile>(), journal_channel<VibrationProfile>(),
                journal_channel<InstallationProfile>(), journal_channel<GnssErrorProfile>(),
                journal_channel<FaultProfile>()) {
  for (const auto& sensor : scenario.imus) {
    imu_.emplace_back(log_.file(), wire::topic_names::imu(sensor.number));
    imu_truth_.emplace_back(log_.file(), wire::topic_names::imu_truth(sensor.number));
  }
  for (const auto& sensor : scenario.gnss) gnss_.emplace_back(log_.file(), wire::topic_names::gnss(sensor.number));
  if (scenario.scenario.reference_nav) nav_.emplace(log_.file(), wire::topic_names::kNav);
}

template <class T>
void LogSink::write(io::LogChannel<T>& channel, const T& sample, const StreamHeader& header) {
  latest_utc_ns_ = utc_of_sim_time_zero_ns_ + static_cast<std::uint64_t>(header.sim_time_ns);
  channel.write(sample, static_cast<std::uint32_t>(header.sequence_number), latest_utc_ns_, latest_utc_ns_);
}

template <class Profile>
io::LogChannel<Profile> LogSink::journal_channel() {
  return {log_.file(), wire::topic_names::journal(Profile::kind)};
}

void LogSink::journal(const AnyProfile& entry) {
  log_.add_profile(entry);
  std::visit(
      [this](const auto& profile) {
        auto& channel = std::get<io::LogChannel<std::decay_t<decltype(profile)>>>(journals_);
        channel.write(profile, journal_count_++, latest_utc_ns_, latest_utc_ns_);
      },
      entry);
}

void LogSink::vehicle_state(const UsedVehicleState& used) {
  if (!vehicle_states_) vehicle_states_.emplace(log_.file(), wire::topic_names::kVehicleStateUsed);
  write(*vehicle_states_, used, used.header);
}

void LogSink::truth(const TruthState& truth) { write(truth_, truth, truth.header); }

void LogSink::imu(std::size_t index, const ImuSample& sample, const ImuTruth& truth) {
  write(imu_[index], sample, sample.header);
  write(imu_truth_[index], truth, truth.header);
}

void LogSink::gnss(std::size_t index, const GnssFix& fix) { write(gnss_[index], fix, fix.header); }

void LogSink::nav(const NavSolution& solution) { nav_->write(solution, nav_count_++, latest_utc_ns_, latest_utc_ns_); }

void LogSink::ack(const ProfileAck& ack) {
  log_.add_ack(ack);
  acks_.write(ack, ack_count_++, latest_utc_ns_, latest_utc_ns_);
}

}  // namespace inslab::cli
