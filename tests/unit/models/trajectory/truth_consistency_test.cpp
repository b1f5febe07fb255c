// The truth against itself: what is published as a derivative or an integral is one of what else is published.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/models/trajectory/motion_table_model.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/wgs84.hpp"
#include "tests/unit/models/trajectory/tables.hpp"

namespace inslab::trajectory {
namespace truth_consistency_test {

constexpr double kUlpOfTwoRad = 4.4e-16;

std::vector<TruthState> run(const scenario::Trajectory& trajectory, double rate_hz, double seconds) {
  MotionTableModel model(trajectory, time::Rate(rate_hz), {2300, 0});
  std::vector<TruthState> truth{model.current()};
  const auto steps = static_cast<std::size_t>(std::lround(seconds * rate_hz));
  while (truth.size() <= steps) truth.push_back(model.advance());
  return truth;
}

struct Case {
  const char* name;
  scenario::Trajectory (*table)();
  double seconds;
};

class TruthConsistency : public testing::TestWithParam<Case> {};

TEST_P(TruthConsistency, DoesNotDependOnTheGrid) {
  const auto coarse = run(GetParam().table(), 200.0, GetParam().seconds);
  const auto fine = run(GetParam().table(), 1000.0, GetParam().seconds);
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    const TruthState &a = coarse[i], &b = fine[5 * i];
    ASSERT_EQ(a.header.sim_time_ns, b.header.sim_time_ns);
    // 1e-9 m and the unit in the last place that the angles are published with.
    ASSERT_LT(nav::ned_from(geodetic_of(a), geodetic_of(b)).norm(), 1e-9 + kUlpOfTwoRad * nav::wgs84::a_m) << i;
    ASSERT_LT((a.v_n - b.v_n).norm(), 1e-10) << i;
    ASSERT_LT(nav::angle_between(a.q_nv, b.q_nv), 1e-12) << i;
    ASSERT_EQ(a.segment_index, b.segment_index);
  }
}

TEST_P(TruthConsistency, IncrementsOfFineSamplesAddUpToThoseOfCoarse) {
  const auto coarse = run(GetParam().table(), 200.0, GetParam().seconds);
  const auto fine = run(GetParam().table(), 1000.0, GetParam().seconds);
  for (std::size_t i = 1; i < coarse.size(); ++i) {
    Vector3 dtheta = Vector3::Zero(), dv = Vector3::Zero();
    for (std::size_t j = 5 * i - 4; j <= 5 * i; ++j) {
      dtheta += fine[j].dtheta_v;
      dv += fine[j].dv_v;
    }
    // Attitudes apart by 1e-12 rad turn 0.05 m/s by 5e-14 m/s.
    ASSERT_LT((dtheta - coarse[i].dtheta_v).norm(), 1e-15) << i;
    ASSERT_LT((dv - coarse[i].dv_v).norm(), 5e-14) << i;
  }
}

TEST_P(TruthConsistency, PositionChangesAsTheVelocitySays) {
  // Central differences at 1 kHz: the truncation dt^2 a'/6 is 1e-6 * jerk/6, 2e-6 m/s at 10 m/s^3; the rounding of a
  // longitude, 1.4e-9 m in two positions over 2 ms, is 1.4e-6 m/s.
  const auto truth = run(GetParam().table(), 1000.0, GetParam().seconds);
  for (std::size_t i = 1; i + 1 < truth.size(); ++i) {
    if (truth[i - 1].segment_index != truth[i + 1].segment_index) continue;  // the acceleration may jump between
    const Vector3 velocity = (nav::ned_from(geodetic_of(truth[i]), geodetic_of(truth[i + 1])) -
                              nav::ned_from(geodetic_of(truth[i]), geodetic_of(truth[i - 1]))) /
                             2e-3;
    ASSERT_LT((velocity - truth[i].v_n).norm(), 4e-6) << i;
  }
}

TEST_P(TruthConsistency, AttitudeChangesAsTheIncrementsOfAngleSay) {
  // q_nv(k+1) = q_nn' q_nv(k) q(dtheta): over 1 ms dtheta is the rotation vector but for coning, dtheta' x dtheta''/12
  // of some (0.1 rad/s * 1 ms)(1 rad/s^2 * 1e-6)/12 = 1e-11 rad.
  const auto truth = run(GetParam().table(), 1000.0, GetParam().seconds);
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const Vector3 omega_in_n =
        nav::omega_ie_n(truth[i].latitude_rad) + nav::omega_en_n(geodetic_of(truth[i]), truth[i].v_n);
    const Quaternion q = nav::quaternion_from_rotation_vector(-omega_in_n * 1e-3) * truth[i - 1].q_nv *
                         nav::quaternion_from_rotation_vector(truth[i].dtheta_v);
    ASSERT_LT(nav::angle_between(q, truth[i].q_nv), 2e-11) << i;
  }
}

