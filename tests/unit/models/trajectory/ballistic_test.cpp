#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/trajectory/motion_table_model.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/wgs84.hpp"
#include "tests/unit/models/trajectory/tables.hpp"

namespace inslab::trajectory {
namespace ballistic_test {

constexpr time::GpsTime kStart{2300, 0};

scenario::Trajectory shot(double speed_m_per_s, double pitch_deg, double drag_per_m = 0.0) {
  scenario::Trajectory t = tables::at_wuhan(0.0);
  t.initial.speed_m_per_s = speed_m_per_s;
  t.initial.pitch_deg = pitch_deg;
  t.segments = {tables::segment(60.0, {tables::ballistic(drag_per_m)})};
  t.segments[0].motions[0].until_start_height = pitch_deg > 0.0;
  return t;
}

MotionTableModel model_of(const scenario::Trajectory& trajectory, double rate_hz = 200.0) {
  return MotionTableModel(trajectory, time::Rate(rate_hz), kStart);
}

Vector3 omega_nv_v(const TruthState& truth) {
  const Vector3 omega_in_n = nav::omega_ie_n(truth.latitude_rad) + nav::omega_en_n(geodetic_of(truth), truth.v_n);
  return truth.omega_iv_v - truth.q_nv.conjugate() * omega_in_n;
}

TEST(Ballistic, FeelsNothingWithoutDrag) {
  MotionTableModel model = model_of(shot(100.0, 30.0));
  EXPECT_EQ(model.current().f_v, Vector3::Zero());
  for (int i = 0; i < 2000; ++i) {
    const TruthState truth = model.advance();
    ASSERT_EQ(truth.f_v, Vector3::Zero());
    ASSERT_EQ(truth.dv_v, Vector3::Zero());
  }
}

TEST(Ballistic, FeelsItsDragAlongTheVelocity) {
  MotionTableModel model = model_of(shot(100.0, 30.0, 1e-3));
  for (int i = 0; i < 1000; ++i) {
    const TruthState truth = model.advance();
    ASSERT_LT((truth.f_v - Vector3(-1e-3 * truth.v_n.squaredNorm(), 0.0, 0.0)).norm(), 1e-12);
  }
}

TEST(Ballistic, AttitudeFollowsTheVelocityWithoutSpin) {
  MotionTableModel model = model_of(shot(100.0, 60.0, 1e-3));
  for (int i = 0; i < 2000; ++i) {
    const TruthState truth = model.advance();
    // The quaternion's rounding, 2e-16, turns 100 m/s by 4e-14 m/s.
    ASSERT_LT((truth.q_nv.conjugate() * truth.v_n - Vector3(truth.v_n.norm(), 0.0, 0.0)).norm(), 1e-13);
    ASSERT_LT(std::abs(omega_nv_v(truth).x()), 1e-15);
  }
}

/// The same shot with and without a spin.
struct Spinning {
  Spinning(double rate_deg_per_s, double decay_s) {
    scenario::Trajectory t = shot(200.0, 40.0, 1e-4);
    plain = std::make_unique<MotionTableModel>(model_of(t));
    t.segments[0].motions[0].spin_deg_per_s = rate_deg_per_s;
    t.segments[0].motions[0].spin_decay_s = decay_s;
    spinning = std::make_unique<MotionTableModel>(model_of(t));
  }
  std::unique_ptr<MotionTableModel> plain, spinning;
};

TEST(Ballistic, SpinsAboutItsNoseAsTheAirLetsIt) {
  constexpr double kRate_rad_per_s = 1e5 * units::kDeg, kDecay_s = 4.0;
  const Spinning shots(1e5, kDecay_s);
  for (int i = 1; i <= 2000; ++i) {
    const TruthState plain = shots.plain->advance(), truth = shots.spinning->advance();
    const double t_s = i * 5e-3;
    ASSERT_EQ(truth.latitude_rad, plain.latitude_rad) << "the flight is the same to the bit";
    ASSERT_EQ(truth.height_m, plain.height_m);
    ASSERT_EQ(truth.dv_v, plain.dv_v) << "drag lies along the nose";
    const double rolled_rad = kRate_rad_per_s * kDecay_s * (1.0 - std::exp(-t_s / kDecay_s));
    const Quaternion spun(Eigen::AngleAxisd(rolled_rad, Vector3::UnitX()));
    ASSERT_LT((plain.q_nv * spun).angularDistance(truth.q_nv), 1e-10) << t_s;
    const Vector3 omega_iv_v =
        spun.conjugate() * plain.omega_iv_v + Vector3(kRate_rad_per_s * std::exp(-t_s / kDecay_s), 0.0, 0.0);
    ASSERT_LT((truth.omega_iv_v - omega_iv_v).norm(), 1e-9) << t_s;
  }
}

/// The gyros' increments against Simpson's rule on 4000 pieces of each interval, in which the plain shot's rate is
/// taken as the parabola through three of its samples.
TEST(Ballistic, GyrosOfASpinningShotFeelTheSlowTurnThroughTheSpin) {
  constexpr double kRate_rad_per_s = 9e4 * units::kDeg, kDecay_s = 3.0;
  scenario::Trajectory t = shot(200.0, 40.0, 1e-4);
  MotionTableModel plain = model_of(t, 400.0);
  t.segments[0].motions[0].spin_deg_per_s = 9e4;
  t.segments[0].motions[0].spin_decay_s = kDecay_s;
  MotionTableModel spinning = model_of(t, 200.0);
  Vector3 start = plain.current().omega_iv_v;
  for (int k = 0; k < 100; ++k) {
    const Vector3 middle = plain.advance().omega_iv_v, end = plain.advance().omega_iv_v;
    constexpr int kPieces = 4000;
    Vector3 expected = Vector3::Zero();
    for (int i = 0; i <= kPieces; ++i) {
      const double share = static_cast<double>(i) / kPieces, t_s = (k + share) * 5e-3;
      const Vector3 omega = start + share * ((end - start) + (share - 1.0) * 2.0 * (start - 2.0 * middle + end));
      const double angle_rad = kRate_rad_per_s * kDecay_s * (1.0 - std::exp(-t_s / kDecay_s));
      const Vector3 seen = Eigen::AngleAxisd(-angle_rad, Vector3::UnitX()) * omega +
                           Vector3(kRate_rad_per_s * std::exp(-t_s / kDecay_s), 0.0, 0.0);
      expected += (i == 0 || i == kPieces ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) / 3.0 / kPieces * 5e-3 * seen;
    }
    ASSERT_LT((spinning.advance().dtheta_v - expected).norm(), 1e-11) << k;
    start = end;
  }
}

TEST(Ballistic, ASpinStaysInTheAttitudeThatItReached) {
  scenario::Trajectory t = shot(100.0, 30.0);
  t.segments[0].motions[0].until_start_height = false;
  t.segments[0].motions[0].spin_deg_per_s = 90.0;
  t.segments[0].duration_s = 1.0;
  t.segments.push_back(tables::segment(1.0, {}));
  MotionTableModel model = model_of(t);
  TruthState truth;
  for (int i = 0; i < 300; ++i) truth = model.advance();
  EXPECT_EQ(truth.segment_index, 1U);
  EXPECT_NEAR(nav::rpy_from_quaternion(truth.q_nv).roll_rad / units::kDeg, 90.0, 0.01);  // the Earth turns below it
  EXPECT_NEAR((truth.q_nv.conjugate() * truth.v_n).x(), truth.v_n.norm(), 1e-10);
}

TEST(Ballistic, KeepsAVelocityOffTheNoseWhereItWas) {
  scenario::Trajectory t = shot(50.0, 10.0);
  tables::Motion slip = tables::delta_speed(5.0);
  slip.axis = tables::Axis::Y;
  t.segments.insert(t.segments.begin(), tables::segment(2.0, {slip}));
  MotionTableModel model = model_of(t);
  TruthState truth = model.current();
  for (int i = 0; i < 600; ++i) truth = model.advance();
  ASSERT_EQ(truth.segment_index, 1U);
  const Vector3 v_v = truth.q_nv.conjugate() * truth.v_n;
  EXPECT_NEAR(v_v.y() / v_v.x(), 0.1, 1e-15);
  EXPECT_NEAR(v_v.z(), 0.0, 1e-13);
}

TEST(Ballistic, FliesAParabolaDeflectedByTheEarthsRotation) {
  // Over 10 s what is left out is the turn of gravity over 870 m, g (870 m/R) t^2/2 = 0.07 m, and its change over
  // 130 m of height, 0.02 m.
  const double t = 10.0;
  MotionTableModel model = model_of(shot(100.0, 30.0));
  const nav::Geodetic start = geodetic_of(model.current());
  const Vector3 v = model.current().v_n;
  const Vector3 omega = nav::omega_ie_n(start.latitude_rad);
  const Vector3 g = nav::Gravity().g_n(start);
  TruthState truth;
  for (int i = 0; i < 2000; ++i) truth = model.advance();
  const Vector3 parabola = v * t + 0.5 * g * t * t;
  const Vector3 deflection = -omega.cross(v) * t * t - omega.cross(g) * t * t * t / 3.0;
  ASSERT_GT(deflection.norm(), 0.2);
  EXPECT_LT((nav::ned_from(start, geodetic_of(truth)) - parabola - deflection).norm(), 0.1);
}

TEST(Ballistic, FallsAtTheSpeedWhereDragIsItsWeight) {
  scenario::Trajectory t = shot(30.0, -60.0, 0.01);
  t.initial.height_m = 5000.0;
  t.segments[0].duration_s = 100.0;
  MotionTableModel model = model_of(t);
  TruthState truth;
  for (int i = 0; i < 20000; ++i) truth = model.advance();
  // sqrt(g/k), which it follows into denser gravity 2.4e-4 m/s behind: sqrt(g/k) changes by
  // v (dg/dh) v/(2g) = 1.5e-4 m/s^2, and the speed settles at 2 k v = 0.63/s.
  EXPECT_NEAR(truth.v_n.norm(), std::sqrt(nav::Gravity().g_n(geodetic_of(truth)).z() / 0.01), 5e-4);
}

TEST(Ballistic, EndsTheRunAtTheHeightOfItsStart) {
  MotionTableModel model = model_of(shot(100.0, 30.0));
  // 2 v sin(pitch)/g on a flat Earth; the Earth's curvature adds d^2/(2R)/(v sin(pitch)) = 1.2 ms, its rotation up to
  // t 2 omega v/g = 15 ms.
  EXPECT_NEAR(time::to_seconds(model.end()), 2.0 * 100.0 * 0.5 / 9.7934, 0.02);
  TruthState truth = model.current();
  while (time::Nanoseconds(truth.header.sim_time_ns) + time::Nanoseconds(5'000'000) <= model.end()) {
    truth = model.advance();
    ASSERT_GE(truth.height_m, 20.0);
  }
  const double left_s = time::to_seconds(model.end()) - time::to_seconds(truth.header.sim_time_ns);
  EXPECT_GE(left_s, 0.0);
  // A nanosecond of a fall at 50 m/s, and g t^2/2 over what is left.
  EXPECT_NEAR(truth.height_m - truth.v_n.z() * left_s - 0.5 * 9.79 * left_s * left_s, 20.0, 1e-6);
}

TEST(Ballistic, EndDoesNotDependOnTheGrid) {
  EXPECT_EQ(model_of(shot(100.0, 30.0), 50.0).end(), model_of(shot(100.0, 30.0), 1000.0).end());
}

TEST(Ballistic, EndsAfterItsDurationWhenItIsNotBack) {
  scenario::Trajectory t = shot(100.0, 30.0);
  t.segments[0].duration_s = 7.0;
  EXPECT_EQ(model_of(t).end(), std::chrono::seconds(7));
  EXPECT_EQ(model_of(shot(100.0, -30.0)).end(), time::Nanoseconds::max()) << "asks for no end";
}

TEST(Ballistic, GoesOnWithTheNextSegmentWhereItCameBack) {
  scenario::Trajectory t = shot(100.0, 30.0);
  t.segments.push_back(tables::segment(5.0, {tables::turn(20.0, tables::Axis::Y)}));
  MotionTableModel model = model_of(t);
  EXPECT_EQ(model.end(), time::Nanoseconds::max());
  TruthState truth = model.current();
  while (truth.segment_index == 0) truth = model.advance();
  EXPECT_NEAR(truth.height_m, 20.0, 50.0 * 5e-3);
  EXPECT_NEAR(time::to_seconds(time::Nanoseconds(truth.header.sim_time_ns)), 10.2, 0.1);
}

TEST(Ballistic, NamesTimePlaceAndSpeedWhereTheVelocityHasNoDirection) {
  scenario::Trajectory up = shot(30.0, 90.0);
  const auto refusal = [&up] {
    try {
      MotionTableModel model = model_of(up);
      for (int i = 0; i < 1000; ++i) model.advance();
    } catch (const std::domain_error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(refusal().substr(0, 39), "at 0.000000 s, segment 0 '': speed is 0") << "it looks for the end first";
  up.segments[0].motions[0].until_start_height = false;
  EXPECT_EQ(refusal().substr(0, 4), "at 2") << refusal();  // 30 m/s are gone after 3.06 s, 29 m/s after 2.96 s
  EXPECT_NE(refusal().find("segment 0 '': speed is 0"), std::string::npos) << refusal();
  up.initial.speed_m_per_s = 0.5;
  EXPECT_EQ(refusal().substr(0, 41), "at 0.000000 s, segment 0 '': speed is 0.5");
}

}  // namespace ballistic_test
}  // namespace inslab::trajectory
