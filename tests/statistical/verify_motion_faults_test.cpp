// What of `inslab verify` looks at motion, with faults planted: spans are as short as a fault of twice a limit allows.

#include <gtest/gtest.h>

#include <algorithm>

#include "inslab/data/samples/nav_state.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/trajectory/row_motion.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/wgs84.hpp"
#include "inslab/referee/verify/closed_loop_block.hpp"
#include "inslab/referee/verify/increments_block.hpp"
#include "inslab/referee/verify/propagation.hpp"
#include "inslab/referee/verify/spline_loop.hpp"
#include "inslab/referee/verify/trajectory_block.hpp"
#include "tests/statistical/faulty_subjects.hpp"
#include "tests/statistical/planted_faults.hpp"

namespace inslab::verify {
namespace verify_motion_faults_test {

Subjects with_truth(const Distortion& distortion) {
  Subjects subjects;
  subjects.truth = truth_with(distortion);
  return subjects;
}

Subjects with_mechanization(const IncrementsChange& change) {
  Subjects subjects;
  subjects.mechanization = mechanization_with(change);
  return subjects;
}

Subjects with_imu(const ImuOf& imu) {
  Subjects subjects;
  subjects.imu = imu;
  return subjects;
}

PlantedFault in_truth(const char* what, double span_s, const Distortion& distortion) {
  return {what, [=] { return verify_trajectory(with_truth(distortion), span_s); }};
}

TEST(PlantedFaults, TrajectoryRowsSeeTwiceTheirLimits) {
  constexpr double kShort_s = 5.0, kFirstJoints_s = 310.0;  // the catalogue's car stands for 300 s
  const double dt_s = 0.005;
  expect_each_row_to_fail_by_some_fault(
      [] { return verify_trajectory({}, kFirstJoints_s); },
      {in_truth("2 um of height", kShort_s, [](TruthState& t) { t.height_m += 2e-6; }),
       in_truth("2e-8 m/s", kShort_s, [](TruthState& t) { t.v_n.y() += 2e-8; }),
       in_truth("2e-9 deg of roll", kShort_s,
                [](TruthState& t) {
                  t.q_nv = t.q_nv * nav::quaternion_from_rotation_vector({2e-9 * units::kDeg, 0.0, 0.0});
                }),
       in_truth("2e-14 rad in a second's angles", kShort_s, [](TruthState& t) { t.dtheta_v.z() += 1e-16; }),
       in_truth("specific force that the Earth's rotation turns the wrong way, by a millionth", kShort_s,
                [dt_s](TruthState& t) { t.dv_v += 1e-6 * dt_s * t.omega_iv_v.cross(t.f_v); }),
       // The extrapolation over six samples makes 32 times as much of it: three times the limit of the jumps.
       in_truth("1e-10 m/s^2 of every other sample", kFirstJoints_s, [](TruthState& t) {
         if (t.header.sim_time_ns % 10000000 == 0) t.f_v.x() += 1e-10;
       })});
}

/// Gravity is smaller in this algorithm than in the Earth's field.
constexpr double kMissing_m_per_s2 = 1e-5;  // 1 mGal

void light_gravity(nav::ImuIncrements& imu, const nav::NavState& state, const nav::ImuIncrements&) {
  imu.dv_b -= state.q_nb.conjugate() * nav::Vector3(0.0, 0.0, kMissing_m_per_s2 * imu.dt_s);
}
void wrong_coriolis(nav::ImuIncrements& imu, const nav::NavState& state, const nav::ImuIncrements&) {
  imu.dv_b += coriolis_of_wrong_sign_b(state, imu.dt_s);
}

/// Both ways alike: the file's inverse and the app's mechanization, so that the fault cancels between them.
Subjects both_ways(const std::function<nav::Vector3(const nav::NavState& state, double dt_s)>& missing_b,
                   const IncrementsChange& app) {
  Subjects subjects = with_mechanization(app);
  subjects.inverse = inverse_with([missing_b](TruthState& truth) {
    const double dt_s = static_cast<double>(truth.interval_ns) / 1e9;
    truth.dv_v -= missing_b(nav_state(truth), dt_s);
  });
  return subjects;
}

Subjects light_gravity_both_ways() {
  return both_ways(
      [](const nav::NavState& state, double dt_s) {
        return nav::Vector3(state.q_nb.conjugate() * nav::Vector3(0.0, 0.0, -kMissing_m_per_s2 * dt_s));
      },
      light_gravity);
}
Subjects wrong_coriolis_both_ways() { return both_ways(coriolis_of_wrong_sign_b, wrong_coriolis); }

/// The catalogue for half a minute.
std::vector<LoopCase> short_cases(std::vector<LoopCase> cases) {
  for (LoopCase& one : cases) one.duration = std::min<time::Nanoseconds>(one.duration, std::chrono::seconds(30));
  return cases;
}

Tables both_files_tables(const Subjects& subjects) {
  return {inverse_mechanization_table("20 minutes", short_cases(loop_cases()), subjects),
          inverse_mechanization_table("an hour", short_cases(for_an_hour(loop_cases())), subjects)};
}

TEST(PlantedFaults, RowsOfTheClosedLoopSeeWhatCancelsBetweenInverseAndMechanization) {
  expect_each_row_to_fail_by_some_fault(
      [] { return both_files_tables({}); },
      {{"gravity smaller by 1 mGal, both ways", [] { return both_files_tables(light_gravity_both_ways()); }},
       {"gravity smaller by 1 mGal in the app", [] { return both_files_tables(with_mechanization(light_gravity)); }}});
  // Where the vehicle moves within the half minute, in the hour's rows as in these.
  const auto moving = [](LoopCase one) {
    one.trajectory.segments.erase(one.trajectory.segments.begin());
    one.trajectory.initial.speed_m_per_s = 20.0;
    return one;
  };
  const Table table =
      inverse_mechanization_table("moving", short_cases({moving(loop_cases().at(2))}), wrong_coriolis_both_ways());
  EXPECT_FALSE(table.held()) << "Coriolis of the wrong sign, both ways\n" << to_text(table);
  const Table late =
      inverse_mechanization_table("moving", short_cases({moving(loop_cases().at(2))}), with_imu(late_imu(0.25)));
  EXPECT_FALSE(late.held()) << "a quarter sample of delay\n" << to_text(late);
}

/// A curve through rows that lie elsewhere: twice the limit.
trajectory::SmoothMotion curve_beside_the_rows(TrajectoryFile file) {
  for (std::size_t k = 1; k < file.rows.size(); ++k) file.rows[k].position.height_m += 2e-8;
  return product_curve(file);
}

/// One that meets every row and leaves the right way between the first two.
trajectory::SmoothMotion curve_with_another_start(TrajectoryFile file) {
  *file.rows.front().v_n += nav::Vector3(0.0, 0.0, 1e-5);
  return product_curve(file);
}

Subjects with_curve(const CurveOf& curve) {
  Subjects subjects;
  subjects.curve = curve;
  return subjects;
}

Tables spline_tables(const Subjects& subjects) {
  return {spline_table("10 Hz", short_cases(loop_cases()), time::Rate(10.0), subjects),
          spline_table("1 Hz", short_cases(loop_cases()), time::Rate(1.0), subjects)};
}

ImuOf biased_imu(double mgal) {
  return imu_set_up_with(
      [mgal](imu::ImuModel::Setup& setup) { setup.errors.accel.bias_constant_mgal += Vector3::Constant(mgal); });
}

TEST(PlantedFaults, RowsOfTheSplineSeeACurveBesideThemAndIncrementsThatAreNotTheCurves) {
  expect_each_row_to_fail_by_some_fault(
      [] { return spline_tables({}); },
      {{"a curve 2e-8 m above the rows", [] { return spline_tables(with_curve(curve_beside_the_rows)); }},
       // 2 mm in half a minute.
       {"0.45 mGal of bias", [] { return spline_tables(with_imu(biased_imu(0.45))); }}});
}

std::shared_ptr<const TrajectoryFile> contradictory_file() {
  return contradictory_rows(loop_cases().at(2), std::chrono::minutes(2));
}

TEST(PlantedFaults, RowsOfFilesThatContradictThemselvesSeeWrongIncrementsAndAnotherCurve) {
  const auto tables = [](const Subjects& subjects) {
    return Tables{contradiction_table({contradictory_file()}, subjects),
                  spline_file_table({contradictory_file()}, subjects)};
  };
  expect_each_row_to_fail_by_some_fault(
      [&] { return tables({}); },
      {{"100 mGal of bias",
        [&] { return Tables{contradiction_table({contradictory_file()}, with_imu(biased_imu(100.0)))}; }},
       {"a curve with another velocity at its start",
        [&] { return Tables{spline_file_table({contradictory_file()}, with_curve(curve_with_another_start))}; }}});
}

void without_coning_and_sculling(nav::ImuIncrements& imu, const nav::NavState&, const nav::ImuIncrements& before) {
  const nav::ImuIncrements sound = imu;
  imu.dtheta_b -= before.dtheta_b.cross(sound.dtheta_b) / 12.0;
  imu.dv_b -= (before.dtheta_b.cross(sound.dv_b) + before.dv_b.cross(sound.dtheta_b)) / 12.0;
}

TEST(PlantedFaults, OrdersOfTheErrorSeeTermsThatAreMissing) {
  constexpr double kSpan_s = 10.0;
  const auto with = [](const Subjects& subjects) { return increments(kSpan_s, subjects); };
  expect_each_row_to_fail_by_some_fault(
      nullptr,
      {{"neither coning nor sculling terms", [&] { return with(with_mechanization(without_coning_and_sculling)); }},
       {"Coriolis of the wrong sign", [&] { return with(with_mechanization(wrong_coriolis)); }},
       {"no rotation of the specific force",
        [&] {
          return with(with_mechanization([](nav::ImuIncrements& imu, const nav::NavState&, const nav::ImuIncrements&) {
            imu.dv_b -= 0.5 * imu.dtheta_b.cross(imu.dv_b);
          }));
        }},
       {"rates that are the interval's mean", [&] {
          return with(with_truth([](TruthState& truth) {
            const double rate_hz = 1e9 / static_cast<double>(truth.interval_ns);
            truth.omega_iv_v = rate_hz * truth.dtheta_v;
            truth.f_v = rate_hz * truth.dv_v;
          }));
        }}});
}

ImuOf noisier_imu(double factor) {
  return imu_set_up_with([factor](imu::ImuModel::Setup& setup) {
    setup.errors.gyro.bias_turn_on_sigma_deg_per_h *= factor;
    setup.errors.gyro.bias_gm_sigma_deg_per_h *= factor;
    setup.errors.gyro.arw_deg_per_sqrt_h *= factor;
    setup.errors.gyro.bias_instability_deg_per_h *= factor;
    setup.errors.accel.bias_turn_on_sigma_mgal *= factor;
    setup.errors.accel.bias_gm_sigma_mgal *= factor;
    setup.errors.accel.vrw_m_per_s_per_sqrt_h *= factor;
    setup.errors.accel.bias_instability_mgal *= factor;
  });
}

TEST(PlantedFaults, SchulerRowsSeeCoriolisOfTheWrongSignAndAnotherGravity) {
  const ImuOf scaled = imu_set_up_with(
      [](imu::ImuModel::Setup& setup) { setup.errors.accel.scale_factor_ppm += Vector3::Constant(4e4); });
  expect_each_row_to_fail_by_some_fault(
      nullptr, {{"Coriolis of the wrong sign", [] { return schuler_tables(with_mechanization(wrong_coriolis)); }},
                // The period goes with the root of the specific force.
                {"4 % of accelerometers' scale", [&] { return schuler_tables(with_imu(scaled)); }}});
}

TEST(PlantedFaults, HeightRowsSeeATenthOfAMilligal) {
  expect_each_row_to_fail_by_some_fault(nullptr,
                                        {{"0.1 mGal", [] { return Tables{height_table(with_imu(biased_imu(0.1)))}; }}});
}

TEST(PlantedFaults, DriftRowsSeeAnotherImuThanThatOfThePrediction) {
  // Ten runs: chi-square of ten degrees allows 0.14 to 4 times the variance.
  expect_each_row_to_fail_by_some_fault(
      nullptr, {{"an IMU five times as bad", [] { return Tables{drift_table(10, with_imu(noisier_imu(5.0)))}; }},
                {"an IMU ten times as good", [] { return Tables{drift_table(10, with_imu(noisier_imu(0.1)))}; }}});
}

}  // namespace verify_motion_faults_test
}  // namespace inslab::verify
