#pragma once

#include <string>

#include "services/inslab/allan/analysis.hpp"

namespace inslab::cli {

/// The recording, each axis's fitted parameters with their intervals, and the Allan deviations, for people.
std::string report_text(const ImuAnalysis& analysis);

/// All points: axis, tau_s, deviation and its 99 % interval, the fitted curve; rad/s and m/s^2.
std::string curve_csv(const ImuAnalysis& analysis);

/// A gnuplot script that draws the curves with their bands and fits into a PNG, in deg/h and mGal.
std::string curve_plot(const ImuAnalysis& analysis, const std::string& png);

}  // namespace inslab::cli
