#include "score/scorer.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/score/straight_run.hpp"

namespace inslab::score {
namespace {

using scenario::Metric;
using scenario::Phase;

/// A standing vehicle for `seconds` at 100 Hz, an app that answers every sample with this error.
template <class ErrorAt>
void run(Scorer& scorer, double seconds, const ErrorAt& error_ned_m) {
  for (int k = 0; k <= static_cast<int>(seconds * 100.0); ++k) {
    const TruthState truth = standing(k * 0.01);
    scorer.add(truth);
    scorer.add(solution_at(truth, error_ned_m(truth)), 0);
  }
  scorer.finish();
}

void add_fix(Scorer& scorer, double t_s, FixType type) {
  GnssFix fix;
  stamp(fix.header, t_s);
  fix.fix_type = type;
  scorer.add(fix);
}

TEST(Scorer, AConstantErrorIsItsOwnMeanRmsAndQuantile) {
  Scorer scorer(scenario_with());
  run(scorer, 2.0, [](const TruthState&) { return Vector3(3.0, -4.0, 2.0); });
  const ErrorStatistics& all = scorer.phases().at({});
  EXPECT_EQ(all.count(), 201u);
  EXPECT_LT((all.position().mean(201) - Vector3(3.0, -4.0, 2.0)).norm(), 1e-8);
  EXPECT_NEAR(*in_all(scorer, Metric::HorizontalRms), 5.0, 1e-8);
  EXPECT_NEAR(*in_all(scorer, Metric::HorizontalMax), 5.0, 1e-8);
  EXPECT_NEAR(*in_all(scorer, Metric::Cep50), 5.0, 0.025);  // half a bin of 1 %
  EXPECT_NEAR(*in_all(scorer, Metric::Vertical95), 2.0, 0.01);
  EXPECT_NEAR(*in_all(scorer, Metric::PositionNees), 29.0, 1e-6);  // 9 + 16 + 4, sigmas of 1
  EXPECT_NEAR(*in_all(scorer, Metric::Rate), 100.0, 1e-9);
  EXPECT_EQ(*in_all(scorer, Metric::TimeToFirstSolution), 0.0);
}

TEST(Scorer, CepAndNeesOfNormalErrorsAreThoseOfTheirDistributions) {
  Scorer scorer(scenario_with());
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  run(scorer, 200.0, [&](const TruthState&) { return Vector3(normal(engine), normal(engine), normal(engine)); });
  // N = 20001. Rayleigh: the q-quantile is sqrt(-2 ln(1-q)), its density there r (1-q); four standard errors of a
  // quantile, 4 sqrt(q (1-q) / N) over the density, and half a bin.
  const double n = 20001.0;
  for (const auto& [metric, q] : {std::pair{Metric::Cep50, 0.5}, std::pair{Metric::Cep95, 0.95}}) {
    const double r = std::sqrt(-2.0 * std::log(1.0 - q));
    EXPECT_NEAR(*in_all(scorer, metric), r, 4.0 * std::sqrt(q * (1.0 - q) / n) / (r * (1.0 - q)) + 0.005 * r);
  }
  EXPECT_NEAR(*in_all(scorer, Metric::PositionNees), 3.0, 4.0 * std::sqrt(6.0 / n));  // chi-squared of 3: variance 6
}

TEST(Scorer, AnOutageReachesFromTheLastFixToTheNext) {
  scenario::Scenario scenario = scenario_with();
  scenario.gnss.emplace_back();
  Scorer scorer(scenario);
  for (int k = 0; k <= 50; ++k) add_fix(scorer, k * 0.2, k >= 11 && k <= 20 ? FixType::None : FixType::Fixed);
  run(scorer, 10.0, [](const TruthState& truth) {
    const double t_s = static_cast<double>(truth.header.sim_time_ns) * 1e-9;
    return Vector3(t_s > 2.0 && t_s < 4.2 ? t_s - 2.0 : 0.0, 0.0, 0.0);
  });
  ASSERT_EQ(scorer.outages().size(), 1u);
  EXPECT_EQ(scorer.outages()[0].begin_ns, ns(2.0));
  EXPECT_EQ(scorer.outages()[0].end_ns, ns(4.2));
  EXPECT_EQ(scorer.outages()[0].solutions, 219u);  // 2.01 to 4.19 s
  EXPECT_NEAR(*in_all(scorer, Metric::OutageDriftMax), 2.19, 1e-8);
  EXPECT_NEAR(*figure(scorer, Metric::HorizontalMax, {Phase::BetweenOutages, 0, 0.0}), 0.0, 1e-8);
}

TEST(Scorer, AReceiverThatSaysNothingIsInAnOutage) {
  scenario::Scenario scenario = scenario_with();
  scenario.gnss.emplace_back();
  Scorer scorer(scenario);
  for (int k = 0; k <= 50; ++k) {
    if (k < 11 || k > 20) add_fix(scorer, k * 0.2, FixType::Fixed);
  }
  run(scorer, 10.0, [](const TruthState&) { return Vector3(1.0, 0.0, 0.0); });
  ASSERT_EQ(scorer.outages().size(), 1u);
  EXPECT_EQ(scorer.outages()[0].begin_ns, ns(2.0));
  EXPECT_EQ(scorer.outages()[0].end_ns, ns(4.2));
  EXPECT_EQ(scorer.outages()[0].solutions, 219u);
}

TEST(Scorer, TheReferencePointFollowsTheInstallationThatIsInUse) {
  Scorer scorer(scenario_with());
  InstallationProfile first, second;
  first.lever_arm_v_m = Vector3(1.0, 0.0, 0.0);
  second.lever_arm_v_m = Vector3(0.0, 2.0, 0.0);
  scorer.add(first, -1);
  scorer.add(second, ns(0.5));
  for (int k = 0; k <= 100; ++k) {
    const TruthState truth = standing(k * 0.01);
    NavSolution solution = solution_at(truth, k <= 50 ? first.lever_arm_v_m : second.lever_arm_v_m);
    solution.reference_point = ReferencePoint::Imu;
    scorer.add(truth);
    scorer.add(solution, 0);
  }
  scorer.finish();
  EXPECT_EQ(scorer.counts().scored, 101u);
  EXPECT_LT(*in_all(scorer, Metric::HorizontalMax), 1e-8);
}

TEST(Scorer, CountsWhatCannotBeScoredAndScoresTheRest) {
  Scorer scorer(scenario_with());
  for (int k = 0; k <= 400; ++k) scorer.add(standing(k * 0.01));
  const auto add = [&](double t_s) { scorer.add(solution_at(standing(t_s), Vector3::Zero()), 0); };
  add(1.0);
  add(1.0);    // twice
  add(0.5);    // out of order
  add(-1.0);   // before the run
  add(100.0);  // long after the truth
  NavSolution broken = solution_at(standing(1.1), Vector3::Zero());
  broken.v_n.x() = std::numeric_limits<double>::quiet_NaN();
  scorer.add(broken, 0);
  NavSolution aligning = solution_at(standing(1.2), Vector3::Zero());
  aligning.mode = NavMode::Aligning;
  scorer.add(aligning, 0);
  add(2.0);
  scorer.finish();
  const SolutionCounts& counts = scorer.counts();
  EXPECT_EQ(counts.received, 8u);
  EXPECT_EQ(counts.scored, 2u);
  EXPECT_EQ(counts.duplicates, 1u);
  EXPECT_EQ(counts.out_of_order, 1u);
  EXPECT_EQ(counts.stale, 1u);
  EXPECT_EQ(counts.future, 1u);
  EXPECT_EQ(counts.non_finite, 1u);
  EXPECT_EQ(counts.modes[static_cast<std::size_t>(NavMode::Aligning)], 1u);
  EXPECT_EQ(scorer.gaps(), 1u);
  EXPECT_DOUBLE_EQ(scorer.longest_gap_s(), 1.0);
}

TEST(Scorer, ASolutionThatComesBeforeItsTruthWaits) {
  Scorer scorer(scenario_with());
  scorer.add(solution_at(standing(0.0), Vector3::Zero()), 0);
  scorer.add(standing(0.0));
  scorer.add(solution_at(standing(0.03), Vector3(1.0, 0.0, 0.0)), 0);
  for (int k = 1; k <= 10; ++k) scorer.add(standing(k * 0.01));
  scorer.finish();
  EXPECT_EQ(scorer.counts().received, 2u);
  EXPECT_EQ(scorer.counts().scored, 2u);
  EXPECT_NEAR(*in_all(scorer, Metric::HorizontalMax), 1.0, 1e-8);
}

TEST(Scorer, LatencyIsFromTheSendingOfTheImuSampleThatASolutionNames) {
  Scorer scorer(scenario_with());
  scorer.add(standing(0.0));
  for (std::uint64_t k = 1; k <= 100; ++k) {
    const double t_s = static_cast<double>(k) * 0.01;
    ImuSample imu;
    stamp(imu.header, t_s);
    imu.header.sequence_number = k;
    imu.header.publish_realtime_ns = ns(1000.0 + t_s);
    scorer.add(imu);
    scorer.add(standing(t_s));
    NavSolution solution = solution_at(standing(t_s), Vector3::Zero());
    solution.imu_sequence = k;
    scorer.add(solution, ns(1000.0 + t_s + (k == 100 ? 0.02 : 0.002)));
  }
  scorer.finish();
  EXPECT_NEAR(*in_all(scorer, Metric::LatencyP50), 2.0, 0.01);
  EXPECT_NEAR(*in_all(scorer, Metric::LatencyMax), 20.0, 1e-3);
}

TEST(Scorer, SwapsPartTheRun) {
  Scorer scorer(scenario_with());
  for (int k = 0; k <= 100; ++k) {
    TruthState truth = standing(k * 0.01);
    truth.journal_in_effect = k > 60 ? 1 : 0;
    scorer.add(truth);
    scorer.add(solution_at(truth, Vector3(k > 60 ? 2.0 : 1.0, 0.0, 0.0)), 0);
  }
  scorer.finish();
  EXPECT_NEAR(*figure(scorer, Metric::HorizontalRms, {Phase::SwapInterval, 0, 0.0}), 1.0, 1e-8);
  EXPECT_NEAR(*figure(scorer, Metric::HorizontalRms, {Phase::SwapInterval, 1, 0.0}), 2.0, 1e-8);
}

}  // namespace
}  // namespace inslab::score
