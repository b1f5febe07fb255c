#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "inslab/referee/verify/aids.hpp"
#include "inslab/referee/verify/estimates.hpp"
#include "inslab/referee/verify/navigation.hpp"
#include "inslab/referee/verify/outage_figures.hpp"
#include "inslab/referee/verify/town_drive.hpp"

namespace inslab::verify {

namespace {

constexpr double kRun_s = 100.0;
constexpr double kOutageBegins_s = 40.0;

/// The car does not slide, and a filter that is honest of it is told so: the least that it can be told.
constexpr navigation::RollingConstraint kNoSlide{true, 1e-4, 1e-4, 0.0};

/// A hundred seconds of a town's traffic with fixes of position and velocity at 5 Hz, and an outage at their end.
NavigationSetup short_drive(std::uint64_t seed) {
  NavigationSetup setup = thesis_setup(seed, MotionFrom::Parameters);
  setup.motion = town_drive(seed, 0.0, kRun_s);
  setup.duration_s = kRun_s;
  setup.gnss_rate_hz = 5.0;
  setup.gnss_velocity = true;
  setup.outages.first_s = kOutageBegins_s;
  setup.shifts_s = {0.0};
  setup.nees_at_s = {10.0, 20.0, 30.0, kOutageBegins_s, kRun_s - 1.0};
  return setup;
}

struct Consistency {
  std::vector<Estimates> nees;  ///< at each instant
  double innovations = 0.0;     ///< sum of squares
  double innovation_count = 0.0;

  void add(const NavigationRun& run) {
    nees.resize(run.nees.size());
    for (std::size_t i = 0; i < run.nees.size(); ++i) nees[i].add(run.nees[i]);
    for (const double nis : run.innovations) innovations += nis, innovation_count += 1.0;
  }
};

/// How many standard deviations of the mean a row is allowed, and how often an honest one is within them.
struct Band {
  double half;
  const char* words;
};
constexpr Band kOfFewRows{1.96, "95 % band"};
/// Of 90 rows in all four or five would be outside the other.
constexpr Band kOfManyRows{3.29, "99.9 % band"};

Row row_of(const char* imu, const std::string& what, double mean, double degrees, double count, const Band& band) {
  const double half = band.half * std::sqrt(2.0 * degrees / count);
  return {{imu, what, fmt::format("{:.3f}", mean), fmt::format("{:.0f}", degrees),
           fmt::format("{:.3f} .. {:.3f}", degrees - half, degrees + half)},
          std::abs(mean - degrees) <= half};
}

}  // namespace

Table honesty_table(std::uint64_t runs, const std::optional<Aid>& aid, const Subjects& subjects) {
  std::vector<Consistency> found(published_drifts().size());
  for (std::uint64_t seed = 1; seed <= runs; ++seed) {
    NavigationSetup setup = short_drive(seed);
    if (aid) add(*aid, setup);
    if (setup.odometer) setup.odometer->constraint = kNoSlide;
    const std::vector<NavigationRun> of_imu = navigate(setup, subjects);
    for (std::size_t i = 0; i < of_imu.size(); ++i) found[i].add(of_imu[i]);
  }
  Table table;
  const Band& band = aid ? kOfManyRows : kOfFewRows;
  table.title = fmt::format("The filter{} against its own covariance: {} drives",
                            aid ? fmt::format(" beside the {}", name_of(*aid)) : "", runs);
  table.columns = {"IMU", "", "mean", "expected", band.words};
  const std::vector<double> at_s = short_drive(1).nees_at_s;
  for (std::size_t imu = 0; imu < found.size(); ++imu) {
    const char* name = published_drifts()[imu].imu;
    for (std::size_t i = 0; i < at_s.size(); ++i) {
      const std::string what = at_s[i] <= kOutageBegins_s
                                   ? fmt::format("NEES after {:.0f} s", at_s[i])
                                   : fmt::format("NEES after {:.0f} s of outage", at_s[i] - kOutageBegins_s);
      table.rows.push_back(row_of(name, what, found[imu].nees[i].mean(), 9.0, static_cast<double>(runs), band));
    }
    table.rows.push_back(row_of(name, "squared innovations", found[imu].innovations / found[imu].innovation_count, 3.0,
                                found[imu].innovation_count, band));
  }
  table.notes = {
      "The IMUs as the thesis simulates them, each with the filter that matches it, begun at the truth plus errors "
      "drawn from the initial covariance. The mean of n independent chi-square numbers of d degrees is "
      "d +- 1.96 sqrt(2 d / n) in 95 of 100 cases, and d +- 3.29 sqrt(2 d / n) in 999 of 1000."};
  return table;
}

}  // namespace inslab::verify
