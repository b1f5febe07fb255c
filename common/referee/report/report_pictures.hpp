#pragma once

#include <string>
#include <vector>

#include "inslab/formats/tables/picture.hpp"
#include "inslab/referee/report/report_expectation.hpp"

namespace inslab::report {

/// The errors of an app over time, thinned to what a picture can show.
class ErrorCurves {
 public:
  void add(const score::ScoredSolution& scored);
  bool empty() const { return points_.empty(); }

  /// Errors in NED with three sigmas about 0, reported and expected, outages shaded, swaps marked.
  tables::Picture position(const score::LogScore& score, const evidence::LogSummary& summary,
                           const Expectation& expectation) const;
  tables::Picture velocity(const score::LogScore& score, const evidence::LogSummary& summary,
                           const Expectation& expectation) const;
  tables::Picture attitude(const score::LogScore& score, const evidence::LogSummary& summary,
                           const Expectation& expectation) const;
  /// Sizes of the errors over time by logarithms, beside one sigma of both kinds and the limits of the acceptance: what
  /// a drift in an outage hides from the eye in position(). First of horizontal and vertical position, then of
  /// velocity, tilt and heading.
  tables::Picture sizes(const score::LogScore& score, const evidence::LogSummary& summary,
                        const Expectation& expectation) const;
  tables::Picture motion_sizes(const score::LogScore& score, const evidence::LogSummary& summary,
                               const Expectation& expectation) const;
  /// Squared error over the reported variance, summed over the axes, of position, velocity and attitude over time
  /// beside the 3 that honest sigmas give, with the limits of the acceptance. Without panels when the app reports no
  /// sigmas.
  tables::Picture honesty(const score::LogScore& score, const evidence::LogSummary& summary) const;
  /// The true track and the app's, north over east from the first point.
  tables::Picture track() const;

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
  struct Size;
  tables::Picture size_panels(const std::string& title, const std::vector<Size>& sizes, const score::LogScore& score,
                              const evidence::LogSummary& summary, const Expectation& expectation) const;
  tables::Picture errors(std::size_t which, const std::string& title, const std::string& unit,
                         const score::LogScore& score, const evidence::LogSummary& summary,
                         const Expectation& expectation) const;

  double end_s() const { return points_.empty() ? 0.0 : points_.back().t_s; }

  std::vector<Point> points_;
  std::uint64_t added_ = 0;
  std::uint64_t keep_every_ = 1;
};

/// How many solutions had which latency, with the limits of the acceptance.
tables::Picture latency_picture(const score::LogScore& score);

}  // namespace inslab::report
