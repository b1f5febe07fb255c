#pragma once

#include <deque>
#include <tuple>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/sim/offline_run.hpp"
#include "inslab/sim/run_log.hpp"

namespace inslab::sim {

/// Writes an offline run to the same log as the truth logger does; log times are the GPS time of validity, as UTC.
class LogSink : public RunSink {
 public:
  /// Throws files::WriteError, as all its functions do.
  LogSink(const std::string& path, const scenario::LoadedScenario& scenario, const time::GpsTime& start);

  void journal(const catalog::AnyProfile& entry) override;
  void vehicle_state(const UsedVehicleState& used) override;
  void truth(const TruthState& truth) override;
  void imu(std::size_t index, const ImuSample& sample, const ImuTruth& truth) override;
  void gnss(std::size_t index, const GnssFix& fix) override;
  void pulse(std::size_t index, const PulsePerSecond& sample, const PulseTruth& truth) override;
  void magnetometer(std::size_t index, const MagneticField& sample) override;
  void barometer(std::size_t index, const AirPressure& sample) override;
  void odometer(std::size_t index, const WheelTravel& sample) override;
  void heading(std::size_t index, const BaselineHeading& sample) override;
  void air_data(std::size_t index, const Airflow& sample, const AirflowTruth& truth) override;
  void nav(const NavSolution& solution) override;
  void ack(const ProfileAck& ack) override;

  void close() { log_.file().close(); }
  std::uint64_t file_size() { return log_.file().file_size(); }

 private:
  template <class T>
  void write(log::LogChannel<T>& channel, const T& sample, const StreamHeader& header);
  template <class... Sample>
  void write_streams(std::size_t index, const Sample&... samples);

  RunLog log_;
  std::uint64_t utc_of_sim_time_zero_ns_;
  std::uint64_t latest_utc_ns_;
  log::LogChannel<TruthState> truth_;
  std::optional<log::LogChannel<UsedVehicleState>> vehicle_states_;
  log::LogChannel<ProfileAck> acks_;
  Applied<std::tuple, Mapped<log::LogChannel, catalog::ProfileKinds>> journals_;
  template <class Sample>
  using Channels = std::deque<log::LogChannel<Sample>>;  // by the sensor's index
  Applied<std::tuple, Mapped<Channels, catalog::SensorSamples>> streams_;
  std::optional<log::LogChannel<NavSolution>> nav_;
  std::uint32_t ack_count_ = 0;
  std::uint32_t nav_count_ = 0;
  std::uint32_t journal_count_ = 0;
};

}  // namespace inslab::sim
