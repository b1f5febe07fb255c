#pragma once

#include <filesystem>
#include <memory>

#include "inslab/data/samples/trajectory_file.hpp"
#include "inslab/foundation/time/grid.hpp"
#include "inslab/scenario/scenario.hpp"

namespace inslab::scenario {

/// One IMU with its profiles read.
struct LoadedImu {
  std::uint32_t number = 0;
  time::Rate rate{200.0};
  ImuErrorProfile errors;
  VibrationProfile vibration;
  InstallationProfile installation;
  InstallationProfile nominal_installation;
};

/// One GNSS receiver with its profiles read.
struct LoadedGnss {
  std::uint32_t number = 0;
  time::Rate rate{5.0};
  GnssErrorProfile errors;
  InstallationProfile installation;
  InstallationProfile nominal_installation;
  std::vector<Outage> outages;
  std::vector<OutageArea> outage_areas;
};

/// A scenario with every file it names read and checked.
struct LoadedScenario {
  std::filesystem::path file;
  Scenario scenario;
  time::Rate truth_rate{200.0};     ///< what the scenario asks for
  std::uint64_t truth_samples = 0;  ///< of truth_grid(), sample 0 included
  /// What the trajectory's file says, judged by its limits; null when the trajectory has none. Its rows reach from sim
  /// time 0 to the last sample at least, and they have what the method needs.
  std::shared_ptr<const io::TrajectoryFile> trajectory_file;
  std::vector<LoadedImu> imus;
  std::vector<LoadedGnss> gnss;
  std::vector<AnyProfile> swaps;  ///< requests in order: target and request are filled in
  std::string unit;               ///< the vehicle's name on the network; empty: it has none

  /// When the truth has samples: at its own rate, and at every instant of a sensor.
  time::Grid truth_grid() const;
  /// GPS time of sim time 0; with `start: now` that of `realtime_now` (CLOCK_REALTIME).
  time::GpsTime start(time::Nanoseconds realtime_now) const;
  /// The seed of the random streams: the scenario's, or, for a unit with a name, one drawn from that and the name, so
  /// that no two units share a stream.
  std::uint64_t stream_seed() const;
  /// The gravity that the scenario's options describe.
  nav::Gravity gravity() const;
  /// Throws config::Error when the scenario has no such sensor.
  const LoadedImu& imu_number(std::uint32_t number) const;
  const LoadedGnss& gnss_number(std::uint32_t number) const;
};

/// The rows of a trajectory file: hours of them take hundreds of megabytes, and only who makes the truth needs them.
enum class TrajectoryRows { Read, LeaveOut };

/// Reads a scenario and everything it names, for the vehicle called `unit`. Throws config::Error naming file, path in
/// it and reason.
LoadedScenario load(const std::filesystem::path& file, const std::string& unit = {},
                    TrajectoryRows rows = TrajectoryRows::Read);

/// Reads a profile file of that kind, checks its limits and rules for the given target. Throws config::Error.
AnyProfile load_profile(const std::filesystem::path& file, ProfileKind kind, const SensorAddress& target);

/// The requests of a list of swaps, in order, numbered from `first_request_id`; profile files relative to `folder`.
/// Throws config::Error as load_profile() does.
std::vector<AnyProfile> load_swaps(const std::vector<ScheduledSwap>& swaps, const std::filesystem::path& folder,
                                   std::uint64_t first_request_id);

/// Reads a schedule of swaps and everything it names. Throws config::Error naming file, path in it and reason.
std::vector<AnyProfile> load_schedule(const std::filesystem::path& file, std::uint64_t first_request_id);

}  // namespace inslab::scenario
