#include <gtest/gtest.h>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"
#include "tests/unit/referee/score/straight_run.hpp"

/// Every figure against the closed form of errors that are known functions of time.
namespace inslab::score {
namespace figures_test {

using scenario::Metric;

/// A position's angles round to 1e-16 rad, 1e-9 m.
constexpr double kRounding_m = 1e-8;

/// A standing vehicle at 100 Hz from 0 to `count - 1` samples; `change(k, solution)` spoils the perfect answers.
template <class Change>
Scorer scored(int count, const Change& change) {
  Scorer scorer(scenario_with());
  for (int k = 0; k < count; ++k) {
    const TruthState truth = standing(k * 0.01);
    NavSolution solution = solution_at(truth, Vector3::Zero());
    change(k, solution);
    scorer.add(truth);
    scorer.add(solution, 0);
  }
  scorer.finish();
  return scorer;
}

Scorer with_position_errors(int count, const std::function<Vector3(int)>& error_ned_m) {
  return scored(count, [&](int k, NavSolution& solution) {
    const nav::Geodetic place = nav::displaced(geodetic_of(solution), error_ned_m(k));
    solution.latitude_rad = place.latitude_rad;
    solution.longitude_rad = place.longitude_rad;
    solution.height_m = place.height_m;
  });
}

const ErrorStatistics& all_of(const Scorer& scorer) { return scorer.phases().at({}); }

TEST(PositionFigures, OfAConstantErrorAreTheErrorOnEachAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 error = 7.0 * Vector3::Unit(axis);
    const Scorer scorer = with_position_errors(50, [&](int) { return error; });
    EXPECT_LT((all_of(scorer).position().mean(50) - error).norm(), kRounding_m);
    EXPECT_LT((all_of(scorer).position().rms(50) - error).norm(), kRounding_m);
    EXPECT_NEAR(*in_all(scorer, Metric::HorizontalRms), axis < 2 ? 7.0 : 0.0, kRounding_m);
    EXPECT_NEAR(*in_all(scorer, Metric::VerticalRms), axis < 2 ? 0.0 : 7.0, kRounding_m);
    EXPECT_NEAR(*in_all(scorer, Metric::HorizontalMax), axis < 2 ? 7.0 : 0.0, kRounding_m);
    EXPECT_NEAR(*in_all(scorer, Metric::VerticalMax), axis < 2 ? 0.0 : 7.0, kRounding_m);
  }
}

// An error of r k at sample k = 0..n, with r in m a sample: the mean is r n/2, the sum of squares r^2 n (n+1) (2n+1)/6
// over n+1 samples, so the RMS r sqrt(n (2n+1)/6). The q-quantile is the value of rank ceil(q (n+1)), r (rank - 1).
TEST(PositionFigures, OfARampAreThoseOfItsSumOfSquares) {
  constexpr int kLast = 200;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 slope = (axis == 1 ? -0.03 : 0.03) * Vector3::Unit(axis);
    const Scorer scorer = with_position_errors(kLast + 1, [&](int k) { return k * slope; });
    const double rms = 0.03 * std::sqrt(kLast * (2.0 * kLast + 1.0) / 6.0);
    EXPECT_LT((all_of(scorer).position().mean(kLast + 1) - 0.5 * kLast * slope).norm(), kRounding_m);
    EXPECT_NEAR(*in_all(scorer, axis < 2 ? Metric::HorizontalRms : Metric::VerticalRms), rms, kRounding_m);
    EXPECT_NEAR(*in_all(scorer, axis < 2 ? Metric::HorizontalMax : Metric::VerticalMax), 0.03 * kLast, kRounding_m);
    // Ranks 101 and 191 of 201; a bin is 1 % wide and its middle within 0.5 %.
    EXPECT_NEAR(*in_all(scorer, axis < 2 ? Metric::Cep50 : Metric::Vertical50), 3.0, 0.015);
    EXPECT_NEAR(*in_all(scorer, axis < 2 ? Metric::Cep95 : Metric::Vertical95), 5.7, 0.0285);
  }
}

