#include <fmt/format.h>

#include "inslab/referee/verify/aids.hpp"
#include "inslab/referee/verify/catalogue.hpp"
#include "inslab/referee/verify/navigation.hpp"
#include "inslab/referee/verify/outage_figures.hpp"
#include "inslab/referee/verify/town_drive.hpp"

namespace inslab::verify {

namespace {

struct Reading {
  const char* what;
  void (*apply)(NavigationSetup& setup);
};

/// In the IMUs and in what their filters are told.
template <class Change>
void change_errors(NavigationSetup& setup, Change change) {
  for (std::size_t i = 0; i < setup.imus.size(); ++i) {
    change(setup.imus[i].errors, i);
    setup.imus[i].believed = setup.imus[i].errors;
  }
}

void set_scale_factors(NavigationSetup& setup, const std::array<double, 3>& ppm) {
  change_errors(setup, [&ppm](ImuErrorProfile& imu, std::size_t i) {
    imu.gyro.scale_factor_gm_sigma_ppm = imu.accel.scale_factor_gm_sigma_ppm = Vector3::Constant(ppm[i]);
  });
}

void set_correlation_time(NavigationSetup& setup, double time_s) {
  change_errors(setup, [time_s](ImuErrorProfile& imu, std::size_t) {
    for (Vector3* of : {&imu.gyro.bias_gm_correlation_time_s, &imu.gyro.scale_factor_gm_correlation_time_s,
                        &imu.accel.bias_gm_correlation_time_s, &imu.accel.scale_factor_gm_correlation_time_s}) {
      of->setConstant(time_s);
    }
  });
}

/// Cross-axis angles as large as the gyros' scale factor (2.5.1 gives both the same range), unknown to the filters.
void add_cross_axis(NavigationSetup& setup) {
  for (TestedImu& imu : setup.imus) {
    const double arcsec =
        imu.errors.gyro.scale_factor_gm_sigma_ppm.x() * 1e-6 * 180.0 / 3.14159265358979323846 * 3600.0;
    imu.errors.gyro.cross_axis_arcsec << arcsec, -arcsec, arcsec, arcsec, -arcsec, arcsec;
    imu.errors.accel.cross_axis_arcsec = -imu.errors.gyro.cross_axis_arcsec;
  }
}

/// What KF-GINS's example tells its filter of a navigation-grade IMU.
void tell_more_noise(NavigationSetup& setup) {
  ImuErrorProfile& told = setup.imus.front().believed;
  told.gyro.arw_deg_per_sqrt_h.setConstant(0.003);
  told.gyro.bias_gm_sigma_deg_per_h.setConstant(0.027);
  told.gyro.scale_factor_gm_sigma_ppm.setConstant(300.0);
  told.accel.vrw_m_per_s_per_sqrt_h.setConstant(0.03);
  told.accel.bias_gm_sigma_mgal.setConstant(15.0);
  told.accel.scale_factor_gm_sigma_ppm.setConstant(300.0);
}

void go_beyond(NavigationSetup& setup) { setup = full_setup(setup.seed, MotionFrom::Parameters); }

/// Beyond the thesis, with filters that know nothing of it.
void tell_the_thesis(NavigationSetup& setup) {
  const std::vector<TestedImu> thesis = setup.imus;
  go_beyond(setup);
  for (std::size_t i = 0; i < thesis.size(); ++i) setup.imus[i].believed = thesis[i].errors;
}

template <class Change>
void go_beyond_without(NavigationSetup& setup, Change change) {
  go_beyond(setup);
  for (TestedImu& imu : setup.imus) change(imu.errors);
}

constexpr Reading kReadings[] = {
    {"as above", [](NavigationSetup&) {}},
    {"table 4-10 alone, no scale factors",
     [](NavigationSetup& s) {
       set_scale_factors(s, {0.0, 0.0, 0.0});
     }},
    {"scale factors 30, 300, 300 ppm",
     [](NavigationSetup& s) {
       set_scale_factors(s, {30.0, 300.0, 300.0});
     }},
    {"scale factors 100, 1000, 1000 ppm",
     [](NavigationSetup& s) {
       set_scale_factors(s, {100.0, 1000.0, 1000.0});
     }},
    {"scale factors 300, 1000, 1000 ppm",
     [](NavigationSetup& s) {
       set_scale_factors(s, {300.0, 1000.0, 1000.0});
     }},
    {"all correlation times 3600 s", [](NavigationSetup& s) { set_correlation_time(s, 3600.0); }},
    {"all correlation times 1000 s", [](NavigationSetup& s) { set_correlation_time(s, 1000.0); }},
    {"all correlation times 100 s", [](NavigationSetup& s) { set_correlation_time(s, 100.0); }},
    {"cross-axis angles as the scale factors", add_cross_axis},
    {"positions to 0.01 m", [](NavigationSetup& s) { s.gnss.position_sigma_ned_m.setConstant(0.01); }},
    {"positions to 0.3 m", [](NavigationSetup& s) { s.gnss.position_sigma_ned_m.setConstant(0.3); }},
    {"velocities too, 0.05 m/s", [](NavigationSetup& s) { s.gnss_velocity = true; }},
    {"fixes at 5 Hz", [](NavigationSetup& s) { s.gnss_rate_hz = 5.0; }},
    {"outages every 120 s",
     [](NavigationSetup& s) {
       s.outages.spacing_s = 120.0, s.shifts_s = {0.0, 60.0};
     }},
    {"zero-velocity updates", [](NavigationSetup& s) { s.zero_velocity_updates = true; }},
    {"a magnetometer too", [](NavigationSetup& s) { add(Aid::Magnetometer, s); }},
    {"town drive at first hand", [](NavigationSetup& s) { s.motion = town_drive(s.seed, 300.0, s.duration_s); }},
    {"pos830's filter told more noise", tell_more_noise},
    {"beyond the thesis", go_beyond},
    {"beyond, filters told the thesis's errors", tell_the_thesis},
    {"beyond, RTK noise white, 0.03 m",
     [](NavigationSetup& s) {
       const GnssErrorProfile white = s.gnss;
       go_beyond(s);
       s.gnss = white;
     }},
    {"beyond, without vibration",
     [](NavigationSetup& s) {
       go_beyond(s);
       for (TestedImu& imu : s.imus) imu.vibration = {};
     }},
    {"beyond, at 20 deg C",
     [](NavigationSetup& s) { go_beyond_without(s, [](ImuErrorProfile& imu) { imu.temperature.clear(); }); }},
    {"beyond, without flicker",
     [](NavigationSetup& s) {
       go_beyond_without(s, [](ImuErrorProfile& imu) {
         imu.gyro.bias_instability_deg_per_h.setZero();
         imu.accel.bias_instability_mgal.setZero();
       });
     }},
    {"beyond, without g-sensitivity",
     [](NavigationSetup& s) {
       go_beyond_without(s, [](ImuErrorProfile& imu) { imu.gyro.g_sensitivity_deg_per_h_per_g.setZero(); });
     }},
};

}  // namespace

Table readings_table(std::uint64_t seeds) {
  Table table;
  table.title =
      fmt::format("Other readings, from parameters: horizontal / vertical m; roll pitch yaw deg ({} seeds)", seeds);
  table.columns = {"reading"};
  for (const PublishedDrift& published : published_drifts()) table.columns.push_back(published.imu);
  for (const Reading& reading : kReadings) {
    Row row{{reading.what}, true};
    for (const DriftFigures& found : drifts(seeds, [&reading](std::uint64_t seed) {
           NavigationSetup setup = thesis_setup(seed, MotionFrom::Parameters);
           reading.apply(setup);
           return setup;
         })) {
      row.cells.push_back(text_of(found));
    }
    table.rows.push_back(row);
  }
  Row thesis{{"thesis, simulated from parameters"}, true}, real{{"thesis, real"}, true};
  for (const PublishedDrift& published : published_drifts()) {
    thesis.cells.push_back(text_of(published.from_parameters));
    real.cells.push_back(text_of(published.real));
  }
  table.rows.push_back(thesis);
  table.rows.push_back(real);
  table.judged = false;
  return table;
}

}  // namespace inslab::verify
