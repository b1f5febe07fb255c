#include <gtest/gtest.h>

#include "inslab/models/imu/cross_axis.hpp"
#include "inslab/models/imu/g_sensitivity.hpp"
#include "inslab/models/imu/nonlinearity.hpp"
#include "inslab/models/imu/temperature.hpp"

namespace inslab::imu {
namespace sensing_errors_test {

TEST(CrossAxis, AnAngleXToYShowsTheInputOfXOnTheOutputOfY) {
  Vector6 angles;
  angles << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;  // x to y, x to z, y to x, y to z, z to x, z to y
  const CrossAxis cross_axis(angles);
  EXPECT_EQ(cross_axis.error({1.0, 0.0, 0.0}), Vector3(0.0, 1.0, 2.0));
  EXPECT_EQ(cross_axis.error({0.0, 1.0, 0.0}), Vector3(3.0, 0.0, 4.0));
  EXPECT_EQ(cross_axis.error({0.0, 0.0, 1.0}), Vector3(5.0, 6.0, 0.0));
}

TEST(GSensitivity, EachRowIsAGyroAndEachColumnADirectionOfTheForce) {
  Vector9 rows;
  rows << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0;
  const GSensitivity g_sensitivity(rows);
  // One second of 1 g along y: gyro x turns by 2 deg/h, gyro y by 5, gyro z by 8, for a second.
  const Vector3 error = g_sensitivity.error({0.0, 9.80665, 0.0});
  EXPECT_TRUE(error.isApprox(Vector3(2.0, 5.0, 8.0) * (3.14159265358979323846 / 180.0 / 3600.0), 1e-15));
}

TEST(Nonlinearity, AsymmetryIsTheDifferenceOfTheScaleFactorsOfBothSigns) {
  TriadParameters parameters;
  parameters.scale_factor_asymmetry.setConstant(0.01);
  const Nonlinearity nonlinearity(parameters);
  const double positive = nonlinearity.error({2.0, 0.0, 0.0}, 0.5).x() / 2.0;
  const double negative = nonlinearity.error({-2.0, 0.0, 0.0}, 0.5).x() / -2.0;
  EXPECT_DOUBLE_EQ(positive - negative, 0.01);
}

TEST(Nonlinearity, DepartsByItsPartOfFullScaleAtFullScaleOnBothSides) {
  TriadParameters parameters;
  parameters.nonlinearity_of_full_scale.setConstant(1e-3);
  parameters.full_scale.setConstant(4.0);
  const Nonlinearity nonlinearity(parameters);
  // Increments over 0.5 s; at half of full scale an eighth of the error.
  const Vector3 error = nonlinearity.error({2.0, -2.0, 1.0}, 0.5);
  EXPECT_TRUE(error.isApprox(Vector3(2e-3, -2e-3, 2e-3 / 8.0), 1e-14));
}

TEST(Nonlinearity, GrowthByInputIsASquare) {
  TriadParameters parameters;
  parameters.nonlinearity_by_input.setConstant(1e-2);
  // The scale factor at 3 m/s^2 is 3e-2 too large, at -3 too small: the error has one sign.
  const Vector3 error = Nonlinearity(parameters).error({1.5, -1.5, 0.0}, 0.5);
  EXPECT_TRUE(error.isApprox(Vector3(0.045, 0.045, 0.0), 1e-14));
}

TEST(Temperature, FollowsStraightLinesBetweenCornersAndStaysOutsideThem) {
  const Temperature temperature({{10.0, 20.0}, {20.0, 60.0}, {30.0, 50.0}});
  EXPECT_EQ(temperature.at(0), 20.0);
  EXPECT_DOUBLE_EQ(temperature.at(15000000000), 40.0);
  EXPECT_DOUBLE_EQ(temperature.at(20000000000), 60.0);
  EXPECT_DOUBLE_EQ(temperature.at(27500000000), 52.5);
  EXPECT_EQ(temperature.at(40000000000), 50.0);
}

TEST(Temperature, WithoutCornersIsThatOfCalibration) { EXPECT_EQ(Temperature({}).at(5), Temperature::kCalibratedAt); }

}  // namespace sensing_errors_test
}  // namespace inslab::imu