// North and east normal with sigma 2 make a Rayleigh radius: at the middle of each of N equal shares of probability it
// is 2 sqrt(-2 ln(1 - (k + 1/2)/N)). CEP50 = 2 sqrt(2 ln 2), CEP95 = 2 sqrt(2 ln 20), to half a share of probability
// (over the density, 1 % of the radius at 95 %) and half a bin; E r^2 = 8.
TEST(PositionFigures, CepOfARayleighRadiusIsItsQuantile) {
  constexpr int kCount = 2000;
  const Scorer scorer = with_position_errors(kCount, [&](int k) {
    const double radius = 2.0 * std::sqrt(-2.0 * std::log(1.0 - (k + 0.5) / kCount));
    return Vector3(radius * std::cos(2.4 * k), radius * std::sin(2.4 * k), 0.0);
  });
  const double cep50 = 2.0 * std::sqrt(2.0 * std::log(2.0)), cep95 = 2.0 * std::sqrt(2.0 * std::log(20.0));
  EXPECT_NEAR(*in_all(scorer, Metric::Cep50), cep50, 0.006 * cep50);
  EXPECT_NEAR(*in_all(scorer, Metric::Cep95), cep95, 0.006 * cep95);
  // The middles leave out the tail of the last share, 8 (ln 2)/(2 kCount) of 8 and less.
  EXPECT_NEAR(*in_all(scorer, Metric::HorizontalRms), std::sqrt(8.0), 1e-3);
}

// |(1, 2, -2)| = 3; the mean keeps the signs.
TEST(VelocityFigures, RmsIsOfTheLengthOfTheError) {
  const Scorer scorer = scored(40, [](int, NavSolution& s) { s.v_n += Vector3(1.0, 2.0, -2.0); });
  EXPECT_NEAR(*in_all(scorer, Metric::VelocityRms), 3.0, 1e-12);
  EXPECT_LT((all_of(scorer).velocity().mean(40) - Vector3(1.0, 2.0, -2.0)).norm(), 1e-12);
}

/// The answer is off by the rotation vector `phi_rad` about north, east, down: C_true C_estimated^T = exp(phi).
void turn(NavSolution& solution, const Vector3& phi_rad) {
  solution.q_n_body = nav::quaternion_from_rotation_vector(phi_rad).conjugate() * solution.q_n_body;
}

// A rotation vector about the level, and one about down, are tilt and heading alone, whatever their size.
TEST(AttitudeFigures, TiltAndHeadingArePartsOfTheRotationVector) {
  for (const double size_rad : {1e-7, 1e-3, 0.5, 3.0}) {
    const Scorer tilted = scored(20, [&](int, NavSolution& s) { turn(s, size_rad * Vector3(0.6, -0.8, 0.0)); });
    EXPECT_NEAR(*in_all(tilted, Metric::TiltRms), size_rad * units::kDegPerRad, 1e-12 + 1e-9 * size_rad);
    EXPECT_NEAR(*in_all(tilted, Metric::HeadingRms), 0.0, 1e-12);
    const Scorer turned = scored(20, [&](int, NavSolution& s) { turn(s, size_rad * Vector3::UnitZ()); });
    EXPECT_NEAR(*in_all(turned, Metric::HeadingRms), size_rad * units::kDegPerRad, 1e-12 + 1e-9 * size_rad);
    EXPECT_NEAR(*in_all(turned, Metric::TiltRms), 0.0, 1e-12);
  }
}

// Yaw 179 deg against a truth of -179 deg, and the other way round, are 2 deg apart: phi is +2 and -2 deg about down.
TEST(AttitudeFigures, HeadingWrapsAt180Degrees) {
  Scorer scorer(scenario_with());
  for (int k = 0; k < 20; ++k) {
    TruthState truth = standing(k * 0.01);
    const double true_yaw_deg = k < 10 ? -179.0 : 179.0;
    truth.q_nv = nav::quaternion_from_rpy({0.0, 0.0, true_yaw_deg / units::kDegPerRad});
    truth.omega_iv_v = truth.q_nv.conjugate() * nav::omega_ie_n(truth.latitude_rad);
    NavSolution solution = solution_at(truth, Vector3::Zero());
    solution.q_n_body = nav::quaternion_from_rpy({0.0, 0.0, -true_yaw_deg / units::kDegPerRad});
    scorer.add(truth);
    scorer.add(solution, 0);
  }
  scorer.finish();
  EXPECT_NEAR(*in_all(scorer, Metric::HeadingRms), 2.0, 1e-9);
  EXPECT_NEAR(all_of(scorer).phi().mean(20).z(), 0.0, 1e-12);
  EXPECT_NEAR(all_of(scorer).phi().largest.z() * units::kDegPerRad, 2.0, 1e-9);
}

