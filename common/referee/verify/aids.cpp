#include "inslab/referee/verify/aids.hpp"

#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/standard_atmosphere.hpp"
#include "inslab/noise/random/stream.hpp"

namespace inslab::verify {

namespace {

namespace air = nav::standard_atmosphere;

constexpr double kWeather_pa = 30.0, kWeather_s = 7200.0;
constexpr double kBarometer_pa = 3.0, kBarometer_s = 1800.0;
constexpr double kTyre_ppm = 300.0, kTyre_s = 1800.0;
constexpr double kRoad_m_per_sqrt_m = 0.002;
constexpr double kIron_nt = 150.0, kIron_s = 3600.0;
constexpr double kMultipath_m = 0.0023, kMultipath_s = 100.0;
/// A car in a town.
constexpr double kTownSpeed_m_per_s = 10.0;
/// Across the compass, where the catalogue's car drives.
constexpr double kHorizontalField_nt = 33500.0;

/// How far a Gauss-Markov process moves from where it was: RMS of the furthest in a time that is short beside its own.
/// The squared largest of a random walk's sizes is in the mean 2 G times its variance at the end, G = 0.9160 Catalan's
/// constant: it is distributed as 1/tau, tau the time in which the walk leaves (-1, 1), and E(1/tau) is the integral of
/// u / cosh(u).
double moved(double sigma, double correlation_s, double after_s) {
  constexpr double kLargestByEnd = 1.3535;
  return kLargestByEnd * sigma * std::sqrt(2.0 * -std::expm1(-after_s / correlation_s));
}

/// A BMP388's noise and drift; the air is somewhat another day's.
void add_barometer(NavigationSetup& setup) {
  BarometerErrorProfile believed;
  believed.white_sigma_pa = 1.2;
  believed.gm_sigma_pa = kBarometer_pa;
  believed.gm_correlation_time_s = kBarometer_s;
  believed.sea_level_pressure_gm_sigma_pa = kWeather_pa;
  believed.sea_level_pressure_gm_correlation_time_s = kWeather_s;
  believed.sea_level_pressure_pa = air::kSeaLevelPressurePa + 600.0;
  believed.temperature_deviation_deg_c = 6.0;
  believed.static_pressure_coefficient = 0.08;
  const random::Stream draws(setup.seed, "verify/barometer");
  BarometerErrorProfile errors = believed;
  errors.sea_level_pressure_pa = air::kSeaLevelPressurePa + 600.0 * draws.normal(0);
  errors.temperature_deviation_deg_c *= draws.normal(1);
  errors.static_pressure_coefficient *= draws.normal(2);
  setup.barometer = TestedBarometer{errors, believed};
}

void add_odometer(NavigationSetup& setup) {
  TestedOdometer& odometer = setup.odometer.emplace();
  odometer.errors.scale_factor_turn_on_sigma_ppm = 3000.0;
  odometer.errors.scale_factor_gm_sigma_ppm = kTyre_ppm;
  odometer.errors.scale_factor_gm_correlation_time_s = kTyre_s;
  odometer.errors.noise_m_per_sqrt_m = kRoad_m_per_sqrt_m;
  const random::Stream draws(setup.seed, "verify/odometer");
  odometer.axis_off_rpy_deg = odometer.axis_sigma_deg * Vector3(0.0, draws.normal(0), draws.normal(1));
}

/// As an RM3100 has it in a vehicle that is calibrated to 150 nT and 0.003: the same every time, which a Gauss-Markov
/// process of an hour draws anew for each seed.
void add_magnetometer(NavigationSetup& setup) {
  MagnetometerErrorProfile& errors = setup.magnetometer.emplace();
  errors.white_sigma_nt.setConstant(15.0);
  errors.quantization_nt.setConstant(13.3);
  errors.gm_sigma_nt.setConstant(kIron_nt);
  errors.gm_correlation_time_s.setConstant(kIron_s);
  errors.soft_iron << 0.003, 0.001, 0.0, 0.001, -0.002, 0.001, 0.0, 0.001, 0.002;
}

/// As a mosaic-H has it (config/profiles/heading), always fixed.
void add_heading(NavigationSetup& setup) {
  HeadingErrorProfile& errors = setup.heading.emplace().errors;
  errors.relative_sigma_ned_m = {0.0013, 0.0013, 0.0022};
  errors.relative_gm_sigma_ned_m = {kMultipath_m, kMultipath_m, 0.0038};
  errors.relative_gm_correlation_time_s.setConstant(kMultipath_s);
}

}  // namespace

const char* name_of(Aid aid) {
  switch (aid) {
    case Aid::Barometer:
      return "barometer";
    case Aid::Odometer:
      return "odometer";
    case Aid::Magnetometer:
      return "magnetometer";
    case Aid::Heading:
      return "two antennas";
  }
  return "?";
}

void add(Aid aid, NavigationSetup& setup) {
  switch (aid) {
    case Aid::Barometer:
      return add_barometer(setup);
    case Aid::Odometer:
      return add_odometer(setup);
    case Aid::Magnetometer:
      return add_magnetometer(setup);
    case Aid::Heading:
      return add_heading(setup);
  }
}

double own_drift(Aid aid, double outage_s) {
  const double way_m = kTownSpeed_m_per_s * outage_s;
  switch (aid) {
    case Aid::Barometer: {
      const double metres_per_pa =
          air::kGasConstantJPerKgK * air::kSeaLevelTemperatureK / (air::kGMPerS2 * air::kSeaLevelPressurePa);
      return metres_per_pa *
             std::hypot(moved(kWeather_pa, kWeather_s, outage_s), moved(kBarometer_pa, kBarometer_s, outage_s));
    }
    case Aid::Odometer:
      // The scale's move grows with the way, so that its mean is that of a third of the variance.
      return std::hypot(kRoad_m_per_sqrt_m * std::sqrt(way_m),
                        units::kPpm * way_m * moved(kTyre_ppm, kTyre_s, outage_s) / std::sqrt(3.0));
    case Aid::Magnetometer:
      return moved(kIron_nt, kIron_s, outage_s) / kHorizontalField_nt / units::kDeg;
    case Aid::Heading:
      return moved(kMultipath_m, kMultipath_s, outage_s) / TestedHeading{}.baseline_m / units::kDeg;
  }
  return 0.0;
}

}  // namespace inslab::verify
