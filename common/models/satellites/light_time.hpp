#pragma once

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/models/satellites/satellite_state.hpp"

/// The way of a signal from a satellite to an antenna.
namespace inslab::satellites {

/// An antenna at an instant: GPS time and a rest of less than a nanosecond.
struct AntennaState {
  time::GpsTime gps;
  double rest_s = 0.0;
  Vector3 r_e_m = Vector3::Zero();
  Vector3 v_e_m_per_s = Vector3::Zero();
};

/// What the antenna sees of a satellite. The satellite's time is that of transmission.
struct Sight {
  double light_time_s = 0.0;
  double light_time_rate = 0.0;      ///< its derivative by the antenna's GPS time
  Vector3 line_e = Vector3::Zero();  ///< unit, from the antenna to the satellite, in e at reception
  double clock_s = 0.0;              ///< the satellite's clock minus GPS time, at transmission
  double drift_s_per_s = 0.0;        ///< its derivative by GPS time
};

/// A state that the light times of a satellite begin from: some time before reception, a whole number of nanoseconds.
struct Departure {
  SatelliteState state;
  time::Nanoseconds before_reception{0};
};

/// About the light time of a satellite: 77 ms of medium orbits, 125 ms of geosynchronous ones.
time::Nanoseconds usual_light_time(double radius_m);

/// c tau = |R_Z(w tau) r_s(t - tau) - r(t)|, by fixed point on the second-order course of the satellite from its
/// departure state (2e-8 m from full iteration at 30 ms), and its derivative with what Earth rotation and the moving
/// time of transmission have in it: first-order terms are 0.1 mm and 1-3 mm/s off.
Sight sight(const Departure& departure, const AntennaState& antenna);

/// Azimuth from north over east, and elevation above the horizon, rad.
struct AzimuthElevation {
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;
};
AzimuthElevation direction_of(const Vector3& line_e, const Matrix3& C_en);

}  // namespace inslab::satellites
