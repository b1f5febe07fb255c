#pragma once

#include <string>

#include "inslab/formats/tables/picture.hpp"
#include "inslab/referee/calibrate/analysis.hpp"

namespace inslab::calibrate {

/// The recording, each axis's fitted parameters with their intervals, and the Allan deviations, for people.
std::string report_text(const ImuAnalysis& analysis);

/// All points: axis, tau_s, deviation and its 99 % interval, the fitted curve; rad/s and m/s^2.
std::string curve_csv(const ImuAnalysis& analysis);

/// The curves with their bands and fits, in deg/h and mGal.
tables::Picture curve_picture(const ImuAnalysis& analysis);

}  // namespace inslab::calibrate
