#pragma once

#include <string>
#include <vector>

#include "inslab/formats/tables/picture.hpp"
#include "inslab/referee/score/score_log.hpp"

namespace inslab::report {

/// Names of the places of a report that acceptance lines point to.
namespace page_id {
inline constexpr const char* kSizes = "position-sizes";
inline constexpr const char* kMotionSizes = "velocity-and-attitude-sizes";
inline constexpr const char* kHonesty = "honesty";
inline constexpr const char* kLatency = "latency";
inline constexpr const char* kApp = "navigation-app";
}  // namespace page_id

/// Where the report draws, or for counts and rates tells, what a metric is about.
std::string page_id_of(scenario::Metric metric);

/// The limits that the scenario sets to any of these metrics, each a level line over the sim times that it judges: of a
/// phase its stretches, of the whole run [0, end]. A limit whose stretches never came has no line.
std::vector<tables::Curve> limit_curves(const std::vector<scenario::Metric>& metrics, const score::LogScore& score,
                                        double end_s);

/// Limits to latencies as upright lines of this height.
std::vector<tables::Curve> latency_limit_curves(const score::LogScore& score, double height);

}  // namespace inslab::report
