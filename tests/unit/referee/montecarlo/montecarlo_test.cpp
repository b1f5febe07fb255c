#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "inslab/data/json/json_writer.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/noise/random/stream.hpp"
#include "inslab/referee/montecarlo/result_folder.hpp"
#include "inslab/referee/montecarlo/single_run.hpp"
#include "inslab/referee/montecarlo/summary_text.hpp"
#include "inslab/referee/score/score_log.hpp"
#include "inslab/sim/log_sink.hpp"

namespace inslab::montecarlo {
namespace montecarlo_test {

using testing::HasSubstr;

/// 1 to `n`.
std::vector<double> ranks(int n) {
  std::vector<double> values;
  for (int i = n; i >= 1; --i) values.push_back(i);
  return values;
}

TEST(MontecarloConfidence, AMeanHasStudentsInterval) {
  const Estimate mean = mean_of({1.0, 2.0, 3.0, 4.0});
  EXPECT_DOUBLE_EQ(mean.value, 2.5);
  // t(0.975, 3) = 3.182446 of any table; s = sqrt(5/3).
  const double half = 3.182446 * std::sqrt(5.0 / 3.0) / 2.0;
  EXPECT_NEAR(*mean.low, 2.5 - half, 1e-6);
  EXPECT_NEAR(*mean.high, 2.5 + half, 1e-6);
  EXPECT_FALSE(mean_of({1.0}).low);
}

TEST(MontecarloConfidence, AnRmsHasTheIntervalOfChiSquare) {
  // Squares 1 and 0: M = 1/2, v = 1/2, so 2 degrees, where chi-square's quantile is -2 ln(1 - p).
  const Estimate rms = rms_of({-1.0, 0.0});
  EXPECT_DOUBLE_EQ(rms.value, std::sqrt(0.5));
  EXPECT_NEAR(*rms.low, std::sqrt(1.0 / (-2.0 * std::log(0.025))), 1e-9);
  EXPECT_NEAR(*rms.high, std::sqrt(1.0 / (-2.0 * std::log(0.975))), 1e-9);
  EXPECT_DOUBLE_EQ(*rms_of({2.0, -2.0, 2.0}).high, 2.0);  // no spread
}

/// In how many of 1000 studies the interval of the RMS of `runs` standard normal values holds 1.
double coverage_of_rms(int runs) {
  constexpr int kStudies = 1000;
  const random::Stream draws(7, "montecarlo_test/" + std::to_string(runs));
  int held = 0;
  for (int study = 0; study < kStudies; ++study) {
    std::vector<double> values;
    for (int i = 0; i < runs; ++i) values.push_back(draws.normal(static_cast<std::uint64_t>(study * runs + i)));
    const Estimate rms = rms_of(values);
    if (*rms.low <= 1.0 && 1.0 <= *rms.high) ++held;
  }
  return held / double{kStudies};
}

TEST(MontecarloConfidence, AnRmsIntervalOfNormalValuesHoldsTheTruthAsOftenAsTheDocsSay) {
  // docs/montecarlo.md: less than 95 % since the degrees of freedom are estimated too. A share p of 1000 is known to
  // 3.5 sqrt(p (1 - p) / 1000).
  for (const auto& [runs, share] : {std::pair{5, 0.85}, {10, 0.89}, {20, 0.92}, {200, 0.94}}) {
    EXPECT_NEAR(coverage_of_rms(runs), share, 3.5 * std::sqrt(share * (1.0 - share) / 1000.0)) << runs;
  }
}

TEST(MontecarloConfidence, AQuantileLiesBetweenOrderStatistics) {
  // Binomial tables: P(B <= 1) = 0.011, P(B <= 2) = 0.055 of 10; P(B <= 39) = 0.018, P(B <= 40) = 0.028 of 100.
  const Estimate of_10 = quantile_of(ranks(10), 0.5), of_100 = quantile_of(ranks(100), 0.5);
  EXPECT_EQ(of_10.value, 5.0);
  EXPECT_EQ(of_10.low, 2.0);
  EXPECT_EQ(of_10.high, 9.0);
  EXPECT_EQ(of_100.low, 40.0);
  EXPECT_EQ(of_100.high, 61.0);
}

TEST(MontecarloConfidence, AQuantileBeyondWhatTheRunsCanTellIsOpen) {
  const Estimate estimate = quantile_of(ranks(5), 0.95);
  EXPECT_EQ(estimate.value, 5.0);
  EXPECT_EQ(estimate.low, 4.0);                  // P(B <= 3) = 0.0226
  EXPECT_FALSE(estimate.high);                   // P(B >= 5) = 0.77
  EXPECT_FALSE(quantile_of(ranks(5), 0.5).low);  // P(B = 0) = 1/32
}

TEST(MontecarloConfidence, AShareHasTheExactBinomialInterval) {
  const Estimate none = share_of(0, 10), half = share_of(5, 10);
  EXPECT_EQ(*none.low, 0.0);
  EXPECT_NEAR(*none.high, 1.0 - std::pow(0.025, 0.1), 1e-12);
  EXPECT_NEAR(*half.low, 0.18709, 1e-5);  // Clopper and Pearson's chart; by symmetry
  EXPECT_NEAR(*half.high, 1.0 - 0.18709, 1e-5);
}

TEST(MontecarloConfidence, AMeanOfChiSquaresHasABand) {
  const allan::Interval one = chi_square_mean_band(2.0, 1), many = chi_square_mean_band(3.0, 100);
  EXPECT_NEAR(one.low, -2.0 * std::log(0.975), 1e-9);
  EXPECT_NEAR(one.high, -2.0 * std::log(0.025), 1e-9);
  EXPECT_NEAR(many.low, 2.53912, 1e-5);  // chi-square of 300 degrees: 253.912, 349.874
  EXPECT_NEAR(many.high, 3.49874, 1e-5);
}

/// A run that is off by `error_m` to the north at its one instant, and passes its one line up to 2 m.
RunResult off_by(std::uint32_t run, double error_m) {
  RunResult result;
  result.fingerprint = "f";
  result.run = run;
  result.seed = 10 + run;
  result.figures = {{scenario::Metric::HorizontalRms, scenario::Phase::All, 0, 0.0, error_m}};
  result.outages = {{1.0, 2.0, error_m, 0.5 * error_m}};
  Instant instant;
  instant.number = 100;
  instant.time_s = 5.0;
  instant.position_error_ned_m.x() = error_m;
  instant.position_sigma_ned_m.x() = 2.0;
  instant.nees = 9.0 * error_m;
  result.instants = {instant};
  result.acceptance = {{"line", true, error_m <= 2.0, error_m <= 2.0 ? "" : "is above 2"}};
  return result;
}

TEST(MontecarloSummary, HasEveryFigureOverTheRuns) {
  const Summary s = summary_of("study", "f", 10, 3, {off_by(0, 1.0), off_by(1, 2.0), off_by(2, 3.0)});
  EXPECT_TRUE(s.complete());
  ASSERT_EQ(s.figures.size(), 1u);
  EXPECT_DOUBLE_EQ(s.figures[0].over_runs.mean.value, 2.0);
  EXPECT_DOUBLE_EQ(s.figures[0].over_runs.rms.value, std::sqrt(14.0 / 3.0));
  EXPECT_DOUBLE_EQ(s.outages.at(0).vertical_m.p95.value, 1.5);
  const InstantSummary& end = s.instants.at(0);
  EXPECT_DOUBLE_EQ(end.horizontal_m.rms.value, std::sqrt(14.0 / 3.0));
  EXPECT_DOUBLE_EQ(end.horizontal_m.sigma, 2.0);
  EXPECT_DOUBLE_EQ(end.cep50_m.value, 2.0);
  EXPECT_DOUBLE_EQ(end.nees, 18.0);
  EXPECT_EQ(s.nees_instants_out, 1u);  // 18 is above chi2(0.975, 27) / 3 = 14.4
  EXPECT_DOUBLE_EQ(s.nees->value, 18.0);
}

TEST(MontecarloSummary, CountsTheRunsThatPassedALine) {
  const Summary s = summary_of("study", "f", 10, 3, {off_by(0, 1.0), off_by(1, 2.0), off_by(2, 3.0)});
  EXPECT_EQ(s.acceptance.at(0).passed, 2u);
  EXPECT_THAT(summary_text(s), HasSubstr("2 of 3, share 0.6667 [0.0943, 0.9916]: line (run 2: is above 2)"));
}

TEST(MontecarloSummary, NamesRunsThatFailedAndRunsThatAreNotThere) {
  RunResult failed;
  failed.run = 2;
  failed.seed = 12;
  failed.failure = "the vehicle left the Earth";
  const Summary s = summary_of("study", "f", 10, 5, {off_by(0, 1.0), failed});
  EXPECT_FALSE(s.complete());
  EXPECT_EQ(s.missing, (std::vector<std::uint32_t>{1, 3, 4}));
  EXPECT_THAT(summary_text(s), HasSubstr("study: 1 of 5 runs, seeds 10 to 14\n"
                                         "FAILED  run 2, seed 12: the vehicle left the Earth\n"
                                         "MISSING 3 runs, the first is run 1\n"));
  EXPECT_EQ(summary_json(s).at("failed").at(0).at("seed"), 12);
}

/// A folder of a test, gone after it.
class Montecarlo : public testing::Test {
 protected:
  static std::string source(const std::string& path) { return std::string(INSLAB_SOURCE_DIR) + "/" + path; }
  static Study study(bool draw_start = false) {
    return load_study(source("tests/data/reference_nav.json"), "", draw_start, "1");
  }
  static bool never() { return false; }

