#pragma once

#include <cmath>
#include <functional>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/heading/heading_model.hpp"
#include "inslab/nav/attitude.hpp"

/// A receiver with two antennas and truths to show it.
namespace inslab::heading::scene {

constexpr std::int64_t kPeriodNs = 100000000;

/// 2 m along the nose, without errors, at 10 Hz.
inline HeadingModel::Setup setup() {
  HeadingModel::Setup s{{42, 0, time::Rate(10.0), {}, {}}, {}, {}};
  s.installation.target.kind = SensorKind::Heading;
  s.installation.lever_arm_v_m = {0.5, 0.2, -1.0};
  s.installation.second_lever_arm_v_m = {2.5, 0.2, -1.0};
  return s;
}

/// The first antenna at the vehicle's reference point, whose NED then is the vehicle's own.
inline InstallationProfile from_the_reference_point(InstallationProfile installation) {
  installation.second_lever_arm_v_m -= installation.lever_arm_v_m;
  installation.lever_arm_v_m.setZero();
  return installation;
}

inline TruthState truth_at(std::uint64_t k, double roll_deg = 0.0, double pitch_deg = 0.0, double yaw_deg = 0.0) {
  TruthState truth;
  truth.header.sim_time_ns = static_cast<std::int64_t>(k) * kPeriodNs;
  truth.interval_ns = kPeriodNs;
  truth.latitude_rad = 0.84;
  truth.longitude_rad = 0.2;
  truth.height_m = 500.0;
  truth.q_nv = nav::quaternion_from_rpy({roll_deg * units::kDeg, pitch_deg * units::kDeg, yaw_deg * units::kDeg});
  return truth;
}

inline FaultProfile fault(const std::function<void(FaultProfile&)>& change) {
  FaultProfile profile;
  profile.target.kind = SensorKind::Heading;
  change(profile);
  return profile;
}

}  // namespace inslab::heading::scene
