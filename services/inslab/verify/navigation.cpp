#include "services/inslab/verify/navigation.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "samples/units.hpp"
#include "services/inslab/verify/catalogue.hpp"
#include "services/inslab/verify/estimates.hpp"
#include "services/inslab/verify/navigation_runs.hpp"

namespace inslab::verify {

namespace {

constexpr double kFactor = 2.0;
constexpr std::uint64_t kFirstSeed = 1;

/// Horizontal m, vertical m, roll deg, pitch deg, yaw deg.
using Figures = std::array<double, 5>;

struct PublishedImu {
  const char* name;
  Figures from_parameters;
  Figures from_file;
  Figures real;
};
/// Thesis tables 4-11 to 4-13.
constexpr PublishedImu kPublished[] = {
    {"pos830",
     {0.545, 0.112, .0013, .0014, .0129},
     {0.490, 0.084, .0015, .0014, .0152},
     {0.686, 0.149, .0016, .0018, .0196}},
    {"stim300", {7.24, 1.26, .033, .053, .088}, {4.78, 1.26, .030, .030, .063}, {7.38, 1.98, .102, .120, .173}},
    {"adis16488", {11.36, 1.67, .066, .065, .250}, {10.09, 1.58, .058, .068, .166}, {26.25, 3.59, .194, .236, .485}}};

std::vector<ImuErrorProfile> published_imus() {
  std::vector<ImuErrorProfile> imus;
  for (const PublishedImu& imu : kPublished) {
    imus.push_back(catalogue_profile<ImuErrorProfile>(std::string("imu/") + imu.name));
  }
  return imus;
}

/// Root mean squares over all runs of one IMU.
Figures pooled(const std::vector<NavigationRun>& runs) {
  Figures sums{};
  double outages = 0.0;
  for (const NavigationRun& run : runs) {
    for (const OutageDrift& drift : run.outages) {
      sums[0] += drift.horizontal_m * drift.horizontal_m;
      sums[1] += drift.vertical_m * drift.vertical_m;
      outages += 1.0;
    }
    for (int i = 0; i < 3; ++i)
      sums[static_cast<std::size_t>(i) + 2] += std::pow(run.attitude_rms_rad[i] / units::kDeg, 2);
  }
  for (std::size_t i = 0; i < 5; ++i)
    sums[i] = std::sqrt(sums[i] / (i < 2 ? outages : static_cast<double>(runs.size())));
  return sums;
}

bool within_factor(const Figures& found, const Figures& published) {
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double ratio = found[i] / published[i];
    if (!(ratio <= kFactor && ratio >= 1.0 / kFactor)) return false;
  }
  return true;
}

std::string text_of(const Figures& f) {
  return fmt::format("{:.3g} / {:.3g}; {:.2g} {:.2g} {:.2g}", f[0], f[1], f[2], f[3], f[4]);
}

}  // namespace

Table outage_table(std::uint64_t seeds) {
  Table table;
  table.title = fmt::format("Outages of 60 s: horizontal / vertical m; roll pitch yaw deg ({} seed{})", seeds,
                            seeds == 1 ? "" : "s");
  table.columns = {"IMU", "motion", "found", "thesis simulated", "thesis real"};
  const std::vector<ImuErrorProfile> imus = published_imus();
  std::size_t outages = 0;
  for (const bool from_file : {false, true}) {
    std::vector<std::vector<NavigationRun>> runs(imus.size());
    NavigationSetup setup;
    setup.imus = imus;
    setup.gnss_rate_hz = 1.0;
    setup.gnss_velocity = false;
    if (from_file) setup.file = car_as_file(setup.duration_s);
    for (setup.seed = kFirstSeed; setup.seed < kFirstSeed + seeds; ++setup.seed) {
      const std::vector<NavigationRun> of_seed = navigate(setup);
      for (std::size_t i = 0; i < imus.size(); ++i) runs[i].push_back(of_seed[i]);
    }
    outages = runs.front().front().outages.size();
    for (std::size_t i = 0; i < imus.size(); ++i) {
      const Figures found = pooled(runs[i]);
      const Figures& published = from_file ? kPublished[i].from_file : kPublished[i].from_parameters;
      table.rows.push_back({{kPublished[i].name, from_file ? "from a file" : "from parameters", text_of(found),
                             text_of(published), text_of(kPublished[i].real)},
                            within_factor(found, published)});
    }
  }
  table.notes = {fmt::format(
      "The catalogue's car for 20 minutes at 200 Hz, RTK positions at 1 Hz, always fixed, {} outages from 420 s on, "
      "one "
      "every 120 s; the filter matches the IMU's profile; no zero-velocity updates. Drift: root mean square "
      "over the outages of the largest error in each. Attitude: root mean square from the first outage on. A "
      "row holds when each of its figures is within a factor {} of the thesis's simulated one.",
      outages, kFactor)};
  return table;
}

Table honesty_table(std::uint64_t runs) {
  NavigationSetup setup;
  setup.imus = {catalogue_profile<ImuErrorProfile>("imu/stim300")};
  setup.duration_s = 40.0;
  setup.first_outage_s = 1e9;
  setup.nees_every_s = 10.0;
  std::vector<Estimates> nees;
  double innovation_sum = 0.0, innovation_count = 0.0;
  for (setup.seed = kFirstSeed; setup.seed < kFirstSeed + runs; ++setup.seed) {
    const NavigationRun run = navigate(setup).front();
    nees.resize(run.nees.size());
    for (std::size_t i = 0; i < run.nees.size(); ++i) nees[i].add(run.nees[i]);
    for (const double nis : run.innovations) innovation_sum += nis, innovation_count += 1.0;
  }
  Table table;
  table.title = fmt::format("The filter against its own covariance: {} runs", runs);
  table.columns = {"", "mean", "expected", "95 % band"};
  const auto add = [&table](const std::string& what, double mean, double degrees, double count) {
    const double half = 1.96 * std::sqrt(2.0 * degrees / count);
    table.rows.push_back({{what, fmt::format("{:.3f}", mean), fmt::format("{:.0f}", degrees),
                           fmt::format("{:.3f} .. {:.3f}", degrees - half, degrees + half)},
                          std::abs(mean - degrees) <= half});
  };
  for (std::size_t i = 0; i < nees.size(); ++i) {
    add(fmt::format("NEES after {:.0f} s", setup.nees_every_s * static_cast<double>(i + 1)), nees[i].mean(), 9.0,
        static_cast<double>(runs));
  }
  add("squared innovations", innovation_sum / innovation_count, 3.0, innovation_count);
  table.notes = {
      "stim300 and the filter that matches it, begun at the truth plus errors drawn from the initial covariance. The "
      "mean "
      "of n independent chi-square numbers of d degrees is d +- 1.96 sqrt(2 d / n) in 95 of 100 cases."};
  return table;
}

std::vector<Table> navigation(bool full) { return {outage_table(full ? 20 : 1), honesty_table(100)}; }

}  // namespace inslab::verify
