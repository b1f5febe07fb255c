// What of `inslab verify` looks at noise, vibration and navigation, with faults planted. Few seeds and short runs: the
// limits are then wider, and the faults are twice those.

#include <gtest/gtest.h>

#include <algorithm>

#include "inslab/nav/geodesy.hpp"
#include "inslab/referee/verify/alignment_block.hpp"
#include "inslab/referee/verify/allan_block.hpp"
#include "inslab/referee/verify/gnss.hpp"
#include "inslab/referee/verify/navigation.hpp"
#include "inslab/referee/verify/realism.hpp"
#include "inslab/referee/verify/vibration_block.hpp"
#include "tests/statistical/faulty_subjects.hpp"
#include "tests/statistical/planted_faults.hpp"

namespace inslab::verify {
namespace verify_noise_faults_test {

Subjects with_simulation(const Simulation& simulation) {
  Subjects subjects;
  subjects.simulation = simulation;
  return subjects;
}

Subjects with_imu_errors(const std::function<void(ImuErrorProfile& errors)>& change) {
  return with_simulation(simulation_of([change](scenario::LoadedScenario& scenario) {
    for (scenario::LoadedImu& imu : scenario.imus) change(imu.errors);
  }));
}

Subjects with_gnss_errors(const std::function<void(GnssErrorProfile& errors)>& change) {
  return with_simulation(simulation_of([change](scenario::LoadedScenario& scenario) {
    for (scenario::LoadedGnss& gnss : scenario.gnss) change(gnss.errors);
  }));
}

/// The IMU of a vehicle at rest, without the integration of a truth that does not change: of 45 hours that is most.
void simulate_at_rest(const scenario::LoadedScenario& scenario, const time::GpsTime&, sim::RunSink& sink) {
  const scenario::LoadedImu& imu = scenario.imus.front();
  imu::ImuModel model({scenario.stream_seed(), imu.number, imu.rate, nav::Gravity(), imu.errors, {}, {}});
  TruthState truth = product_truth(scenario.scenario.trajectory, imu.rate)->current();
  model.measure(truth);
  truth.interval_ns = imu.rate.period().count();
  truth.dtheta_v = imu.rate.period_s() * truth.omega_iv_v;
  truth.dv_v = imu.rate.period_s() * truth.f_v;
  for (std::uint64_t k = 1; k < scenario.truth_samples; ++k) {
    truth.header.sim_time_ns = imu.rate.at(k).count();
    const auto output = model.measure(truth);
    sink.imu(0, output->sample, output->truth);
  }
}

Subjects still_with(const std::function<void(ImuErrorProfile& errors)>& change) {
  return with_simulation([change](scenario::LoadedScenario scenario, const time::GpsTime& start, sim::RunSink& sink) {
    change(scenario.imus.front().errors);
    simulate_at_rest(scenario, start, sink);
  });
}

/// All seven grades with two seeds each; biases in some 8000 samples.
Tables short_allan(const Subjects& subjects) {
  std::vector<TriadResult> results;
  std::uint64_t seed = 1;
  for (Grade grade : thesis_grades()) {
    const double time_s = grade.gyro.gm_time_s;
    if (time_s > 1000.0) grade.rate_hz = 0.05;
    if (time_s > 0.0 && time_s < 1000.0) grade.duration_s = 7200.0, grade.rate_hz = 1.0;
    for (const TriadResult& result : verify_grade(
             grade, {seed, seed + 1}, [](const std::string&) {}, subjects)) {
      results.push_back(result);
    }
    seed += 2;
  }
  return tables_of(results);
}

TEST(PlantedFaults, AllanRowsSeeAnotherDensitySigmaAndCorrelationTime) {
  // Six records: 0.06 % standard error of a density; with eleven T in a record 22 % of T, 11 % of sigma.
  expect_each_row_to_fail_by_some_fault([] { return short_allan(with_simulation(simulate_at_rest)); },
                                        {{"2 % of density, three times the sigma",
                                          [] {
                                            return short_allan(still_with([](ImuErrorProfile& errors) {
                                              errors.gyro.arw_deg_per_sqrt_h *= 1.02;
                                              errors.accel.vrw_m_per_s_per_sqrt_h *= 1.02;
                                              errors.gyro.bias_gm_sigma_deg_per_h *= 3.0;
                                              errors.accel.bias_gm_sigma_mgal *= 3.0;
                                            }));
                                          }},
                                         {"a tenth of the correlation time", [] {
                                            return short_allan(still_with([](ImuErrorProfile& errors) {
                                              errors.gyro.bias_gm_correlation_time_s *= 0.1;
                                              errors.accel.bias_gm_correlation_time_s *= 0.1;
                                            }));
                                          }}});
}

TEST(PlantedFaults, GnssRowsSeeTwoPercentOfSigmaAndAnotherCorrelationTime) {
  // Three seeds: nine estimates of 12000 epochs, 0.43 % standard error of a white variance; 4 % of a process's.
  constexpr std::uint64_t kSeeds = 3;
  expect_each_row_to_fail_by_some_fault(
      [] {
        return Tables{gnss_noise(kSeeds), gnss_gauss_markov(kSeeds)};
      },
      {{"2 % of sigma",
        [] {
          return Tables{gnss_noise(kSeeds, with_gnss_errors([](GnssErrorProfile& errors) {
                                     errors.position_sigma_ned_m *= 1.02;
                                     errors.velocity_sigma_ned_m_per_s *= 1.02;
                                   }))};
        }},
       {"30 % of a process's sigma",
        [] {
          return Tables{gnss_gauss_markov(kSeeds, with_gnss_errors([](GnssErrorProfile& errors) {
                                            errors.position_gm_sigma_ned_m *= 1.3;
                                            errors.velocity_gm_sigma_ned_m_per_s *= 1.3;
                                          }))};
        }},
       {"a third of the correlation time", [] {
          return Tables{gnss_gauss_markov(kSeeds, with_gnss_errors([](GnssErrorProfile& errors) {
                                            errors.position_gm_correlation_time_s /= 3.0;
                                            errors.velocity_gm_correlation_time_s /= 3.0;
                                          }))};
        }}});
}

TEST(PlantedFaults, LeverArmRowsSeeTwoMicrometres) {
  expect_each_row_to_fail_by_some_fault(
      [] { return Tables{gnss_lever_arm()}; },
      {{"an arm longer by 2 um",
        [] {
          return Tables{gnss_lever_arm(with_simulation(simulation_of([](scenario::LoadedScenario& scenario) {
            scenario.gnss.front().installation.lever_arm_v_m.x() += 2e-6;
          })))};
        }},
       {"2 um/s", [] {
          return Tables{
              gnss_lever_arm(with_simulation(simulation_with_fixes([](GnssFix& fix) { fix.v_n.y() += 2e-6; })))};
        }}});
}

Tables short_alignment(const ImuOf& imu, const ImuLinesOf& lines = product_lines) {
  Subjects subjects;
  subjects.imu = imu;
  subjects.lines = lines;
  return alignment_tables(1, subjects, 600);  // a second's spread is then known to 2.9 %
}

TEST(PlantedFaults, AlignmentRowsSeeTenPercentOfNoiseNoiseThatIsNotWhiteBiasesAndLostCounts) {
  expect_each_row_to_fail_by_some_fault([] { return short_alignment(product_imu); },
                                        {{"10 % of noise",
                                          [] {
                                            return short_alignment(imu_set_up_with([](imu::ImuModel::Setup& setup) {
                                              setup.errors.gyro.arw_deg_per_sqrt_h *= 1.12;
                                              setup.errors.accel.vrw_m_per_s_per_sqrt_h *= 1.1;
                                            }));
                                          }},
                                         {"a bias that wanders within a second",
                                          [] {
                                            return short_alignment(imu_set_up_with([](imu::ImuModel::Setup& setup) {
                                              setup.errors.gyro.bias_gm_sigma_deg_per_h.setConstant(2.0);
                                              setup.errors.gyro.bias_gm_correlation_time_s.setConstant(1.0);
                                              setup.errors.accel.bias_gm_sigma_mgal.setConstant(100.0);
                                              setup.errors.accel.bias_gm_correlation_time_s.setConstant(1.0);
                                            }));
                                          }},
                                         {"biases of 0.05 deg/h and 20 mGal",
                                          [] {
                                            return short_alignment(imu_set_up_with([](imu::ImuModel::Setup& setup) {
                                              setup.errors.gyro.bias_constant_deg_per_h += Vector3(0.05, -0.05, 0.0);
                                              setup.errors.accel.bias_constant_mgal += Vector3(20.0, 20.0, 0.0);
                                            }));
                                          }},
                                         {"lines that say two thousandths more", [] {
                                            return short_alignment(product_imu, [] {
                                              return [sound = product_lines()](const ImuSample& sample) {
                                                ImuSample changed = sample;
                                                changed.dtheta_b.x() *= 1.002;
                                                changed.dv_b.x() *= 1.002;
                                                changed.dv_b.y() *= 1.002;
                                                return sound(changed);
                                              };
                                            });
                                          }}});
}

void without_two_sample_terms(nav::ImuIncrements& imu, const nav::NavState&, const nav::ImuIncrements& before) {
  const nav::ImuIncrements sound = imu;
  imu.dtheta_b -= before.dtheta_b.cross(sound.dtheta_b) / 12.0;
  imu.dv_b -= (before.dtheta_b.cross(sound.dv_b) + before.dv_b.cross(sound.dtheta_b)) / 12.0;
}

TEST(PlantedFaults, VibrationRowsSeeAQuarterSampleMissingTermsAndAnotherDensity) {
  const auto with_imu = [](const ImuOf& imu) {
    Subjects subjects;
    subjects.imu = imu;
    return vibration_tables(false, subjects);
  };
  expect_each_row_to_fail_by_some_fault(nullptr,
                                        {{"a quarter sample of delay", [&] { return with_imu(late_imu(0.25)); }},
                                         {"neither coning nor sculling terms",
                                          [] {
                                            Subjects subjects;
                                            subjects.mechanization = mechanization_with(without_two_sample_terms);
                                            return vibration_tables(false, subjects);
                                          }},
                                         {"1.4 times the density", [&] {
                                            return with_imu(imu_set_up_with([](imu::ImuModel::Setup& setup) {
                                              for (LinearRandomPoint& point : setup.vibration.linear_random)
                                                point.density_m2_per_s3 *= 1.4;
                                            }));
                                          }}});
}

void scale(ImuErrorProfile& errors, double factor) {
  for (Vector3* of :
       {&errors.gyro.bias_gm_sigma_deg_per_h, &errors.gyro.arw_deg_per_sqrt_h, &errors.gyro.bias_instability_deg_per_h,
        &errors.gyro.scale_factor_gm_sigma_ppm, &errors.accel.bias_gm_sigma_mgal, &errors.accel.vrw_m_per_s_per_sqrt_h,
        &errors.accel.bias_instability_mgal, &errors.accel.scale_factor_gm_sigma_ppm}) {
    *of *= factor;
  }
}

/// One outage of each IMU and motion, its largest errors far from what twenty minutes' thirteen would say.
OutageRuns one_outage() {
  OutageRuns runs;
  runs.duration_s = 500.0;
  return runs;
}

TEST(PlantedFaults, OutageRowsSeeErrorsThatAreTooLargeThoseThatAreKnownToBeTooSmallToo) {
  const Subjects worse = with_imu_errors([](ImuErrorProfile& errors) { scale(errors, 25.0); });
  expect_each_row_to_fail_by_some_fault(
      nullptr, {{"IMUs 25 times as bad as the filters are told", [&] {
                   return Tables{outage_table(one_outage(), worse), beyond_table(one_outage(), worse)};
                 }}});
}

TEST(PlantedFaults, OutageRowsSeeErrorsThatAreTooSmall) {
  const Subjects perfect = with_imu_errors([](ImuErrorProfile& errors) { scale(errors, 0.0); });
  OutageRuns runs = one_outage();
  runs.motions = {MotionFrom::Parameters};
  const Table table = outage_table(runs, perfect);
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_FALSE(table.rows[1].held || table.rows[1].known_miss) << to_text(table);
  EXPECT_FALSE(table.rows[2].held || table.rows[2].known_miss) << to_text(table);
}

TEST(PlantedFaults, HonestyRowsSeeSensorsThatAreWorseThanTheFiltersAreTold) {
  // Ten drives: the band is 9 +- 2.6. A fix says its profile's sigma, so a receiver is worse when it says less.
  const Simulation worse_imus = simulation_of([](scenario::LoadedScenario& scenario) {
    for (scenario::LoadedImu& imu : scenario.imus) scale(imu.errors, 3.0);
  });
  const Subjects worse = with_simulation(simulation_with_fixes(
      [](GnssFix& fix) {
        fix.position_sigma_ned_m *= 0.5;
        fix.velocity_sigma_ned_m_per_s *= 0.5;
      },
      worse_imus));
  expect_each_row_to_fail_by_some_fault(
      nullptr, {{"sensors two and three times as bad", [&] { return Tables{honesty_table(10, {}, worse)}; }}});
}

bool has_aids(const scenario::LoadedScenario& scenario) {
  return !scenario.barometers.empty() || !scenario.odometers.empty() || !scenario.magnetometers.empty() ||
         !scenario.headings.empty();
}

/// The drives without another sensor stay as they are.
Subjects imus_beside_aids(double factor) {
  return with_simulation(simulation_of([factor](scenario::LoadedScenario& scenario) {
    if (!has_aids(scenario)) return;
    for (scenario::LoadedImu& imu : scenario.imus) scale(imu.errors, factor);
  }));
}

TEST(PlantedFaults, RowsOfOtherSensorsSeeDriftsThatAreTooLarge) {
  const Subjects worse = imus_beside_aids(25.0);
  expect_each_row_to_fail_by_some_fault(nullptr, {{"IMUs 25 times as bad beside another sensor",
                                                   [&] { return Tables{aids_table(one_outage(), worse)}; }}});
}

// Of one outage alone the navigation grade may happen to drift by nothing; there are five up to 700 s.
TEST(PlantedFaults, RowsOfOtherSensorsSeeDriftsThatAreTooSmall) {
  const Subjects perfect = with_simulation(simulation_of([](scenario::LoadedScenario& scenario) {
    for (scenario::LoadedBarometer& barometer : scenario.barometers) {
      barometer.errors.sea_level_pressure_gm_sigma_pa = barometer.errors.gm_sigma_pa = 0.0;
      barometer.errors.white_sigma_pa = 0.0;
    }
    for (scenario::LoadedOdometer& odometer : scenario.odometers) odometer.errors = {};
    for (scenario::LoadedMagnetometer& magnetometer : scenario.magnetometers) magnetometer.errors = {};
    for (scenario::LoadedHeading& heading : scenario.headings) heading.errors = {};
    if (!has_aids(scenario)) return;
    for (scenario::LoadedImu& imu : scenario.imus) scale(imu.errors, 0.0);
    for (scenario::LoadedGnss& gnss : scenario.gnss) gnss.errors.position_sigma_ned_m *= 1e-3;
  }));
  OutageRuns five_outages;
  five_outages.duration_s = 700.0;
  const Table table = aids_table(five_outages, perfect);
  ASSERT_EQ(table.rows.size(), 12U);
  for (const Row& row : table.rows) EXPECT_FALSE(row.held) << to_text(table);
}

// Ten drives: the band is 9 +- 4.4.
TEST(PlantedFaults, HonestyRowsWithAnotherSensorSeeWhenItIsWorseThanTheFiltersAreTold) {
  const Simulation worse_imus = simulation_of([](scenario::LoadedScenario& scenario) {
    for (scenario::LoadedImu& imu : scenario.imus) scale(imu.errors, 4.0);
    for (scenario::LoadedBarometer& barometer : scenario.barometers) barometer.errors.white_sigma_pa *= 4.0;
    for (scenario::LoadedOdometer& odometer : scenario.odometers) odometer.errors.noise_m_per_sqrt_m *= 4.0;
    for (scenario::LoadedMagnetometer& magnetometer : scenario.magnetometers) magnetometer.errors.white_sigma_nt *= 4.0;
    for (scenario::LoadedHeading& heading : scenario.headings) heading.errors.relative_sigma_ned_m *= 4.0;
  });
  const Subjects worse = with_simulation(simulation_with_fixes(
      [](GnssFix& fix) {
        fix.position_sigma_ned_m *= 0.4;
        fix.velocity_sigma_ned_m_per_s *= 0.4;
      },
      worse_imus));
  expect_each_row_to_fail_by_some_fault(nullptr, {{"sensors two and a half and four times as bad", [&] {
                                                     Tables tables;
                                                     for (const Aid aid : kAids) {
                                                       tables.push_back(honesty_table(10, aid, worse));
                                                     }
                                                     return tables;
                                                   }}});
}

TEST(PlantedFaults, RowsOfCausesSeeThatTheyAreNotThereAndThatTheImuIsAnother) {
  const Subjects without_causes = with_simulation(simulation_of([](scenario::LoadedScenario& scenario) {
    for (scenario::LoadedImu& imu : scenario.imus) {
      imu.errors.accel_delay_s = 0.0;
      imu.errors.accel_place_m.setZero();
    }
    for (scenario::LoadedGnss& gnss : scenario.gnss) {
      gnss.errors.time_tag = {};
      gnss.errors.position_gm_sigma_ned_m.setZero();
      gnss.installation.lever_arm_v_m = {1.0, 0.0, -1.2};  // of config/profiles/installation/antenna_roof.json
    }
  }));
  const Subjects worse = with_simulation(simulation_of([](scenario::LoadedScenario& scenario) {
    for (scenario::LoadedImu& imu : scenario.imus) scale(imu.errors, 25.0);
  }));
  const auto table = [](const Subjects& subjects) {
    return [subjects] { return Tables{realism_table({}, subjects)}; };
  };
  expect_each_row_to_fail_by_some_fault(table({}), {{"no cause is there", table(without_causes)},
                                                    {"an IMU 25 times as bad as the filter is told", table(worse)}});
}

}  // namespace verify_noise_faults_test
}  // namespace inslab::verify
