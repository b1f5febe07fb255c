#pragma once

#include "inslab/data/samples/broadcast_ionosphere.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/nav/geodesy.hpp"

namespace inslab::atmosphere {

/// Delay of the code at L1 in the ionosphere, s, for a satellite at that azimuth and elevation, rad; at another
/// frequency it is (f1/f)^2 times that, and the phase is early by as much. Source: IS-GPS-200, 20.3.3.5.2.5 and figure
/// 20-4.
double klobuchar_delay_s(const BroadcastIonosphere& broadcast, const nav::Geodetic& antenna, double azimuth_rad,
                         double elevation_rad, const time::GpsTime& gps);

}  // namespace inslab::atmosphere
