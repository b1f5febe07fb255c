#pragma once

#include <string>
#include <vector>

#include "io/picture.hpp"
#include "services/inslab/report_expectation.hpp"

namespace inslab::cli {

/// The errors of an app over time, thinned to what a picture can show.
class ErrorCurves {
 public:
  void add(const score::ScoredSolution& scored);
  bool empty() const { return points_.empty(); }

  /// Errors in NED with three sigmas about 0, reported and expected, outages shaded, swaps marked.
  io::Picture position(const LogScore& score, const LogSummary& summary, const Expectation& expectation) const;
  io::Picture velocity(const LogScore& score, const LogSummary& summary, const Expectation& expectation) const;
  io::Picture attitude(const LogScore& score, const LogSummary& summary, const Expectation& expectation) const;
  /// Sizes of the horizontal and the vertical error over time by logarithms, beside one sigma of both kinds: what a
  /// drift in an outage hides from the eye in position().
  io::Picture sizes(const LogScore& score, const LogSummary& summary, const Expectation& expectation) const;
  /// The true track and the app's, north over east from the first point.
  io::Picture track() const;

  /// Of the points that are kept, in outages or between them.
  ErrorRatios ratios(const Expectation& expectation, bool in_outages) const;

 private:
  struct Point {
    double t_s;
    bool in_outage;
    Vector3 error[3];  ///< m, m/s, deg
    Vector3 sigma[3];
    nav::Geodetic truth;
  };
  io::Picture errors(std::size_t which, const std::string& title, const std::string& unit, const LogScore& score,
                     const LogSummary& summary, const Expectation& expectation) const;

  std::vector<Point> points_;
  std::uint64_t added_ = 0;
  std::uint64_t keep_every_ = 1;
};

/// How many solutions had which latency.
io::Picture latency_picture(const score::Quantiles& latency_s);

}  // namespace inslab::cli
