#include "inslab/referee/verify/navigation.hpp"

#include <fmt/format.h>

#include "inslab/referee/verify/outage_figures.hpp"
#include "inslab/referee/verify/outage_verdict.hpp"

namespace inslab::verify {

namespace {

std::string seeds_text(std::uint64_t seeds) { return fmt::format("{} seed{}", seeds, seeds == 1 ? "" : "s"); }

NavigationSetup shortened(NavigationSetup setup, const OutageRuns& runs) {
  setup.duration_s = runs.duration_s;
  return setup;
}

const char* const kNoteOnMisses =
    "A figure outside is named with what it would have to be multiplied by. MISS: docs/verification.md lists each "
    "figure of the row that is outside, and says why.";

}  // namespace

Table outage_table(const OutageRuns& runs, const Subjects& subjects) {
  const OutageTimes& outages = runs.outages;
  Table table;
  table.judged = outages == OutageTimes{};
  table.title = fmt::format("Outages of {:g} s: horizontal / vertical m; roll pitch yaw deg ({})", outages.length_s,
                            seeds_text(runs.seeds));
  table.columns = {"IMU", "motion", "found"};
  if (table.judged) table.columns.insert(table.columns.end(), {"thesis simulated", "ratio", "outside"});
  for (const MotionFrom motion : runs.motions) {
    const std::vector<DriftFigures> found = drifts(
        runs.seeds, [&](std::uint64_t seed) { return shortened(thesis_setup(seed, motion, outages), runs); }, subjects);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const PublishedDrift& published = published_drifts()[i];
      if (!table.judged) {
        table.rows.push_back({{published.imu, name_of(motion), text_of(found[i])}});
        continue;
      }
      const DriftFigures ratio = ratios(found[i], simulated(published, motion));
      const OutageVerdict verdict = judged(ratio, Against::Simulated, published.imu);
      table.rows.push_back({{published.imu, name_of(motion), text_of(found[i]), text_of(simulated(published, motion)),
                             ratios_text(ratio), verdict.misses},
                            verdict.held,
                            verdict.known_miss});
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
  table.notes.push_back("A row holds when every figure is within a factor 2 of the thesis's, either way.");
  table.notes.emplace_back(kNoteOnMisses);
  return table;
}

Table beyond_table(const OutageRuns& runs, const Subjects& subjects) {
  Table table;
  table.title = fmt::format("Beyond the thesis, against its real figures ({})", seeds_text(runs.seeds));
  table.columns = {"IMU", "motion", "found", "thesis real", "thesis simulated, ratio", "ours, ratio", "outside"};
  for (const MotionFrom motion : runs.motions) {
    const std::vector<DriftFigures> found = drifts(
        runs.seeds, [&](std::uint64_t seed) { return shortened(full_setup(seed, motion), runs); }, subjects);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const PublishedDrift& published = published_drifts()[i];
      const DriftFigures ratio = ratios(found[i], published.real);
      const OutageVerdict verdict = judged(ratio, Against::Measured, published.imu);
      table.rows.push_back(
          {{published.imu, name_of(motion), text_of(found[i]), text_of(published.real),
            ratios_text(ratios(simulated(published, motion), published.real)), ratios_text(ratio), verdict.misses},
           verdict.held,
           verdict.known_miss});
    }
  }
  table.notes = {
      "As above, with the profiles imu/*_full, gnss/rtk_coloured and vibration/car; each filter is told its IMU's "
      "noise, and as an unknown bias what the data sheet lets warming and gravity do.",
      "A row holds when every figure is within a factor 1.5 of the thesis's real one, either way.", kNoteOnMisses};
  return table;
}

std::vector<Table> navigation(bool full, const OutageTimes& outages) {
  OutageRuns runs;
  runs.seeds = full ? 20 : 1;
  runs.outages = outages;
  std::vector<Table> tables{outage_table(runs)};
  if (!(outages == OutageTimes{})) return tables;
  tables.push_back(beyond_table(runs));
  tables.push_back(honesty_table(100));
  tables.push_back(aids_table(runs));
  for (const Aid aid : kAids) tables.push_back(honesty_table(100, aid));
  if (full) tables.push_back(readings_table(5));
  return tables;
}

}  // namespace inslab::verify
