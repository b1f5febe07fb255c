#pragma once

#include <cstdint>
#include <string>

#include "inslab/referee/navigate/offline_filter.hpp"
#include "inslab/referee/score/score_log.hpp"

namespace inslab::navigate {

/// What the filter is to be run on: a log, or the texts of an IMU and of a receiver.
struct NavigateOptions {
  std::string log;
  std::string imu_file;
  std::string gnss_file;
  std::string parameters;
  std::string scenario;
  std::string output;
  std::uint32_t imu_number = 0;
  std::uint32_t gnss_number = 0;
  std::uint32_t gps_week = 0;
  bool start_at_truth = false;
};

/// What came of it. Files are written when there was a solution.
struct Navigated {
  std::uint64_t solutions = 0;
  std::string why_none;  ///< when there were none
  std::string text;      ///< what was done with the samples and fixes, for people
  std::string score;     ///< of a log with its truth, for people
};

/// Runs the filter and writes OUTPUT.nav and OUTPUT_sigmas.txt. Throws files::ReadError, json::Error,
/// files::WriteError.
Navigated navigate_log(const NavigateOptions& options);
Navigated navigate_files(const NavigateOptions& options);

}  // namespace inslab::navigate