  void SetUp() override {
    path_ = std::filesystem::temp_directory_path() / ("inslab-montecarlo-" + std::to_string(getpid()));
  }
  void TearDown() override { std::filesystem::remove_all(path_); }

  std::string file(const std::string& name) const { return (path_ / name).string(); }

  std::filesystem::path path_;
};

TEST_F(Montecarlo, ARunIsScoredAsItsLogIs) {
  Study s = study();
  const auto result = single_run(s, 3, never);
  ASSERT_TRUE(result && result->succeeded()) << result->failure;
  EXPECT_EQ(result->seed, 8u);

  s.loaded.scenario.seed = 8;
  const time::GpsTime start = s.loaded.start(time::Nanoseconds(0));
  std::filesystem::create_directories(path_);
  {
    sim::LogSink sink(file("log.mcap"), s.loaded, start);
    sim::OfflineRun run(s.loaded, start, RunId{}, sink);
    while (run.step()) {
    }
    sink.close();
  }
  const mcap::McapReader log(file("log.mcap"));
  const score::LogScore score = score::score_log(log, evidence::summarize(log));
  EXPECT_GT(result->figures.size(), 14u);
  for (const RunFigure& f : result->figures) {
    EXPECT_EQ(score::figure(score.scorer, f.metric, {f.phase, f.swap_interval, f.after_s}), f.value)
        << enum_name(f.metric);
  }
  ASSERT_EQ(result->outages.size(), 1u);
  EXPECT_EQ(result->outages[0].horizontal_m, score.scorer.outages().at(0).horizontal_m);
}

TEST_F(Montecarlo, ARunSaysWhatTheFilterBelievedAtItsInstants) {
  const auto result = single_run(study(true), 0, never);
  ASSERT_TRUE(result && result->succeeded()) << result->failure;
  ASSERT_EQ(result->instants.size(), kInstants);  // each but the one before the first sample
  EXPECT_EQ(result->instants.back().time_s, 10.0);
  EXPECT_EQ(result->instants.front().number, 1u);
  for (const Instant& instant : result->instants) EXPECT_GT(instant.nees, 0.0);
}

TEST_F(Montecarlo, AFilterThatNeverBeginsIsTheRunsFailure) {
  Study s = load_study(source("tests/data/reference_nav_at_rest.json"), "", false, "1");
  s.loaded.scenario.reference_nav->parameters.clear();  // a static alignment of a minute, in ten seconds
  const auto result = single_run(s, 0, never);
  ASSERT_TRUE(result);
  EXPECT_THAT(result->failure, HasSubstr("no solution was scored: "));
}

TEST_F(Montecarlo, ARunThatIsStoppedHasNoResult) {
  EXPECT_FALSE(single_run(study(), 0, [] { return true; }));
}

TEST_F(Montecarlo, AResultIsReadAsItWasWritten) {
  const Study s = study();
  const ResultFolder folder(path_.string(), s);
  RunResult result = off_by(4, 0.1);
  result.fingerprint = s.fingerprint;
  folder.keep(result);
  EXPECT_EQ(json::json_from_struct(*folder.result(4)), json::json_from_struct(result));
  EXPECT_FALSE(folder.result(5));
}

TEST_F(Montecarlo, AResultThatIsCutOffIsToBeDoneAgain) {
  const ResultFolder folder(path_.string(), study());
  std::ofstream(file("run_000004.json")) << "{\"fingerprint\": \"";
  EXPECT_FALSE(folder.result(4));
}

TEST_F(Montecarlo, WhatAKilledProcessWasWritingIsRemoved) {
  const ResultFolder first(path_.string(), study());
  const std::string host = host::host_name(), dead = "." + std::to_string(std::numeric_limits<pid_t>::max());
  std::ofstream(file(".run_000001.json." + host + dead)) << "{";
  std::ofstream(file(".run_000001.json." + host + "." + std::to_string(getpid()))) << "{";
  const ResultFolder second(path_.string(), study());
  EXPECT_FALSE(std::filesystem::exists(file(".run_000001.json." + host + dead)));
  EXPECT_TRUE(std::filesystem::exists(file(".run_000001.json." + host + "." + std::to_string(getpid()))));
}

TEST_F(Montecarlo, AFolderOfAnotherStudyIsRefusedWithWhatDiffers) {
  const ResultFolder first(path_.string(), study());
  EXPECT_NO_THROW(ResultFolder(path_.string(), study()));
  Study other = study(true);
  try {
    const ResultFolder second(path_.string(), other);
    FAIL() << "was taken";
  } catch (const files::ReadError& error) {
    EXPECT_THAT(error.what(), HasSubstr("holds the results of another study: draw_start is false there and true here"));
  }
}

TEST_F(Montecarlo, AResultOfAnotherStudyIsRefused) {
  const ResultFolder folder(path_.string(), study());
  folder.keep(off_by(4, 0.1));
  try {
    folder.result(4);
    FAIL() << "was taken";
  } catch (const files::ReadError& error) {
    EXPECT_THAT(error.what(), HasSubstr("run_000004.json: is run 4 of study f; expected run 4 of study "));
  }
}

TEST_F(Montecarlo, AStudyKnowsItsSensorsAndItsFilter) {
  const std::string fingerprint = study().fingerprint;
  EXPECT_EQ(study().fingerprint, fingerprint);
  EXPECT_NE(study(true).fingerprint, fingerprint);
  const Study other =
      load_study(source("tests/data/reference_nav.json"), source("config/nav/car_mems.json"), false, "1");
  EXPECT_NE(other.fingerprint, fingerprint);
  EXPECT_NE(load_study(source("tests/data/reference_nav.json"), "", false, "2").fingerprint, fingerprint);
  // The parameters count, not what their file is called.
  EXPECT_EQ(load_study(source("tests/data/reference_nav.json"), source("tests/data/reference_nav_parameters.json"),
                       false, "1")
                .fingerprint,
            fingerprint);
}

TEST_F(Montecarlo, AStudyNeedsNoLiveVehicle) {
  try {
    load_study(source("tests/data/live.json"), "", false, "1");
    FAIL() << "was taken";
  } catch (const files::ReadError& error) {
    EXPECT_THAT(error.what(), HasSubstr("live.json: trajectory.source is vehicle_state"));
  }
}

}  // namespace montecarlo_test
}  // namespace inslab::montecarlo
