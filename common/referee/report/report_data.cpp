#include "inslab/referee/report/report_data.hpp"

#include <stdexcept>
#include <utility>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/formats/recordings/imu_errors.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/referee/score/score_words.hpp"

namespace inslab::report {

namespace {

/// What a run was, with the fixes of its receiver when they are wanted.
struct WhatRan {
  evidence::LogSummary summary;
  std::vector<GnssFix> fixes;
};

WhatRan what_ran(const mcap::McapReader& log, bool with_fixes) {
  WhatRan ran;
  evidence::SummaryOfLog summary(log);
  log::LogWalk walk(log);
  summary.take_part(walk);
  const std::optional<std::uint32_t> receiver = receiver_of_app(summary.scenario());
  if (with_fixes && receiver) {
    const std::string wanted = catalog::stream_topic<GnssFix>(*receiver);
    walk.each<GnssFix>([&ran, wanted](const GnssFix& fix, const log::LogWalk::Place& place) {
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
  ImuErrorsOfLog(const mcap::McapReader& log, std::uint32_t number)
      : path_(log.path()), number_(number), options_(options_for(number)), analyser_(options_) {
    unless_refused([&] {
      errors_.emplace(
          log, options_.recording, [this](const recordings::ImuRecordingInfo& info) { analyser_.begin(info); },
          [this](const recordings::ImuIncrements& increments) { analyser_.add(increments); });
    });
  }

  void take_part(log::LogWalk& walk) {
    take_topic<ImuSample>(walk, catalog::stream_topic<ImuSample>(number_));
    take_topic<ImuTruth>(walk, catalog::stream_topic<ImuTruth>(number_));
  }

  void finish(ReportData& data) {
    unless_refused([&] { data.imu_errors = analyser_.finish(path_, errors_->finish()); });
    data.why_no_imu_errors = why_not_;
  }

 private:
  static calibrate::AnalysisOptions options_for(std::uint32_t number) {
    calibrate::AnalysisOptions options;
    options.recording.sensor_number = number;
    options.recording.minus_truth = options.recording.over_gaps = true;
    return options;
  }
  template <class Sample>
  void take_topic(log::LogWalk& walk, const std::string& topic) {
    walk.each<Sample>([this, topic](const Sample& sample, const log::LogWalk::Place& place) {
      if (place.topic == topic) unless_refused([&] { errors_->add(sample); });
    });
  }
  template <class Work>
  void unless_refused(const Work& work) {
    if (!why_not_.empty()) return;
    try {
      work();
    } catch (const files::ReadError& error) {
      why_not_ = error.what();
    } catch (const std::invalid_argument& error) {  // errors without noise, to which no model can be fitted
      why_not_ = path_ + ": " + error.what();
    }
  }

  std::string path_;
  std::uint32_t number_;
  calibrate::AnalysisOptions options_;
  calibrate::ImuAnalyser analyser_;
  std::optional<recordings::ImuErrors> errors_;
  std::string why_not_;
};

/// What the checks and the acceptance come to together; both are in the last line when they are as good.
host::Outcome with_acceptance(const host::Outcome& checks, const std::string& verdict, bool accepted) {
  if (checks.code == host::kOk && accepted) return {host::kOk, checks.reason + "; " + verdict};
  return worse(checks, {accepted ? host::kOk : host::kNotAccepted, verdict});
}

}  // namespace

ReportData report_data(const mcap::McapReader& log, ReportDepth depth) {
  const bool with_figures = depth != ReportDepth::Verdict;
  const WhatRan ran = what_ran(log, with_figures);
  log::LogWalk walk(log);
  evidence::SwapWeigher swaps(ran.summary);
  swaps.take_part(walk);
  ErrorCurves curves;
  ExpectationOfLog expectation(log, ran.summary, ran.fixes);
  score::LogScorer::OnScored on_scored;
  if (with_figures) {
    on_scored = [&](const score::ScoredSolution& scored) {
      expectation.add(scored);
      curves.add(scored);
    };
  }
  score::LogScorer scorer(ran.summary, on_scored);
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
  const evidence::RunSummary summary = evidence::run_summary(data.summary, data.swaps, failure);
  Judgement judgement{summary.text, summary.outcome};
  const score::LogScore& score = data.score;
  if (score.scorer.counts().received > 0 || !score.verdicts.empty()) judgement.text += score::score_words(score);
  if (!score.verdicts.empty()) {
    judgement.outcome = with_acceptance(summary.outcome, score::verdict_words(score), score.accepted());
  }
  return judgement;
}

}  // namespace inslab::report
