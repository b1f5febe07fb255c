#pragma once

#include "inslab/data/catalog/any_profile.hpp"
#include "inslab/data/requests/run_control.hpp"
#include "inslab/data/samples/air_pressure.hpp"
#include "inslab/data/samples/airflow_truth.hpp"
#include "inslab/data/samples/baseline_heading.hpp"
#include "inslab/data/samples/gnss_fix.hpp"
#include "inslab/data/samples/imu_sample.hpp"
#include "inslab/data/samples/imu_truth.hpp"
#include "inslab/data/samples/magnetic_field.hpp"
#include "inslab/data/samples/nav_solution.hpp"
#include "inslab/data/samples/pulse_per_second.hpp"
#include "inslab/data/samples/truth_state.hpp"
#include "inslab/data/samples/vehicle_state.hpp"
#include "inslab/data/samples/wheel_travel.hpp"

namespace inslab::sim {

/// Where the samples of an offline run go; every function is called in the order of sim time.
class RunSink {
 public:
  virtual ~RunSink() = default;
  virtual void journal(const catalog::AnyProfile& entry) = 0;
  virtual void vehicle_state(const UsedVehicleState&) {}  ///< of a live vehicle only
  virtual void truth(const TruthState& truth) = 0;
  virtual void imu(std::size_t index, const ImuSample& sample, const ImuTruth& truth) = 0;
  virtual void gnss(std::size_t index, const GnssFix& fix) = 0;
  virtual void pulse(std::size_t, const PulsePerSecond&, const PulseTruth&) {}
  virtual void magnetometer(std::size_t, const MagneticField&) {}
  virtual void barometer(std::size_t, const AirPressure&) {}
  virtual void odometer(std::size_t, const WheelTravel&) {}
  virtual void heading(std::size_t, const BaselineHeading&) {}
  virtual void air_data(std::size_t, const Airflow&, const AirflowTruth&) {}
  virtual void nav(const NavSolution&) {}  ///< of the reference navigation app, when the scenario has it
  virtual void ack(const ProfileAck& ack) = 0;
};

}  // namespace inslab::sim
