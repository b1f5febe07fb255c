#pragma once

#include <optional>
#include <vector>

#include "inslab/data/profiles/installation_profile.hpp"
#include "inslab/referee/score/true_pose.hpp"

namespace inslab::score {

/// Where the app's IMU and antenna truly sit, and from when on.
class Mountings {
 public:
  Mountings(const std::optional<std::uint32_t>& imu_number, const std::optional<std::uint32_t>& gnss_number)
      : imu_number_(imu_number), gnss_number_(gnss_number) {}

  /// Where a sensor sits after `apply_at_ns`; -1: from the start. Other sensors are passed over.
  void add(const InstallationProfile& installation, std::int64_t apply_at_ns);

  /// That of a reference point; an antenna has the vehicle's axes.
  Mounting at(ReferencePoint point, std::int64_t sim_time_ns) const;

 private:
  struct MovedTo {
    std::int64_t apply_at_ns;
    Mounting mounting;
  };

  std::optional<std::uint32_t> imu_number_;
  std::optional<std::uint32_t> gnss_number_;
  std::vector<MovedTo> imu_;
  std::vector<MovedTo> antenna_;
};

}  // namespace inslab::score
