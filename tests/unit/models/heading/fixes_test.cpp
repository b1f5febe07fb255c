// When a receiver with two antennas has a solution, and which.

#include <gtest/gtest.h>

#include "inslab/nav/direction.hpp"
#include "tests/unit/models/heading/heading_scene.hpp"

namespace inslab::heading {
namespace fixes_test {

using scene::fault;
using scene::setup;
using scene::truth_at;

LesserBaseline rung(FixType type, double lasts_s, double sigma_m) {
  LesserBaseline solution;
  solution.fix_type = type;
  solution.lasts_s = lasts_s;
  solution.relative_sigma_ned_m.setConstant(sigma_m);
  return solution;
}

HeadingModel::Setup with_ladder() {
  HeadingModel::Setup s = setup();
  s.errors.relative_sigma_ned_m.setConstant(1e-4);
  s.errors.lesser_solutions = {rung(FixType::None, 0.5, 0.0), rung(FixType::Float, 1.0, 0.02)};
  return s;
}

/// What comes at sample k: nothing, or the fix type.
std::string letters(HeadingModel& model, std::uint64_t from, std::uint64_t to) {
  std::string seen;
  for (std::uint64_t k = from; k <= to; ++k) {
    const auto sample = model.observe(truth_at(k));
    seen += !sample ? '-' : sample->fix_type == FixType::Fixed ? 'x' : sample->fix_type == FixType::Float ? 'f' : '?';
  }
  return seen;
}

TEST(HeadingFixes, ClimbTheLadderAfterAnOutage) {
  HeadingModel::Setup s = with_ladder();
  s.outages = {{0.3, 0.4, 0.0}};  // samples 3 to 6
  HeadingModel model(s);
  EXPECT_EQ(letters(model, 1, 24),
            "xx----"
            "-----"
            "ffffffffff"
            "xxx");
}

TEST(HeadingFixes, AreLostWhileAFaultTakesTheSignals) {
  HeadingModel model(with_ladder());
  EXPECT_EQ(letters(model, 1, 2), "xx");
  model.apply(fault([](FaultProfile& f) { f.heading_outage = true; }));
  EXPECT_EQ(letters(model, 3, 4), "--");
  model.apply(fault([](FaultProfile&) {}));
  EXPECT_EQ(letters(model, 5, 20),
            "-----"
            "ffffffffff"
            "x");
}

TEST(HeadingFixes, AreLostWhereTheFirstAntennaIsInAnArea) {
  HeadingModel::Setup s = setup();
  s.outage_areas = {{"hall", 5.0, {{0.84 / units::kDeg, 0.2 / units::kDeg}}}};
  HeadingModel model(s);
  EXPECT_EQ(letters(model, 1, 3), "---");
  InstallationProfile far = s.installation;
  far.lever_arm_v_m.x() += 100.0;
  far.second_lever_arm_v_m.x() += 100.0;
  model.apply(far);
  EXPECT_EQ(letters(model, 4, 5), "xx");
}

TEST(HeadingFixes, OfALesserSolutionHaveItsErrorsAndClaimThem) {
  HeadingModel::Setup s = with_ladder();
  s.outages = {{0.05, 0.1, 0.0}};
  HeadingModel model(s);
  letters(model, 1, 6);  // lost in the first, then five without
  const BaselineHeading floating = *model.observe(truth_at(7));
  ASSERT_EQ(floating.fix_type, FixType::Float);
  EXPECT_NEAR(floating.heading_sigma_rad, 0.01, 1e-3);
  double squares = std::pow(std::sin(floating.heading_rad), 2.0);
  for (std::uint64_t k = 8; k <= 16; ++k) squares += std::pow(std::sin(model.observe(truth_at(k))->heading_rad), 2.0);
  // Chi-square of ten degrees of freedom; 99.9 % are in here, and the best solution would make 2.5e-4 of it.
  EXPECT_GT(squares / 1e-4, 1.26);
  EXPECT_LT(squares / 1e-4, 31.4);
  EXPECT_NEAR(model.observe(truth_at(17))->heading_sigma_rad, 5e-5, 1e-8);
}

TEST(HeadingFixes, OutsideAnOutageHaveTheBitsOfARunWithoutIt) {
  HeadingModel::Setup s = setup();
  s.errors.relative_sigma_ned_m.setConstant(0.004);
  s.errors.relative_gm_sigma_ned_m.setConstant(0.004);
  s.errors.relative_gm_correlation_time_s.setConstant(10.0);
  HeadingModel whole(s);
  s.outages = {{1.0, 1.0, 0.0}};
  HeadingModel interrupted(s);
  for (std::uint64_t k = 1; k <= 40; ++k) {
    const auto a = whole.observe(truth_at(k)), b = interrupted.observe(truth_at(k));
    ASSERT_EQ(b.has_value(), k < 10 || k >= 20);
    if (b) {
      EXPECT_EQ(a->heading_rad, b->heading_rad);
    }
  }
}

HeadingModel::Setup with_wrong_fixes() {
  HeadingModel::Setup s = setup();
  s.errors.mean_time_between_wrong_fixes_s = 100.0;
  s.errors.wrong_fix_lasts_s = 2.0;
  s.errors.wrong_fix_offset_m = 0.19;
  return s;
}

Vector3 offset_of(const BaselineHeading& sample) {
  return nav::vector_of({sample.heading_rad, sample.pitch_rad}, sample.baseline_m) - Vector3(2.0, 0.0, 0.0);
}

/// A wrong fix begins on the average a mean after the end of the one before. The number in a time is Poisson's, nearly.
TEST(HeadingFixes, AreWrongAtRandomForATimeByAnOffsetInAnyDirection) {
  HeadingModel model(with_wrong_fixes());
  const std::uint64_t samples = 200000;
  int begun = 0, wrong = 0;
  Vector3 last = Vector3::Zero(), sum = Vector3::Zero(), squares = Vector3::Zero();
  for (std::uint64_t k = 1; k <= samples; ++k) {
    const BaselineHeading sample = *model.observe(truth_at(k));
    const Vector3 offset = offset_of(sample);
    EXPECT_EQ(sample.fix_type, FixType::Fixed);
    if (offset.norm() < 1e-3) {
      last.setZero();
      continue;
    }
    ++wrong;
    EXPECT_NEAR(offset.norm(), 0.19, 2e-6);
    if ((offset - last).norm() > 1e-6) {
      ++begun;
      sum += offset / 0.19;
      squares += (offset / 0.19).cwiseAbs2();
    }
    last = offset;
  }
  const double expected = 20000.0 / 102.0;
  EXPECT_NEAR(begun, expected, 4.0 * std::sqrt(expected));
  EXPECT_NEAR(wrong, 20.0 * begun, 20.0);  // the last one may not be over
  // A component of a uniform direction has the mean 0 and the mean square 1/3; its fourth moment is 1/5.
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(sum[axis] / begun, 0.0, 4.0 / std::sqrt(3.0 * begun));
    EXPECT_NEAR(squares[axis] / begun, 1.0 / 3.0, 4.0 * std::sqrt((1.0 / 5.0 - 1.0 / 9.0) / begun));
  }
}

TEST(HeadingFixes, AreNoLongerWrongAfterSignalsWereLost) {
  HeadingModel::Setup s = with_wrong_fixes();
  s.errors.mean_time_between_wrong_fixes_s = 1e-3;  // at once
  s.errors.wrong_fix_lasts_s = 1e5;
  HeadingModel model(s);
  const Vector3 first = offset_of(*model.observe(truth_at(1)));
  EXPECT_NEAR(first.norm(), 0.19, 2e-6);
  EXPECT_NEAR((offset_of(*model.observe(truth_at(2))) - first).norm(), 0.0, 1e-9);
  model.apply(fault([](FaultProfile& f) { f.heading_outage = true; }));
  EXPECT_FALSE(model.observe(truth_at(3)));
  model.apply(fault([](FaultProfile&) {}));
  EXPECT_GT((offset_of(*model.observe(truth_at(4))) - first).norm(), 1e-3) << "another one";
}

}  // namespace fixes_test
}  // namespace inslab::heading
