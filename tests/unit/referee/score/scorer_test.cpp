#include "inslab/referee/score/scorer.hpp"

#include <gtest/gtest.h>

#include <random>

#include "inslab/foundation/time/gps_time.hpp"
#include "tests/unit/referee/score/straight_run.hpp"

namespace inslab::score {
namespace scorer_test {

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
    const double t_s = time::to_seconds(truth.header.sim_time_ns);
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

TEST(Scorer, TheAppsSensorsAreThoseOfItsOptionsElseOfTheScenariosAppElseTheFirst) {
  scenario::Scenario scenario = scenario_with();
  for (const std::uint32_t number : {1U, 2U}) scenario.imu.emplace_back().number = number;
  const auto error_m = [&](const Scorer::Options& options) {
    Scorer scorer(scenario, options);
    for (const std::uint32_t number : {0U, 1U, 2U}) {
      InstallationProfile installation;
      installation.target = {SensorKind::Imu, number};
      installation.lever_arm_v_m = Vector3(10.0 * number, 0.0, 0.0);
      scorer.add(installation, -1);
    }
    NavSolution at_the_vehicle = solution_at(standing(0.0), Vector3::Zero());
    at_the_vehicle.reference_point = ReferencePoint::Imu;
    scorer.add(standing(0.0));
    scorer.add(at_the_vehicle, 0);
    scorer.add(standing(0.01));
    scorer.finish();
    return *in_all(scorer, Metric::HorizontalMax);
  };
  EXPECT_NEAR(error_m({}), 0.0, 1e-8);
  scenario.reference_nav.emplace().imu = 1;
  EXPECT_NEAR(error_m({}), 10.0, 1e-8);
  Scorer::Options options;
  options.imu_number = 2;
  EXPECT_NEAR(error_m(options), 20.0, 1e-8);
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
}

// An absurd time, without the name of an IMU sample, 40 s ahead: the honest solutions after it are scored.
TEST(Scorer, ASingleSolutionOfTheFutureSpoilsNone) {
  Scorer scorer(scenario_with());
  for (int k = 0; k <= 6000; ++k) {
    const TruthState truth = standing(k * 0.01);
    scorer.add(truth);
    if (k == 100) scorer.add(solution_at(standing(41.0), Vector3(1000.0, 0.0, 0.0)), 0);
    scorer.add(solution_at(truth, Vector3(1.0, 0.0, 0.0)), 0);
  }
  scorer.finish();
  EXPECT_EQ(scorer.counts().future, 1u);
  EXPECT_EQ(scorer.counts().scored, 6001u);
  EXPECT_NEAR(*in_all(scorer, Metric::HorizontalMax), 1.0, 1e-8);
}

TEST(Scorer, ASolutionMoreThanASecondFromTheImuSampleItNamesIsStaleOrOfTheFuture) {
  Scorer scorer(scenario_with());
  for (int k = 0; k <= 500; ++k) scorer.add(standing(k * 0.01));
  ImuSample imu;
  imu.header.sequence_number = 7;
  imu.header.sim_time_ns = ns(2.5);
  scorer.add(imu);
  for (const double t_s : {1.49, 1.5, 3.5, 3.51}) {
    NavSolution solution = solution_at(standing(t_s), Vector3::Zero());
    solution.imu_sequence = 7;
    scorer.add(solution, 0);
  }
  scorer.finish();
  EXPECT_EQ(scorer.counts().stale, 1u);
  EXPECT_EQ(scorer.counts().future, 1u);
  EXPECT_EQ(scorer.counts().scored, 2u);
}

TEST(Scorer, ASolutionBeforeTheTruthThatIsKeptIsStale) {
  Scorer::Options options;
  options.window = 10;
  Scorer scorer(scenario_with(), options);
  for (int k = 0; k <= 100; ++k) scorer.add(standing(k * 0.01));
  scorer.add(solution_at(standing(0.5), Vector3::Zero()), 0);
  scorer.add(solution_at(standing(0.95), Vector3::Zero()), 0);
  scorer.finish();
  EXPECT_EQ(scorer.counts().stale, 1u);
  EXPECT_EQ(scorer.counts().scored, 1u);
}

TEST(Scorer, CountsWhatIsNotFiniteOrNowhere) {
  Scorer scorer(scenario_with());
  for (int k = 0; k <= 100; ++k) scorer.add(standing(k * 0.01));
  const auto add = [&](const std::function<void(NavSolution&)>& spoil) {
    NavSolution solution = solution_at(standing(0.5), Vector3::Zero());
    spoil(solution);
    scorer.add(solution, 0);
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  add([](NavSolution& s) { s.latitude_rad = kNan; });
  add([](NavSolution& s) { s.longitude_rad = kInf; });
  add([](NavSolution& s) { s.height_m = 2e5; });
  add([](NavSolution& s) { s.latitude_rad = 1.6; });
  add([](NavSolution& s) { s.v_n.z() = -kInf; });
  add([](NavSolution& s) { s.q_n_body.x() = kNan; });
  add([](NavSolution& s) { s.q_n_body.coeffs() *= 1.1; });
  add([](NavSolution& s) { s.gps_time_of_week_ns = -1; });
  add([](NavSolution& s) { s.gps_week = 4'000'000'000; });
  scorer.finish();
  EXPECT_EQ(scorer.counts().non_finite, 9u);
  EXPECT_EQ(scorer.counts().scored, 0u);
}

// 100 Hz from 1 s on, silent from 2 to 2.6 s, and again from 3 s to the end at 4 s.
TEST(Scorer, SilenceBetweenSolutionsAndAfterTheLastIsAGap) {
  Scorer scorer(scenario_with());
  for (int k = 0; k <= 400; ++k) {
    const TruthState truth = standing(k * 0.01);
    scorer.add(truth);
    if ((k >= 100 && k <= 200) || (k >= 260 && k <= 300)) scorer.add(solution_at(truth, Vector3::Zero()), 0);
  }
  scorer.finish();
  EXPECT_EQ(*in_all(scorer, Metric::TimeToFirstSolution), 1.0);
  EXPECT_DOUBLE_EQ(*in_all(scorer, Metric::LongestGap), 1.0);
  EXPECT_EQ(scorer.rhythm().gaps(), 2u);
  EXPECT_DOUBLE_EQ(*in_all(scorer, Metric::Rate), 141.0 / 2.0);  // 142 solutions in 2 s
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
  scorer.without_latency("the run was in lockstep");
  EXPECT_FALSE(in_all(scorer, Metric::LatencyP50));
}

TEST(Latency, OfASolutionThatCameBeforeItsImuSampleWasSentIsCountedApart) {
  Latency latency;
  ImuSample imu;
  imu.header.sequence_number = 1;
  imu.header.publish_realtime_ns = ns(1000.0);
  latency.add(imu);
  NavSolution solution;
  solution.imu_sequence = 1;
  latency.note(*latency.named_by(solution), ns(999.9));
  EXPECT_EQ(latency.negative(), 1u);
  EXPECT_EQ(latency.seconds().count(), 0u);
  latency.note(*latency.named_by(solution), ns(1000.25));
  EXPECT_EQ(latency.seconds().largest(), 0.25);
  solution.imu_sequence = 2;
  EXPECT_EQ(latency.named_by(solution), nullptr);
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

}  // namespace scorer_test
}  // namespace inslab::score