TEST(AttitudeFigures, BothSignsOfAQuaternionAreOneAttitude) {
  const Scorer scorer = scored(20, [](int, NavSolution& s) {
    turn(s, Vector3(0.0, 0.0, 1e-3));
    s.q_n_body.coeffs() = -s.q_n_body.coeffs();
  });
  EXPECT_NEAR(*in_all(scorer, Metric::HeadingRms), 1e-3 * units::kDegPerRad, 1e-12);
}

// (4/2)^2 + (3/1)^2 + (1/0.5)^2 = 17; (1/0.5)^2 + (2/1)^2 + (3/1.5)^2 = 12; (1/1)^2 + (2/2)^2 + (3/1)^2 = 11.
TEST(NeesFigures, AreTheSumOverTheAxesOfSquaredErrorsOverReportedVariances) {
  const Scorer scorer = scored(30, [](int, NavSolution& s) {
    const NavSolution off = solution_at(standing(0.0), Vector3(4.0, -3.0, 1.0));
    s.latitude_rad = off.latitude_rad;
    s.longitude_rad = off.longitude_rad;
    s.height_m = off.height_m;
    s.v_n += Vector3(1.0, -2.0, 3.0);
    turn(s, 1e-3 * Vector3(1.0, 2.0, -3.0));
    s.position_sigma_ned_m = Vector3(2.0, 1.0, 0.5);
    s.velocity_sigma_ned_m_per_s = Vector3(0.5, 1.0, 1.5);
    s.attitude_sigma_rad = 1e-3 * Vector3(1.0, 2.0, 1.0);
  });
  EXPECT_NEAR(*in_all(scorer, Metric::PositionNees), 17.0, 17.0 * 2.0 * kRounding_m);
  EXPECT_NEAR(*in_all(scorer, Metric::VelocityNees), 12.0, 1e-9);
  EXPECT_NEAR(*in_all(scorer, Metric::AttitudeNees), 11.0, 1e-8);
}

TEST(NeesFigures, LeaveOutSolutionsWithoutAllThreeSigmas) {
  const Scorer scorer = scored(30, [](int k, NavSolution& s) {
    s.v_n += Vector3(0.0, 2.0, 0.0);
    if (k % 3 == 1) s.velocity_sigma_ned_m_per_s.z() = 0.0;
    if (k % 3 == 2) s.velocity_sigma_ned_m_per_s.x() = std::nan("");
    s.attitude_sigma_rad = Vector3::Zero();
  });
  EXPECT_EQ(all_of(scorer).velocity_nees().count, 10u);
  EXPECT_NEAR(*in_all(scorer, Metric::VelocityNees), 4.0, 1e-12);
  EXPECT_FALSE(in_all(scorer, Metric::AttitudeNees));
}

// At the answer's own time the truth is on the cubic through its neighbours: at 1 m/s^2 along north, position and
// velocity are the parabola's. An app that is right at its own time of validity has no error between two samples.
TEST(PositionFigures, AreOfTheSolutionsOwnTimeOfValidity) {
  Scorer scorer(scenario_with());
  const auto at = [](double t_s) {
    TruthState truth = standing(t_s);
    const nav::Geodetic start = geodetic_of(truth);
    const nav::Geodetic place = nav::displaced(start, Vector3(0.5 * t_s * t_s, 0.0, 0.0));
    truth.latitude_rad = place.latitude_rad;
    truth.longitude_rad = place.longitude_rad;
    truth.height_m = place.height_m;
    truth.v_n = Vector3(t_s, 0.0, 0.0);
    return truth;
  };
  for (int k = 0; k <= 100; ++k) scorer.add(at(k * 0.01));
  for (int k = 0; k < 100; ++k) scorer.add(solution_at(at(k * 0.01 + 0.0037), Vector3::Zero()), 0);
  scorer.finish();
  EXPECT_EQ(scorer.counts().scored, 100u);
  EXPECT_LT(*in_all(scorer, Metric::HorizontalMax), kRounding_m);
  // The positions' rounding over the interval, 1e-9 m / 0.01 s times 1.5; and the meridian's curvature, which turns the
  // velocity by 1e-7 of 1 m/s from one end of the path to the other.
  EXPECT_LT(all_of(scorer).velocity().largest.norm(), 1e-6);
}

}  // namespace figures_test
}  // namespace inslab::score
