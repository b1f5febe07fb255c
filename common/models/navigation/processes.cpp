#include "inslab/models/navigation/processes.hpp"

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/navigation/matching_gravity.hpp"

namespace inslab::navigation {

namespace {

Process wheel_scale(const OdometerBelief& wheel) {
  return {units::kPpm * Vector3(wheel.scale_factor_sigma_ppm, wheel.scale_factor_drift_sigma_ppm, 0.0),
          {0.0, wheel.scale_factor_drift_correlation_time_s, 0.0}};
}

}  // namespace

Process process_of(StateBlock block, const NavigationParameters& p) {
  switch (block) {
    case StateBlock::GyroBias:
      return {units::kDegPerH * p.gyro.bias_sigma_deg_per_h, p.gyro.bias_correlation_time_s};
    case StateBlock::AccelBias:
      return {units::kMGal * p.accel.bias_sigma_mgal, p.accel.bias_correlation_time_s};
    case StateBlock::GyroScale:
      return {units::kPpm * p.gyro.scale_factor_sigma_ppm, p.gyro.scale_factor_correlation_time_s};
    case StateBlock::AccelScale:
      return {units::kPpm * p.accel.scale_factor_sigma_ppm, p.accel.scale_factor_correlation_time_s};
    case StateBlock::HardIron:
      return {p.magnetometer.hard_iron_sigma_nt, p.magnetometer.hard_iron_correlation_time_s};
    case StateBlock::SoftIronX:
      return {p.magnetometer.soft_iron_sigma.segment<3>(0), Vector3::Zero()};
    case StateBlock::SoftIronY:
      return {p.magnetometer.soft_iron_sigma.segment<3>(3), Vector3::Zero()};
    case StateBlock::SoftIronZ:
      return {p.magnetometer.soft_iron_sigma.segment<3>(6), Vector3::Zero()};
    case StateBlock::EarthField:
      return {p.magnetometer.earth_field_sigma_ned_nt, p.magnetometer.earth_field_correlation_time_s};
    case StateBlock::PressureBias:
      return {p.barometer.bias_sigma_m, p.barometer.bias_correlation_time_s};
    case StateBlock::PressureSlope:
      return {{p.barometer.height_scale_sigma, p.barometer.static_pressure_sigma, 0.0}, Vector3::Zero()};
    case StateBlock::WheelScale:
      return wheel_scale(p.odometer);
    case StateBlock::OtherWheelScale:
      return wheel_scale(p.other_odometer);
    case StateBlock::WheelAxis:
      return {Vector3::Constant(units::kDeg * p.odometer.axis_sigma_deg), Vector3::Zero()};
    case StateBlock::BaselineDrift:
      return {p.heading.relative_drift_sigma_ned_m, p.heading.relative_drift_correlation_time_s};
    case StateBlock::Gravity:
    case StateBlock::GravityChange:
      return {along_way_of(p.gravity_disturbance).sigma_n, Vector3::Zero()};
    case StateBlock::Position:
    case StateBlock::Velocity:
    case StateBlock::Attitude:
      break;  // the mechanization's
  }
  return {};
}

StateVector initial_sigmas(const NavigationParameters& p) {
  const StateLayout layout(p.states);
  StateVector sigmas(layout.size());
  sigmas.head<kNavStates>() << p.initial.position_sigma_ned_m, p.initial.velocity_sigma_ned_m_per_s,
      units::kDeg * p.initial.attitude_sigma_ned_deg;
  layout.for_each_chosen([&](StateBlock block) {
    sigmas.segment(layout.first(block), size_of(block)) = process_of(block, p).sigma.head(size_of(block));
  });
  return sigmas;
}

}  // namespace inslab::navigation
