#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "inslab/referee/verify/aids.hpp"
#include "inslab/referee/verify/navigation.hpp"
#include "inslab/referee/verify/outage_figures.hpp"

namespace inslab::verify {

namespace {

/// What a filter must make of an aid: of an index of kDriftNames, how much of the drift without it may be left.
struct Help {
  Aid aid;
  std::size_t figure;
  const char* unit;
  std::array<std::optional<double>, 3> at_most;  ///< of the IMUs in their order; none: twice the combination
};

constexpr double kEitherWay = 2.0;

const std::array<Help, 4> kHelps{{
    {Aid::Barometer, 1, "vertical m", {}},
    {Aid::Odometer, 0, "horizontal m", {1.05, 0.25, 0.25}},
    {Aid::Magnetometer, 4, "yaw deg", {}},
    {Aid::Heading, 4, "yaw deg", {}},
}};

/// Of two that know of each other's errors nothing.
double combined(double a, double b) { return 1.0 / std::hypot(1.0 / a, 1.0 / b); }

Row row_of(const Help& help, std::size_t imu, double without, double with, double outage_s) {
  const double best = combined(without, own_drift(help.aid, outage_s));
  const double least = best / kEitherWay;
  const double most = help.at_most[imu] ? *help.at_most[imu] * without : best * kEitherWay;
  return {{name_of(help.aid), published_drifts()[imu].imu, help.unit, fmt::format("{:.3g}", without),
           fmt::format("{:.3g}", with), fmt::format("{:.2f}", with / without),
           fmt::format("{:.3g} .. {:.3g}", least, most)},
          with >= least && with <= most};
}

}  // namespace

Table aids_table(const OutageRuns& runs, const Subjects& subjects) {
  const auto found = [&](const std::optional<Aid>& aid) {
    return drifts(
        runs.seeds,
        [&](std::uint64_t seed) {
          NavigationSetup setup = thesis_setup(seed, MotionFrom::Parameters, runs.outages);
          setup.duration_s = runs.duration_s;
          if (aid) add(*aid, setup);
          return setup;
        },
        subjects);
  };
  Table table;
  table.title = fmt::format("Outages of {:g} s with another sensor, from parameters ({} seed{})", runs.outages.length_s,
                            runs.seeds, runs.seeds == 1 ? "" : "s");
  table.columns = {"sensor", "IMU", "", "without", "with", "ratio", "limits"};
  const std::vector<DriftFigures> alone = found(std::nullopt);
  for (const Help& help : kHelps) {
    const std::vector<DriftFigures> aided = found(help.aid);
    for (std::size_t imu = 0; imu < aided.size(); ++imu) {
      table.rows.push_back(row_of(help, imu, alone[imu][help.figure], aided[imu][help.figure], runs.outages.length_s));
    }
  }
  table.notes = {
      "The drives of the first table with a sensor that gives 10 samples a second, whose errors each filter is told. "
      "The odometer is on a wheel that neither slides nor leaves the road, which the filter takes it for. The two "
      "antennas keep their signals: fixes are taken from the filter, as the thesis takes them from its file.",
      "Limits: a factor 2 either way about what the drift without the sensor and the sensor's own drift in the "
      "outage "
      "leave when they are combined as independent. Of the odometer, whose way says nothing across it, the upper one "
      "is "
      "a quarter of the drift without; with the navigation grade, whose heading is the better aid, the drift without."};
  return table;
}

}  // namespace inslab::verify
