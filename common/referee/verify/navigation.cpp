#include "inslab/referee/verify/navigation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "inslab/referee/verify/outage_figures.hpp"

namespace inslab::verify {

namespace {

std::string seeds_text(std::uint64_t seeds) { return fmt::format("{} seed{}", seeds, seeds == 1 ? "" : "s"); }

/// Differences to the real figures, %.
DriftFigures differences(const DriftFigures& figures, const DriftFigures& real) {
  DriftFigures percent{};
  for (std::size_t i = 0; i < figures.size(); ++i) percent[i] = 100.0 * std::abs(figures[i] - real[i]) / real[i];
  return percent;
}

std::string percents(const DriftFigures& p) {
  return fmt::format("{:.0f} {:.0f}; {:.0f} {:.0f} {:.0f}", p[0], p[1], p[2], p[3], p[4]);
}

}  // namespace

Table outage_table(std::uint64_t seeds, const std::vector<MotionFrom>& motions, const OutageTimes& outages) {
  Table table;
  table.judged = outages == OutageTimes{};
  table.title = fmt::format("Outages of {:g} s: horizontal / vertical m; roll pitch yaw deg ({})", outages.length_s,
                            seeds_text(seeds));
  table.columns = {"IMU", "motion", "found"};
  if (table.judged) table.columns.insert(table.columns.end(), {"thesis simulated", "ratio", ""});
  for (const MotionFrom motion : motions) {
    const std::vector<DriftFigures> found =
        drifts(seeds, [&](std::uint64_t seed) { return thesis_setup(seed, motion, outages); });
    for (std::size_t i = 0; i < found.size(); ++i) {
      const PublishedDrift& published = published_drifts()[i];
      if (!table.judged) {
        table.rows.push_back({{published.imu, name_of(motion), text_of(found[i])}});
        continue;
      }
      const DriftFigures ratio = ratios(found[i], simulated(published, motion));
      table.rows.push_back(
          {{published.imu, name_of(motion), text_of(found[i]), text_of(simulated(published, motion)),
            fmt::format("{:.2f} {:.2f}; {:.2f} {:.2f} {:.2f}", ratio[0], ratio[1], ratio[2], ratio[3], ratio[4]),
            verdict(ratio)},
           none_is_worse(ratio)});
    }
  }
  table.notes = {
      fmt::format("20 minutes at 200 Hz, RTK positions at 1 Hz (0.03 m, white), outages of {:g} s every {:g} s from "
                  "{:g} s on, and again one and two thirds of that later; no zero-velocity updates; each filter is "
                  "told its IMU's errors.",
                  outages.length_s, outages.spacing_s, outages.first_s),
      "Figures: RMS over the outages of the largest error in each. From parameters: the catalogue's car; from a file: "
      "the recorded solution of another drive, by inverse mechanization."};
  if (!table.judged) return table;
  table.notes.push_back(
      "A row fails where a figure is more than twice the thesis's. Below half of it, the figure is named: the filter's "
      "own covariance, which the table below tests, says what it should be.");
  return table;
}

Table beyond_table(std::uint64_t seeds) {
  Table table;
  table.title = fmt::format("Beyond the thesis: differences to its real figures ({})", seeds_text(seeds));
  table.columns = {"IMU", "motion", "found", "thesis real", "thesis simulated differs %", "ours differs %", "closer"};
  for (const MotionFrom motion : {MotionFrom::Parameters, MotionFrom::File}) {
    const std::vector<DriftFigures> found =
        drifts(seeds, [motion](std::uint64_t seed) { return full_setup(seed, motion); });
    for (std::size_t i = 0; i < found.size(); ++i) {
      const PublishedDrift& published = published_drifts()[i];
      const DriftFigures thesis = differences(simulated(published, motion), published.real);
      const DriftFigures ours = differences(found[i], published.real);
      int closer = 0;
      for (std::size_t k = 0; k < ours.size(); ++k) closer += ours[k] < thesis[k] ? 1 : 0;
      table.rows.push_back({{published.imu, name_of(motion), text_of(found[i]), text_of(published.real),
                             percents(thesis), percents(ours), fmt::format("{} of 5", closer)},
                            true});
    }
  }
  table.notes = {
      "As above, with the profiles imu/*_full, gnss/rtk_coloured and vibration/car; each filter is told its IMU's "
      "noise, and as an unknown bias what the data sheet lets warming and gravity do.",
      "Differences: of the figures in their order, as a share of the real one (thesis (4-6), (4-7))."};
  table.judged = false;
  return table;
}

std::vector<Table> navigation(bool full, const OutageTimes& outages) {
  const std::uint64_t seeds = full ? 20 : 1;
  std::vector<Table> tables{outage_table(seeds, {MotionFrom::Parameters, MotionFrom::File}, outages)};
  if (!(outages == OutageTimes{})) return tables;
  tables.push_back(beyond_table(seeds));
  tables.push_back(honesty_table(100));
  if (full) tables.push_back(readings_table(5));
  return tables;
}

}  // namespace inslab::verify
