#pragma once

#include <optional>
#include <string>
#include <vector>

#include "inslab/referee/calibrate/analysis.hpp"
#include "inslab/referee/evidence/run_summary.hpp"
#include "inslab/referee/report/report_pictures.hpp"

namespace inslab::report {

/// How much of a log is wanted; each step holds the ones before.
enum class ReportDepth {
  Verdict,  ///< what the run comes to: summary, swaps and score
  Figures,  ///< and the errors over time with what was to be expected of them
  Page,     ///< and the Allan deviation of the first IMU
};

/// Every figure of a report, each found once; text, JSON, tables and pictures print them.
struct ReportData {
  evidence::LogSummary summary;
  std::vector<evidence::SwapEvidence> swaps;
  score::LogScore score;
  ErrorCurves curves;
  Expectation expectation;
  ErrorRatios between_outages;  ///< measured over expected
  ErrorRatios in_outages;
  std::optional<calibrate::ImuAnalysis> imu_errors;  ///< of the first IMU, its samples less their truth
  std::string why_no_imu_errors;                     ///< empty: the scenario has no IMU, or they were not wanted
};

/// Reads a log twice: what ran, then how well. Throws files::ReadError, json::Error.
ReportData report_data(const mcap::McapReader& log, ReportDepth depth = ReportDepth::Page);

/// What a log comes to as the end of a run: the checks, the score, the acceptance; all of it in the outcome's words.
struct Judgement {
  std::string text;
  host::Outcome outcome;
};

/// `failure` is what the one who ran it saw go wrong, if anything.
Judgement judgement_of(const ReportData& data, const std::optional<std::string>& failure);

}  // namespace inslab::report
