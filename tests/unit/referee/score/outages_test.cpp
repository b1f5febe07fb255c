#include "inslab/referee/score/outages.hpp"

#include <gtest/gtest.h>

#include "tests/unit/referee/score/straight_run.hpp"

namespace inslab::score {
namespace outages_test {

using scenario::Metric;

/// Twenty seconds of a standing vehicle at 100 Hz with fixes at 5 Hz except where `silent(t)`; the answers are off to
/// the north by the time since `resets_at`'s newest entry, and down by half of it.
Scorer with_outages(const std::function<bool(double)>& silent, const std::vector<double>& resets_at) {
  scenario::Scenario scenario = scenario_with();
  scenario.gnss.emplace_back().rate_hz = 5.0;
  Scorer scorer(scenario);
  for (int k = 0; k <= 2000; ++k) {
    const double t_s = k * 0.01;
    const TruthState truth = standing(t_s);
    if (k % 20 == 0 && !silent(t_s)) {
      GnssFix fix;
      stamp(fix.header, t_s);
      fix.fix_type = FixType::Fixed;
      scorer.add(fix);
    }
    double since_s = 0.0;
    for (const double reset_s : resets_at) {
      if (t_s > reset_s) since_s = t_s - reset_s;
    }
    scorer.add(truth);
    scorer.add(solution_at(truth, Vector3(since_s, 0.0, -0.5 * since_s)), 0);
  }
  scorer.finish();
  return scorer;
}

// The last fix before the outage is at 4 s, the first after it at 7.2 s; the error grows by 1 m/s from 4 s on, so the
// largest inside is that of 7.19 s: 3.19 m, and 1.595 m down.
TEST(OutageDrift, IsTheLargestErrorBetweenTheFixes) {
  const Scorer scorer = with_outages([](double t_s) { return t_s > 4.1 && t_s < 7.1; }, {4.0, 7.19});
  ASSERT_EQ(scorer.outages().size(), 1u);
  EXPECT_EQ(scorer.outages()[0].begin_ns, ns(4.0));
  EXPECT_EQ(scorer.outages()[0].end_ns, ns(7.2));
  EXPECT_NEAR(scorer.outages()[0].horizontal_m, 3.19, 1e-8);
  EXPECT_NEAR(scorer.outages()[0].vertical_m, 1.595, 1e-8);
}

// Largest errors 3.19 m and 5.19 m: RMS sqrt((3.19^2 + 5.19^2)/2).
TEST(OutageDrift, RmsIsOverTheOutagesOfTheLargestErrorInEach) {
  const Scorer scorer = with_outages([](double t_s) { return (t_s > 4.1 && t_s < 7.1) || (t_s > 10.1 && t_s < 15.1); },
                                     {4.0, 7.19, 10.0, 15.19});
  ASSERT_EQ(scorer.outages().size(), 2u);
  EXPECT_NEAR(*in_all(scorer, Metric::OutageDriftRms), std::sqrt((3.19 * 3.19 + 5.19 * 5.19) / 2.0), 1e-8);
  EXPECT_NEAR(*in_all(scorer, Metric::OutageDriftMax), 5.19, 1e-8);
  EXPECT_NEAR(*in_all(scorer, Metric::OutageVerticalDriftRms), std::sqrt((3.19 * 3.19 + 5.19 * 5.19) / 8.0), 1e-8);
  EXPECT_NEAR(*in_all(scorer, Metric::OutageVerticalDriftMax), 2.595, 1e-8);
}

TEST(OutageDrift, OfAnOutageThatOutlastsTheRunGoesToItsEnd) {
  const Scorer scorer = with_outages([](double t_s) { return t_s > 12.1; }, {12.0});
  ASSERT_EQ(scorer.outages().size(), 1u);
  EXPECT_EQ(scorer.outages()[0].begin_ns, ns(12.0));
  EXPECT_EQ(scorer.outages()[0].end_ns, ns(20.0));
  EXPECT_EQ(scorer.outages()[0].solutions, 800u);  // 12.01 to 20.00 s
  EXPECT_NEAR(scorer.outages()[0].horizontal_m, 8.0, 1e-8);
}

TEST(OutageDrift, ARunThatEndsBetweenTwoEpochsIsNotInAnOutage) {
  EXPECT_TRUE(with_outages([](double t_s) { return t_s > 19.9; }, {}).outages().empty());
}

TEST(OutageDrift, BeforeTheFirstFixThereIsNoOutage) {
  EXPECT_TRUE(with_outages([](double t_s) { return t_s < 5.0; }, {}).outages().empty());
}

TEST(OutageDrift, OneMissingEpochIsAnOutage) {
  const Scorer scorer = with_outages([](double t_s) { return t_s > 9.9 && t_s < 10.1; }, {});
  ASSERT_EQ(scorer.outages().size(), 1u);
  EXPECT_EQ(scorer.outages()[0].begin_ns, ns(9.8));
  EXPECT_EQ(scorer.outages()[0].end_ns, ns(10.2));
}

TEST(Outages, WaitForAnEpochThatIsLateButNotForever) {
  Outages outages(ns(0.2));
  outages.add(ns(1.0), true);
  EXPECT_TRUE(outages.can_tell(ns(1.0), ns(1.0)));
  EXPECT_FALSE(outages.can_tell(ns(1.1), ns(3.0)));
  EXPECT_TRUE(outages.can_tell(ns(1.1), ns(6.2)));  // five seconds of silence
}

TEST(Outages, WithoutAReceiverThereAreNone) {
  Outages outages(0);
  EXPECT_TRUE(outages.can_tell(ns(1.0), ns(1.0)));
  EXPECT_FALSE(outages.contains(ns(1.0), ns(100.0)));
}

}  // namespace outages_test
}  // namespace inslab::score
