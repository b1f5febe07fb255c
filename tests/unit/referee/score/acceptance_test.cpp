#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "inslab/referee/score/score_text.hpp"
#include "inslab/referee/score/verdict.hpp"
#include "tests/unit/referee/score/straight_run.hpp"

namespace inslab::score {
namespace acceptance_test {

using scenario::AcceptanceLimit;
using scenario::Metric;
using scenario::Phase;
using testing::HasSubstr;

AcceptanceLimit at_most(Metric metric, double limit, double after_s = 0.0) {
  AcceptanceLimit line;
  line.metric = metric;
  line.after_s = after_s;
  line.at_most = limit;
  return line;
}

/// What becomes of the lines when an app that is off by 1 m answers from `first_s` on, ten seconds long.
std::vector<Verdict> verdicts(const std::vector<AcceptanceLimit>& lines, double first_s) {
  Scorer scorer(scenario_with(lines));
  for (int k = 0; k <= 1000; ++k) {
    const TruthState truth = standing(k * 0.01);
    scorer.add(truth);
    if (k * 0.01 >= first_s) scorer.add(solution_at(truth, Vector3(1.0, 0.0, 0.0)), 0);
  }
  scorer.finish();
  return judge(scorer, lines);
}

TEST(Acceptance, ALinePassesInsideItsLimitsAndFailsOutside) {
  const auto judged = verdicts({at_most(Metric::HorizontalRms, 1.1), at_most(Metric::HorizontalRms, 0.9)}, 0.0);
  EXPECT_TRUE(judged[0].passed);
  EXPECT_FALSE(judged[1].passed);
  EXPECT_EQ(judged[1].why, "1 is above 0.9");
}

TEST(Acceptance, AMissingAppFailsEveryLine) {
  const auto judged = verdicts({at_most(Metric::HorizontalRms, 1.1), at_most(Metric::Stale, 0.0)}, 100.0);
  for (const Verdict& verdict : judged) {
    EXPECT_FALSE(verdict.passed);
    EXPECT_EQ(verdict.why, "no solution came: the app is missing");
  }
}

TEST(Acceptance, ALateAppFailsUnlessTheLineLetsItConverge) {
  const auto judged = verdicts({at_most(Metric::HorizontalRms, 1.1), at_most(Metric::HorizontalRms, 1.1, 3.0)}, 3.0);
  EXPECT_FALSE(judged[0].passed);
  EXPECT_THAT(judged[0].why, HasSubstr("solutions cover 7"));
  EXPECT_TRUE(judged[1].passed) << judged[1].why;
}

TEST(Acceptance, AFigureThatDoesNotExistFails) {
  const auto judged = verdicts({at_most(Metric::OutageDriftMax, 1.0)}, 0.0);
  EXPECT_FALSE(judged[0].passed);
}

TEST(Acceptance, ALatencyInLockstepIsNoneAndItsLineFailsSayingSo) {
  Scorer scorer(scenario_with());
  for (int k = 0; k <= 100; ++k) {
    const double t_s = k * 0.01;
    ImuSample imu;
    imu.header.sequence_number = static_cast<std::uint64_t>(k) + 1;
    stamp(imu.header, t_s);
    imu.header.publish_realtime_ns = ns(1000.0 + t_s);
    scorer.add(imu);
    scorer.add(standing(t_s));
    NavSolution solution = solution_at(standing(t_s), Vector3::Zero());
    solution.imu_sequence = imu.header.sequence_number;
    scorer.add(solution, ns(1000.001 + t_s));
  }
  scorer.finish();
  const std::vector<AcceptanceLimit> line{at_most(Metric::LatencyMax, 5.0)};
  EXPECT_TRUE(judge(scorer, line)[0].passed);
  scorer.without_latency(kLockstepHasNoLatency);
  EXPECT_FALSE(judge(scorer, line)[0].passed);
  EXPECT_THAT(score_text(scorer, judge(scorer, line)),
              HasSubstr("FAIL  latency_max_ms, at most 5: - (the run was in lockstep"));
}

TEST(Acceptance, AnAppThatFallsSilentFailsTheLinesOfItsGapAndOfItsErrors) {
  const std::vector<AcceptanceLimit> lines{at_most(Metric::LongestGap, 1.0), at_most(Metric::HorizontalRms, 1.1)};
  Scorer scorer(scenario_with(lines));
  for (int k = 0; k <= 1000; ++k) {
    const TruthState truth = standing(k * 0.01);
    scorer.add(truth);
    if (k <= 600) scorer.add(solution_at(truth, Vector3(1.0, 0.0, 0.0)), 0);
  }
  scorer.finish();
  const auto judged = judge(scorer, lines);
  EXPECT_EQ(judged[0].why, "4 is above 1");
  EXPECT_EQ(judged[1].why, "solutions cover 7 s of 10 s");
}

TEST(Acceptance, JUnitSaysWhichLinesFailedAndWhy) {
  const std::string xml =
      junit_xml("a <run>", verdicts({at_most(Metric::HorizontalRms, 1.1), at_most(Metric::HorizontalMax, 0.5)}, 0.0));
  EXPECT_THAT(xml, HasSubstr("<testsuite name=\"a &lt;run&gt;\" tests=\"2\" failures=\"1\""));
  EXPECT_THAT(xml, HasSubstr("<testcase classname=\"acceptance\" name=\"horizontal_max_m, at most 0.5\">"));
  EXPECT_THAT(xml, HasSubstr("<failure message=\"1 is above 0.5\"/>"));
}

}  // namespace acceptance_test
}  // namespace inslab::score
