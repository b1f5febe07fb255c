#include "inslab/models/magnetometer/magnetic_body.hpp"

#include <gtest/gtest.h>

namespace inslab::magnetometer {
namespace magnetic_body_test {

const Vector3 kMoment(200.0, 0.0, 0.0);  // A m^2, a car

TEST(MagneticBody, IsTwiceAsStrongOnItsAxisAsBesideIt) {
  // mu_0/(4 pi) 2 m/r^3 = 1e-7 * 400 / 125 T = 320 nT ahead, half of it and turned round beside.
  EXPECT_LT((field_of_ball_nt(kMoment, 1.0, {5.0, 0.0, 0.0}) - Vector3(320.0, 0.0, 0.0)).norm(), 1e-9);
  EXPECT_LT((field_of_ball_nt(kMoment, 1.0, {0.0, 5.0, 0.0}) - Vector3(-160.0, 0.0, 0.0)).norm(), 1e-9);
}

TEST(MagneticBody, InsideTheFieldIsTheSameEverywhereAndMeetsTheOutsideOnTheAxis) {
  const Vector3 inside = field_of_ball_nt(kMoment, 2.0, {0.3, -0.2, 0.1});
  EXPECT_EQ(inside, field_of_ball_nt(kMoment, 2.0, Vector3::Zero()));
  EXPECT_LT((inside - field_of_ball_nt(kMoment, 2.0, {2.0 + 1e-9, 0.0, 0.0})).norm(), 1e-4);
}

TEST(MagneticBody, OutsideItHasNoDivergenceAndNoCurl) {
  const Vector3 at(2.0, -1.5, 3.0), moment(100.0, -40.0, 70.0);
  Matrix3 gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 step = 1e-4 * Vector3::Unit(axis);
    gradient.col(axis) = (field_of_ball_nt(moment, 1.0, at + step) - field_of_ball_nt(moment, 1.0, at - step)) / 2e-4;
  }
  EXPECT_GT(gradient.norm(), 10.0);
  EXPECT_NEAR(gradient.trace(), 0.0, 1e-5);
  EXPECT_LT((gradient - gradient.transpose()).norm(), 1e-5);
}

TEST(MagneticBody, ActsFromItsPlace) {
  MagneticBody body;
  body.latitude_deg = 48.0, body.longitude_deg = 11.0, body.height_m = 500.0;
  body.moment_ned_a_m2 = kMoment;
  const nav::Geodetic centre{body.latitude_deg * units::kDeg, body.longitude_deg * units::kDeg, body.height_m};
  const Vector3 north = field_n_nt(body, nav::displaced(centre, {5.0, 0.0, 0.0}));
  EXPECT_LT((north - Vector3(320.0, 0.0, 0.0)).norm(), 1e-4);
  EXPECT_EQ(field_n_nt(body, nav::displaced(centre, {20000.0, 0.0, 0.0})), Vector3::Zero());
}

}  // namespace magnetic_body_test
}  // namespace inslab::magnetometer