TEST_P(TruthConsistency, RateAndSpecificForceAreTheDerivativesOfTheIncrements) {
  // The mean of an interval is the mean of its ends but for dt^2/12 of the second derivative: at 1 kHz 1e-7 of some
  // 10 rad/s^3 or 100 m/s^4. A corner of an acceleration off the grid costs dt/8 of the change of slope, which is up to
  // 22 m/s/5.25 s/1.75 s = 2.4 m/s^3 here: 3e-4 m/s^2. Intervals that hold a joint, where rate or force may jump, are
  // left out.
  const auto truth = run(GetParam().table(), 1000.0, GetParam().seconds);
  for (std::size_t i = 2; i < truth.size(); ++i) {
    if (truth[i].segment_index != truth[i - 1].segment_index) continue;
    ASSERT_LT((truth[i].dtheta_v * 1e3 - 0.5 * (truth[i].omega_iv_v + truth[i - 1].omega_iv_v)).norm(), 1e-6) << i;
    ASSERT_LT((truth[i].dv_v * 1e3 - 0.5 * (truth[i].f_v + truth[i - 1].f_v)).norm(), 3e-4) << i;
  }
}

TEST_P(TruthConsistency, QuaternionsAreCanonical) {
  for (const TruthState& truth : run(GetParam().table(), 200.0, GetParam().seconds)) {
    ASSERT_GE(truth.q_nv.w(), 0.0);
    ASSERT_NEAR(truth.q_nv.norm(), 1.0, 4e-16);
  }
}

INSTANTIATE_TEST_SUITE_P(Tables, TruthConsistency,
                         testing::Values(Case{"basic", tables::basic, 400.0}, Case{"vehicle", tables::vehicle, 400.0},
                                         Case{"aircraft", tables::aircraft, 400.0}, Case{"ship", tables::ship, 400.0},
                                         Case{"rocket", tables::rocket, 65.0}),
                         [](const auto& table) { return table.param.name; });

/// Where two grids leave the vehicle, in m apart.
double apart_m(const scenario::Trajectory& trajectory, double rate_hz, double finer_hz, double seconds) {
  const auto end = [&](double hz) {
    MotionTableModel model(trajectory, time::Rate(hz), {2300, 0});
    for (long i = std::lround(seconds * hz); i > 0; --i) model.advance();
    return geodetic_of(model.current());
  };
  return nav::ned_from(end(rate_hz), end(finer_hz)).norm();
}

TEST(Truth, StaysTheSameOverAnHourOfSwayOnAnyGrid) {
  scenario::Trajectory hour = tables::ship();
  hour.segments[0].duration_s = 3600.0;
  EXPECT_LT(apart_m(hour, 200.0, 1000.0, 3600.0), 1e-9 + kUlpOfTwoRad * nav::wgs84::a_m);
}

TEST(Truth, ResolvesSwayFasterThanItsGrid) {
  // 10 Hz of heave and 4 and 5 Hz of angles; against steps a tenth as long, whose error is 1e-4 of it: the error of an
  // hour's motion, here a twelfth of it, stays below 1e-6 m.
  using tables::Axis;
  using tables::MotionType;
  scenario::Trajectory rough = tables::at_wuhan();
  rough.segments = {tables::segment(300.0, {tables::sinusoid(MotionType::CosineRate, 30.0, 0.2, Axis::X),
                                            tables::sinusoid(MotionType::SineRate, 20.0, 0.25, Axis::Y),
                                            tables::sinusoid(MotionType::SineAccel, 5.0, 0.1, Axis::Z)})};
  rough.segments[0].keep_velocity_on_nose = false;
  EXPECT_LT(apart_m(rough, 200.0, 10000.0, 300.0), 1e-6 / 12.0);
}

TEST(Truth, IsTheSameBitsEveryTime) {
  const auto once = run(tables::aircraft(), 200.0, 100.0);
  const auto again = run(tables::aircraft(), 200.0, 100.0);
  for (std::size_t i = 0; i < once.size(); ++i) {
    ASSERT_EQ(once[i].latitude_rad, again[i].latitude_rad);
    ASSERT_EQ(once[i].dv_v, again[i].dv_v);
    ASSERT_EQ(once[i].dtheta_v, again[i].dtheta_v);
  }
}

TEST(Truth, KeepsASlowRateGridAsExact) {
  // 1 Hz is integrated in the same small steps: 200 of 5 ms.
  const auto slow = run(tables::basic(), 1.0, 400.0);
  const auto usual = run(tables::basic(), 200.0, 400.0);
  const double apart_m = nav::ned_from(geodetic_of(slow.back()), geodetic_of(usual.back())).norm();
  EXPECT_LT(apart_m, 1e-9 + kUlpOfTwoRad * nav::wgs84::a_m);
}

}  // namespace truth_consistency_test
}  // namespace inslab::trajectory
