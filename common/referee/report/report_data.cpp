#include "inslab/referee/report/report_data.hpp"

#include <stdexcept>
#include <utility>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/formats/text/imu_errors.hpp"
#include "inslab/foundation/files/error.hpp"
#include "inslab/referee/score/score_words.hpp"

namespace inslab::cli {

namespace {

/// What a run was, with the fixes of its receiver when they are wanted.
struct WhatRan {
  LogSummary summary;
  std::vector<GnssFix> fixes;
};

WhatRan what_ran(const io::McapReader& log, bool with_fixes) {
  WhatRan ran;
  SummaryOfLog summary(log);
  io::LogWalk walk(log);
  summary.take_part(walk);
  const std::optional<std::uint32_t> receiver = receiver_of_app(summary.scenario());
  if (with_fixes && receiver) {
    const std::string wanted = catalog::stream_topic<GnssFix>(*receiver);
    walk.each<GnssFix>([&ran, wanted](const GnssFix& fix, const io::LogWalk::Place& place) {
      if (place.topic == wanted) ran.fixes.push_back(fix);
    });
  }
  walk.go();
  ran.summary = summary.finish();
  return ran;
}

/// Analyses the errors of the first IMU along a walk. A recording that cannot be analysed ends with the reason, and
/// the walk goes on.
class ImuErrorsOfLog {
 public:
  ImuErrorsOfLog(const io::McapReader& log, std::uint32_t number)
      : path_(log.path()), number_(number), options_(options_for(number)), analyser_(options_) {
    unless_refused([&] {
      errors_.emplace(
          log, options_.recording, [this](const io::ImuRecordingInfo& info) { analyser_.begin(info); },
          [this](const io::ImuIncrements& increments) { analyser_.add(increments); });
    });
  }

  void take_part(io::LogWalk& walk) {
    take_topic<ImuSample>(walk, catalog::stream_topic<ImuSample>(number_));
    take_topic<ImuTruth>(walk, catalog::stream_topic<ImuTruth>(number_));
  }

  void finish(ReportData& data) {
    unless_refused([&] { data.imu_errors = analyser_.finish(path_, errors_->finish()); });
    data.why_no_imu_errors = why_not_;
  }

 private:
  static AnalysisOptions options_for(std::uint32_t number) {
    AnalysisOptions options;
    options.recording.sensor_number = number;
    options.recording.minus_truth = options.recording.over_gaps = true;
    return options;
  }
  template <class Sample>
  void take_topic(io::LogWalk& walk, const std::string& topic) {
    walk.each<Sample>([this, topic](const Sample& sample, const io::LogWalk::Place& place) {
      if (place.topic == topic) unless_refused([&] { errors_->add(sample); });
    });
  }
  template <class Work>
  void unless_refused(const Work& work) {
    if (!why_not_.empty()) return;
    try {
      work();
    } catch (const io::ReadError& error) {
      why_not_ = error.what();
    } catch (const std::invalid_argument& error) {  // errors without noise, to which no model can be fitted
      why_not_ = path_ + ": " + error.what();
    }
  }

  std::string path_;
  std::uint32_t number_;
  AnalysisOptions options_;
  ImuAnalyser analyser_;
  std::optional<io::ImuErrors> errors_;
  std::string why_not_;
};

/// What the checks and the acceptance come to together; both are in the last line when they are as good.
app::Outcome with_acceptance(const app::Outcome& checks, const std::string& verdict, bool accepted) {
  if (checks.code == app::kOk && accepted) return {app::kOk, checks.reason + "; " + verdict};
  return worse(checks, {accepted ? app::kOk : app::kNotAccepted, verdict});
}

}  // namespace

ReportData report_data(const io::McapReader& log, ReportDepth depth) {
  const bool with_figures = depth != ReportDepth::Verdict;
  const WhatRan ran = what_ran(log, with_figures);
  io::LogWalk walk(log);
  SwapWeigher swaps(ran.summary);
  swaps.take_part(walk);
  ErrorCurves curves;
  ExpectationOfLog expectation(log, ran.summary, ran.fixes);
  LogScorer::OnScored on_scored;
  if (with_figures) {
    on_scored = [&](const score::ScoredSolution& scored) {
      expectation.add(scored);
      curves.add(scored);
    };
  }
  LogScorer scorer(ran.summary, on_scored);
  scorer.take_part(walk);
  if (with_figures) expectation.take_part(walk, [&scorer] { return scorer.judged_until_ns(); });
  std::optional<ImuErrorsOfLog> imu_errors;
  if (depth == ReportDepth::Page && !ran.summary.scenario.imu.empty()) {
    imu_errors.emplace(log, ran.summary.scenario.imu.front().number);
    imu_errors->take_part(walk);
  }
  walk.go();
  ReportData data{ran.summary, swaps.finish(), scorer.finish(), {}, expectation.finish(), {}, {}, {}, {}};
  data.between_outages = curves.ratios(data.expectation, false);
  data.in_outages = curves.ratios(data.expectation, true);
  data.curves = std::move(curves);
  if (imu_errors) imu_errors->finish(data);
  return data;
}

Judgement judgement_of(const ReportData& data, const std::optional<std::string>& failure) {
  const RunSummary summary = run_summary(data.summary, data.swaps, failure);
  Judgement judgement{summary.text, summary.outcome};
  const LogScore& score = data.score;
  if (score.scorer.counts().received > 0 || !score.verdicts.empty()) judgement.text += score_words(score);
  if (!score.verdicts.empty()) {
    judgement.outcome = with_acceptance(summary.outcome, verdict_words(score), score.accepted());
  }
  return judgement;
}

}  // namespace inslab::cli
