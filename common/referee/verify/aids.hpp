#pragma once

#include "inslab/referee/verify/navigation_runs.hpp"

namespace inslab::verify {

/// A sensor that helps the filter beside GNSS.
enum class Aid { Barometer, Odometer, Magnetometer, Heading };

inline const std::vector<Aid> kAids{Aid::Barometer, Aid::Odometer, Aid::Magnetometer, Aid::Heading};

const char* name_of(Aid aid);

/// Puts it into the car, and its errors into what the filters are told. What is the same all the time in a sensor, and
/// in the air about it, is drawn by the setup's seed from what the filters believe of it; drifts the run draws.
///
/// Barometer: a BMP388's noise, the weather's and its own drift, an air of another pressure and temperature, a port
/// that shows a part of the dynamic pressure. Odometer: an encoder on the rear left wheel, whose axis is not quite as
/// the filters are told, and a tyre that drifts. Magnetometer: an RM3100 in a vehicle that is calibrated to 150 nT.
/// Heading: two antennas 2 m apart, which keep their signals in the outages.
void add(Aid aid, NavigationSetup& setup);

/// What the aid itself drifts by in an outage of that length, RMS: a barometer's height m, an odometer's way m, the
/// heading of a magnetometer or of two antennas deg. No filter can be better by the aid alone.
double own_drift(Aid aid, double outage_s);

}  // namespace inslab::verify
