#pragma once

#include <optional>

#include "inslab/foundation/fields/field.hpp"

namespace inslab::scenario {

/// A figure of docs/scoring.md; its name carries the unit.
enum class Metric : std::uint32_t {
  HorizontalRms,
  HorizontalMax,
  Cep50,
  Cep95,
  VerticalRms,
  VerticalMax,
  Vertical50,
  Vertical95,
  VelocityRms,
  TiltRms,
  HeadingRms,
  PositionNees,
  VelocityNees,
  AttitudeNees,
  // Of the whole run alone, from here on.
  OutageDriftRms,
  OutageDriftMax,
  OutageVerticalDriftRms,
  OutageVerticalDriftMax,
  LatencyP50,
  LatencyP99,
  LatencyMax,
  Rate,
  LongestGap,
  TimeToFirstSolution,
  Stale,
  Future,
  NonFinite,
  Duplicates,
  OutOfOrder,
};

/// Metrics of single solutions have a figure in each phase; counts, latencies and drifts belong to the run.
constexpr bool is_of_the_run(Metric metric) { return metric >= Metric::OutageDriftRms; }

constexpr bool is_latency(Metric metric) { return metric >= Metric::LatencyP50 && metric <= Metric::LatencyMax; }

enum class Phase : std::uint32_t { All, Outages, BetweenOutages, SwapInterval };

/// A limit that the app under test must keep.
struct AcceptanceLimit {
  Metric metric = Metric::HorizontalRms;
  Phase phase = Phase::All;
  std::uint32_t swap_interval = 0;
  double after_s = 0.0;
  std::optional<double> at_most;
  std::optional<double> at_least;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("metric", "a figure of docs/scoring.md").required(), self.metric);
    visit(Field("phase", "the solutions that count; figures of the whole run have no other than all"), self.phase);
    visit(Field("swap_interval", "phase swap_interval: how many swaps came before it").in(0.0, 10000.0),
          self.swap_interval);
    visit(Field("after_s", "sim time before which solutions do not count: the app converges").in(0.0, 1e7),
          self.after_s);
    visit(Field("at_most", "in the unit of the metric").in(-1e12, 1e12), self.at_most);
    visit(Field("at_least", "in the unit of the metric").in(-1e12, 1e12), self.at_least);
  }
};

}  // namespace inslab::scenario

namespace inslab {

template <>
struct EnumNames<scenario::Metric> {
  static constexpr std::string_view type = "Metric";
  static constexpr std::string_view prefix = "METRIC_";
  static constexpr std::array<std::string_view, 29> values{"horizontal_rms_m",
                                                           "horizontal_max_m",
                                                           "cep50_m",
                                                           "cep95_m",
                                                           "vertical_rms_m",
                                                           "vertical_max_m",
                                                           "vertical50_m",
                                                           "vertical95_m",
                                                           "velocity_rms_m_per_s",
                                                           "tilt_rms_deg",
                                                           "heading_rms_deg",
                                                           "position_nees",
                                                           "velocity_nees",
                                                           "attitude_nees",
                                                           "outage_drift_rms_m",
                                                           "outage_drift_max_m",
                                                           "outage_vertical_drift_rms_m",
                                                           "outage_vertical_drift_max_m",
                                                           "latency_p50_ms",
                                                           "latency_p99_ms",
                                                           "latency_max_ms",
                                                           "rate_hz",
                                                           "longest_gap_s",
                                                           "time_to_first_solution_s",
                                                           "stale",
                                                           "future",
                                                           "non_finite",
                                                           "duplicates",
                                                           "out_of_order"};
};
template <>
struct EnumNames<scenario::Phase> {
  static constexpr std::string_view type = "Phase";
  static constexpr std::string_view prefix = "PHASE_";
  static constexpr std::array<std::string_view, 4> values{"all", "outages", "between_outages", "swap_interval"};
};

static_assert(EnumNames<scenario::Metric>::values.size() == static_cast<std::size_t>(scenario::Metric::OutOfOrder) + 1,
              "a metric has no name");

}  // namespace inslab
