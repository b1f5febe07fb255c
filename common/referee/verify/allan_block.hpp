#pragma once

#include <functional>
#include <string>
#include <vector>

#include "inslab/data/profiles/imu_error_profile.hpp"
#include "inslab/noise/allan/confidence.hpp"
#include "inslab/noise/allan/pooled_fit.hpp"
#include "inslab/referee/verify/subjects.hpp"
#include "inslab/referee/verify/table.hpp"

/// Block 4: the random errors of the IMU model, read off the output of an IMU at rest, against the values set.
namespace inslab::verify {

/// The random errors of one triad: white noise alone (tables 4-4, 4-5 of the thesis), or a Gauss-Markov bias alone
/// (tables 4-6, 4-7). In the units that the thesis gives.
struct TriadSetting {
  double white = 0.0;     ///< deg/sqrt(h) | m/s/sqrt(h)
  double gm_sigma = 0.0;  ///< deg/h | mGal
  double gm_time_s = 0.0;
  std::string seeds_error;  ///< what the thesis errs by, as it says, %
};

/// One run of the thesis: gyros and accelerometers at once, since they share no random number.
struct Grade {
  double duration_s = 0.0;
  double rate_hz = 200.0;
  TriadSetting gyro;
  TriadSetting accel;
};

/// The seven grades of tables 4-4 to 4-7; those of a bias at `rate_of_biases_hz`, which their estimates do not depend
/// on.
std::vector<Grade> thesis_grades(double rate_of_biases_hz = 200.0);

ImuErrorProfile profile_of(const Grade& grade);

/// What became of one triad of one grade over all its records (three axes a seed).
struct TriadResult {
  bool is_gyro = true;
  Grade grade;
  std::size_t records = 0;
  std::vector<allan::PooledEstimate> pooled;  ///< SI
  std::vector<double> largest_single_error;   ///< relative, by parameter
  std::vector<int> singles_outside;           ///< by parameter: 99 % intervals that do not hold the value set

  /// The pooled Allan curve against that of the values set: the point that is furthest out, by the normal variable
  /// that would be as unlikely.
  std::size_t curve_points = 0;
  double worst_tau_s = 0.0;
  double worst_relative_deviation = 0.0;  ///< of the deviation, not the variance
  double worst_normal = 0.0;
};

/// Runs `grade` with each seed and fits every axis alone and each triad's records together. `progress` hears what is
/// being done.
std::vector<TriadResult> verify_grade(const Grade& grade, const std::vector<std::uint64_t>& seeds,
                                      const std::function<void(const std::string&)>& progress,
                                      const Subjects& subjects = {});

/// Standard errors that a pooled estimate may be off.
inline constexpr double kAllowedStandardErrors = 3.5;

/// The standard errors that a record of a grade's length allows an estimate of the logarithms, by parameter: those of
/// the information in its periodogram (Whittle), whose ordinate at frequency 0 is left to the unknown bias. Of what is
/// set and the record's length alone, so that no fault in what is measured can widen them.
std::vector<double> standard_errors_of_a_record(const Grade& grade, bool is_gyro);

/// What the records' own spread may be over the estimator's standard error: the mean of their squares is chi-square of
/// as many degrees as records less one, if they are what they are taken for.
allan::Interval allowed_spread(std::size_t records);

/// Intervals of 99 % that may miss among so many: their mean and 3.5 standard deviations; 24 of 1200.
int allowed_outside(int intervals);

/// The tables: pooled parameters, Allan curves, single fits.
std::vector<Table> tables_of(const std::vector<TriadResult>& results);

/// The whole block, no two grades with a seed in common. `full`: 20 seeds and 200 Hz; otherwise 8 seeds and 10 Hz for
/// the long runs.
std::vector<Table> allan_tables(bool full, const std::function<void(const std::string&)>& progress);

}  // namespace inslab::verify
