#include "inslab/referee/verify/outage_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/referee/verify/catalogue.hpp"
#include "inslab/referee/verify/town_drive.hpp"

namespace inslab::verify {

namespace {

constexpr double kStanding_s = 300.0;  // as long as the catalogue's car

ImuErrorProfile imu_profile(const char* imu, const char* kind) {
  return catalogue_profile<ImuErrorProfile>(std::string("imu/") + imu + kind);
}

}  // namespace

const std::array<PublishedDrift, 3>& published_drifts() {
  static const std::array<PublishedDrift, 3> drifts{{
      {"pos830",
       {0.5448, 0.1121, .0013, .0014, .0129},
       {0.4903, 0.0843, .0015, .0014, .0152},
       {0.6856, 0.1489, .0016, .0018, .0196}},
      {"stim300", {7.239, 1.256, .033, .053, .088}, {4.779, 1.257, .030, .030, .063}, {7.382, 1.984, .102, .120, .173}},
      {"adis16488",
       {11.358, 1.668, .066, .065, .250},
       {10.085, 1.577, .058, .068, .166},
       {26.246, 3.588, .194, .236, .485}},
  }};
  return drifts;
}

NavigationSetup thesis_setup(std::uint64_t seed, MotionFrom motion, const OutageTimes& outages) {
  NavigationSetup setup;
  setup.outages = outages;
  setup.shifts_s = {0.0, outages.spacing_s / 3.0, 2.0 * outages.spacing_s / 3.0};
  setup.seed = seed;
  setup.gnss = catalogue_profile<GnssErrorProfile>("gnss/rtk_white");
  for (const PublishedDrift& published : published_drifts()) {
    const ImuErrorProfile errors = imu_profile(published.imu, "_thesis");
    setup.imus.push_back({errors, errors, {}});
  }
  if (motion == MotionFrom::File) {
    setup.motion.source = scenario::TrajectorySource::File;
    setup.file = recorded_drive(seed, kStanding_s, setup.duration_s);
  } else {
    setup.motion = catalogue_scenario("vehicle").trajectory;
  }
  return setup;
}

NavigationSetup full_setup(std::uint64_t seed, MotionFrom motion) {
  NavigationSetup setup = thesis_setup(seed, motion);
  setup.gnss = catalogue_profile<GnssErrorProfile>("gnss/rtk_coloured");
  auto vibration = catalogue_profile<VibrationProfile>("vibration/car");
  vibration.domain = VibrationDomain::Motion;  // the truth, too, sways with the car
  for (std::size_t i = 0; i < setup.imus.size(); ++i) {
    setup.imus[i].errors = imu_profile(published_drifts()[i].imu, "_full");
    setup.imus[i].believed = setup.imus[i].errors;
    setup.imus[i].vibration = vibration;
  }
  return setup;
}

const char* name_of(MotionFrom motion) { return motion == MotionFrom::File ? "from a file" : "from parameters"; }

const DriftFigures& simulated(const PublishedDrift& published, MotionFrom motion) {
  return motion == MotionFrom::File ? published.from_file : published.from_parameters;
}

DriftFigures ratios(const DriftFigures& found, const DriftFigures& expected) {
  DriftFigures ratios{};
  for (std::size_t i = 0; i < ratios.size(); ++i) ratios[i] = found[i] / expected[i];
  return ratios;
}

DriftFigures drift_of(const std::vector<NavigationRun>& runs) {
  DriftFigures figures{};
  double outages = 0.0;
  for (const NavigationRun& run : runs) {
    for (const OutageDrift& drift : run.outages) {
      const Vector3 attitude_deg = drift.attitude_rad / units::kDeg;
      const DriftFigures largest{drift.horizontal_m, drift.vertical_m, attitude_deg.x(), attitude_deg.y(),
                                 attitude_deg.z()};
      for (std::size_t i = 0; i < figures.size(); ++i) figures[i] += largest[i] * largest[i];
      outages += 1.0;
    }
  }
  for (double& figure : figures) figure = std::sqrt(figure / outages);
  return figures;
}

std::vector<DriftFigures> drifts(std::uint64_t seeds, const std::function<NavigationSetup(std::uint64_t seed)>& setup,
                                 const Subjects& subjects) {
  std::vector<std::vector<NavigationRun>> of_imu;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const NavigationSetup one = setup(seed);
    of_imu.resize(one.imus.size());
    const std::vector<NavigationRun> runs = navigate(one, subjects);
    for (std::size_t i = 0; i < runs.size(); ++i) of_imu[i / one.shifts_s.size()].push_back(runs[i]);
  }
  std::vector<DriftFigures> figures;
  for (const std::vector<NavigationRun>& runs : of_imu) figures.push_back(drift_of(runs));
  return figures;
}

std::string text_of(const DriftFigures& f) {
  return fmt::format("{:.3g} / {:.3g}; {:.2g} {:.2g} {:.2g}", f[0], f[1], f[2], f[3], f[4]);
}

std::string ratios_text(const DriftFigures& r) {
  return fmt::format("{:.2f} {:.2f}; {:.2f} {:.2f} {:.2f}", r[0], r[1], r[2], r[3], r[4]);
}

}  // namespace inslab::verify
