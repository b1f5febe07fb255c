#include "inslab/referee/report/report_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::report {

namespace {

using scenario::Metric;
using scenario::Phase;

constexpr const char* kLimitStyle = "lines linewidth 2 dashtype 4 linecolor rgb '#b86a00'";

std::vector<tables::Band> outages_of(const score::LogScore& score) {
  std::vector<tables::Band> bands;
  for (const score::OutageDrift& outage : score.scorer.outages()) {
    bands.push_back({time::to_seconds(outage.begin_ns), time::to_seconds(outage.end_ns)});
  }
  return bands;
}

/// What lies between the bands, which are in order.
std::vector<tables::Band> between(const std::vector<tables::Band>& bands, double end_s) {
  std::vector<tables::Band> gaps;
  double from_s = 0.0;
  for (const tables::Band& band : bands) {
    gaps.push_back({from_s, band.begin});
    from_s = band.end;
  }
  gaps.push_back({from_s, end_s});
  return gaps;
}

bool is_drift(Metric metric) { return metric >= Metric::OutageDriftRms && metric <= Metric::OutageVerticalDriftMax; }

std::vector<tables::Band> judged_stretches(const scenario::AcceptanceLimit& limit, const score::LogScore& score,
                                           double end_s) {
  std::vector<tables::Band> bands{{0.0, end_s}};
  if (limit.phase == Phase::Outages || is_drift(limit.metric)) bands = outages_of(score);
  if (limit.phase == Phase::BetweenOutages) bands = between(outages_of(score), end_s);
  if (limit.phase == Phase::SwapInterval) {
    const score::SwapIntervals& intervals = score.intervals;
    bands = {{intervals.begin_s(limit.swap_interval), std::min(end_s, intervals.begin_s(limit.swap_interval + 1))}};
  }
  std::vector<tables::Band> judged;
  for (const tables::Band& band : bands) {
    const double begin = std::max(band.begin, limit.after_s);
    if (begin < band.end) judged.push_back({begin, band.end});
  }
  return judged;
}

tables::Curve level(const std::string& title, double value, const std::vector<tables::Band>& stretches) {
  constexpr double kPause = std::numeric_limits<double>::quiet_NaN();
  tables::Curve curve{title, {}, {}, kLimitStyle};
  for (const tables::Band& stretch : stretches) {
    curve.x.insert(curve.x.end(), {stretch.begin, stretch.end, kPause});
    curve.y.insert(curve.y.end(), {value, value, kPause});
  }
  return curve;
}

}  // namespace

std::string page_id_of(Metric metric) {
  switch (metric) {
    case Metric::HorizontalRms:
    case Metric::HorizontalMax:
    case Metric::Cep50:
    case Metric::Cep95:
    case Metric::VerticalRms:
    case Metric::VerticalMax:
    case Metric::Vertical50:
    case Metric::Vertical95:
    case Metric::OutageDriftRms:
    case Metric::OutageDriftMax:
    case Metric::OutageVerticalDriftRms:
    case Metric::OutageVerticalDriftMax:
      return page_id::kSizes;
    case Metric::VelocityRms:
    case Metric::TiltRms:
    case Metric::HeadingRms:
      return page_id::kMotionSizes;
    case Metric::PositionNees:
    case Metric::VelocityNees:
    case Metric::AttitudeNees:
      return page_id::kHonesty;
    case Metric::LatencyP50:
    case Metric::LatencyP99:
    case Metric::LatencyMax:
      return page_id::kLatency;
    case Metric::Rate:
    case Metric::LongestGap:
    case Metric::TimeToFirstSolution:
    case Metric::Stale:
    case Metric::Future:
    case Metric::NonFinite:
    case Metric::Duplicates:
    case Metric::OutOfOrder:
      return page_id::kApp;
  }
  return page_id::kApp;
}

std::vector<tables::Curve> limit_curves(const std::vector<Metric>& metrics, const score::LogScore& score,
                                        double end_s) {
  std::vector<tables::Curve> curves;
  for (const score::Verdict& verdict : score.verdicts) {
    const scenario::AcceptanceLimit& limit = verdict.limit;
    if (std::find(metrics.begin(), metrics.end(), limit.metric) == metrics.end()) continue;
    const std::vector<tables::Band> stretches = judged_stretches(limit, score, end_s);
    if (stretches.empty()) continue;
    const auto add = [&](const char* which, const std::optional<double>& value) {
      if (value) {
        curves.push_back(level(fmt::format("{} {} {:.4g}", enum_name(limit.metric), which, *value), *value, stretches));
      }
    };
    add("at most", limit.at_most);
    add("at least", limit.at_least);
  }
  return curves;
}

std::vector<tables::Curve> latency_limit_curves(const score::LogScore& score, double height) {
  std::vector<tables::Curve> curves;
  for (const score::Verdict& verdict : score.verdicts) {
    if (!scenario::is_latency(verdict.limit.metric)) continue;
    for (const auto& value : {verdict.limit.at_most, verdict.limit.at_least}) {
      if (!value || !(*value > 0.0)) continue;
      curves.push_back({fmt::format("{} {} {:.4g}", enum_name(verdict.limit.metric),
                                    value == verdict.limit.at_most ? "at most" : "at least", *value),
                        {*value, *value},
                        {0.0, height},
                        kLimitStyle});
    }
  }
  return curves;
}

}  // namespace inslab::report
