#include "inslab/referee/verify/allan_block.hpp"

#include <fmt/format.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <numeric>

#include "inslab/foundation/units/units.hpp"
#include "inslab/referee/verify/still_imu.hpp"

namespace inslab::verify {
namespace {

constexpr double kAllowed = kAllowedStandardErrors;
constexpr double kConfidence = 0.99;
constexpr double kHour_s = 3600.0;

const TriadSetting& triad(const Grade& grade, bool is_gyro) { return is_gyro ? grade.gyro : grade.accel; }

allan::NoiseModel in_si(const TriadSetting& setting, bool is_gyro) {
  allan::NoiseModel model;
  model.white = setting.white * (is_gyro ? units::kDegPerSqrtH : units::kMPerSPerSqrtH);
  model.gm_sigma = setting.gm_sigma * (is_gyro ? units::kDegPerH : units::kMGal);
  model.gm_correlation_time_s = setting.gm_time_s;
  return model;
}

std::vector<allan::Term> terms_of(const TriadSetting& setting) {
  return {setting.gm_sigma > 0.0 ? allan::Term::GaussMarkov : allan::Term::White};
}

/// Fits each record alone.
void fit_singles(const std::vector<allan::Likelihood>& records, const std::vector<allan::Term>& terms,
                 const allan::NoiseModel& expected, TriadResult& result) {
  const std::vector<allan::Parameter> parameters = allan::parameters_of(terms.front());
  result.largest_single_error.assign(parameters.size(), 0.0);
  result.singles_outside.assign(parameters.size(), 0);
  const double limit = 0.5 * allan::chi_square_quantile(kConfidence, 1.0);
  for (const allan::Likelihood& record : records) {
    const auto log = [&record](const allan::NoiseModel& model) { return record.log(model); };
    const allan::Fit fit = allan::fit(record, terms);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const double set = allan::value_of(expected, parameters[i]);
      const double error = std::abs(allan::value_of(fit.model, parameters[i]) / set - 1.0);
      result.largest_single_error[i] = std::max(result.largest_single_error[i], error);
      if (allan::drop_at(log, fit, parameters[i], set) > limit) ++result.singles_outside[i];
    }
  }
}

/// The normal variable that is exceeded as seldom as chi-square of `degrees` exceeds degrees * ratio.
double as_normal(double ratio, double degrees) {
  const boost::math::chi_squared chi(degrees);
  const boost::math::normal normal;
  const double x = ratio * degrees;
  constexpr double kTiny = 1e-300;
  if (ratio < 1.0) return boost::math::quantile(normal, std::max(boost::math::cdf(chi, x), kTiny));
  return -boost::math::quantile(normal, std::max(boost::math::cdf(boost::math::complement(chi, x)), kTiny));
}

/// Compares the mean of the records' Allan variances with the expected curve; degrees of freedom add up.
void compare_curves(const std::vector<std::vector<allan::AllanPoint>>& curves, const allan::NoiseModel& expected,
                    TriadResult& result) {
  const auto count = static_cast<double>(curves.size());
  const double dt_s = 1.0 / result.grade.rate_hz;
  result.curve_points = curves.front().size();
  for (std::size_t i = 0; i < result.curve_points; ++i) {
    const allan::AllanPoint& point = curves.front()[i];
    double mean = 0.0;
    for (const auto& curve : curves) mean += curve[i].variance / count;
    const double ratio = mean / allan::allan_variance(expected, dt_s, point.m);
    const double degrees = count * allan::equivalent_degrees_of_freedom(point, expected, dt_s);
    const double normal = as_normal(ratio, degrees);
    if (i > 0 && std::abs(normal) <= std::abs(result.worst_normal)) continue;
    result.worst_normal = normal;
    result.worst_tau_s = static_cast<double>(point.m) * dt_s;
    result.worst_relative_deviation = std::sqrt(ratio) - 1.0;
  }
}

/// Of `points` independent points the one furthest out may be further than a single one: Bonferroni.
double allowed_normal(std::size_t points) {
  const boost::math::normal normal;
  const double chance = boost::math::cdf(boost::math::complement(normal, kAllowed)) / static_cast<double>(points);
  return -boost::math::quantile(normal, chance);
}

std::string grade_name(const TriadResult& result) {
  const TriadSetting& setting = triad(result.grade, result.is_gyro);
  const char* sensor = result.is_gyro ? "gyro" : "accel";
  if (setting.gm_sigma == 0.0) {
    return fmt::format("{} white {} {}", sensor, setting.white, result.is_gyro ? "deg/sqrt(h)" : "m/s/sqrt(h)");
  }
  return fmt::format("{} bias {} {}, T {} s", sensor, setting.gm_sigma, result.is_gyro ? "deg/h" : "mGal",
                     setting.gm_time_s);
}

std::string run_length(double duration_s) {
  return duration_s < kHour_s ? fmt::format("{:.0f} min", duration_s / 60.0)
                              : fmt::format("{:.0f} h", duration_s / kHour_s);
}

const char* parameter_name(allan::Parameter parameter) {
  if (parameter == allan::Parameter::White) return "density";
  return parameter == allan::Parameter::GmSigma ? "sigma" : "T";
}

std::string percent(double part) { return fmt::format("{:+.2f}", 100.0 * part); }

Table parameter_table(const std::vector<TriadResult>& results) {
  Table table;
  table.title = "Parameters fitted to the output of an IMU at rest, all records of a row together";
  table.columns = {"set",    "run",     "records",          "fitted",       "off %",          "allowed %",
                   "spread", "allowed", "largest single %", "outside 99 %", "thesis off by %"};
  for (const TriadResult& result : results) {
    const TriadSetting& setting = triad(result.grade, result.is_gyro);
    const allan::NoiseModel set = in_si(setting, result.is_gyro);
    const std::vector<double> of_a_record = standard_errors_of_a_record(result.grade, result.is_gyro);
    for (std::size_t i = 0; i < result.pooled.size(); ++i) {
      const allan::PooledEstimate& estimate = result.pooled[i];
      // The logarithm, in which the standard error of a scale is the same to both sides.
      const double off = std::log(estimate.value / allan::value_of(set, estimate.parameter));
      const double standard_error = of_a_record[i] / std::sqrt(static_cast<double>(result.records));
      const double allowed = kAllowed * standard_error;
      const double spread = estimate.relative_standard_error / standard_error;
      const allan::Interval allowed_spreads = allowed_spread(result.records);
      table.rows.push_back(
          {{grade_name(result), run_length(result.grade.duration_s), std::to_string(result.records),
            parameter_name(estimate.parameter), percent(off), fmt::format("{:.2f}", 100.0 * allowed),
            fmt::format("{:.2f}", spread), fmt::format("{:.2f} to {:.2f}", allowed_spreads.low, allowed_spreads.high),
            fmt::format("{:.1f}", 100.0 * result.largest_single_error[i]), std::to_string(result.singles_outside[i]),
            setting.seeds_error},
           std::abs(off) <= allowed && allowed_spreads.contains(spread)});
    }
  }
  table.notes = {
      "off: logarithm of fitted over set. allowed: 3.5 standard errors of so many records of that length, by the "
      "information in their periodograms. spread: standard error by the records' own spread over that; its limits are "
      "those of chi-square, as seldom exceeded to either side.",
      "The thesis read the deviation at tau = 1 s, and for a bias the minimum or the peak, off one curve an axis; "
      "\"largest single\" is ours for one axis."};
  return table;
}

Table curve_table(const std::vector<TriadResult>& results) {
  Table table;
  table.title = "Overlapped Allan deviation against the curve of the values set, tau an octave apart";
  table.columns = {"set", "points", "tau to s", "furthest at tau s", "off %", "normal variable", "allowed"};
  for (const TriadResult& result : results) {
    const double allowed = allowed_normal(result.curve_points);
    table.rows.push_back(
        {{grade_name(result), std::to_string(result.curve_points),
          fmt::format("{:.0f}", std::exp2(static_cast<double>(result.curve_points) - 1.0) / result.grade.rate_hz),
          fmt::format("{:g}", result.worst_tau_s), percent(result.worst_relative_deviation),
          fmt::format("{:+.2f}", result.worst_normal), fmt::format("{:.2f}", allowed)},
         std::abs(result.worst_normal) <= allowed});
  }
  table.notes = {
      "The curve of a bias is that of one held over each sample. The band is that of chi-square with the exact degrees "
      "of freedom of the records; allowed: 3.5 for one point, and for the furthest of several as seldom (Bonferroni)."};
  return table;
}

Table single_table(const std::vector<TriadResult>& results) {
  int intervals = 0;
  int outside = 0;
  for (const TriadResult& result : results) {
    intervals += static_cast<int>(result.records * result.pooled.size());
    outside += std::accumulate(result.singles_outside.begin(), result.singles_outside.end(), 0);
  }
  Table table;
  table.title = "Single fits: 99 % intervals that do not hold the value set";
  table.columns = {"intervals", "outside", "allowed"};
  const int allowed = allowed_outside(intervals);
  table.rows.push_back(
      {{std::to_string(intervals), std::to_string(outside), std::to_string(allowed)}, outside <= allowed});
  table.notes = {"Intervals of the restricted likelihood ratio. Allowed: 1 % and 3.5 standard deviations, 24 of 1200."};
  return table;
}

}  // namespace

std::vector<Grade> thesis_grades(double rate_of_biases_hz) {
  const auto white = [](double arw, double vrw) {
    return Grade{1200.0, 200.0, {arw, 0.0, 0.0, "to 2.5"}, {vrw, 0.0, 0.0, "to 2.7"}};
  };
  const auto bias = [rate_of_biases_hz](double hours, double time_s, double gyro, const char* gyro_error, double accel,
                                        const char* accel_error) {
    return Grade{
        hours * kHour_s, rate_of_biases_hz, {0.0, gyro, time_s, gyro_error}, {0.0, accel, time_s, accel_error}};
  };
  return {white(0.002, 0.0008),
          white(0.1, 0.03),
          white(3.0, 0.12),
          bias(45.0, 14400.0, 0.01, "19 to 39", 10.0, "15 to 46"),
          bias(30.0, 3600.0, 0.75, "9 to 29", 1000.0, "13 to 41"),
          bias(20.0, 100.0, 36.0, "3 to 10", 1000.0, "5 to 12"),
          bias(20.0, 10.0, 36.0, "8", 1000.0, "5 to 7")};
}

ImuErrorProfile profile_of(const Grade& grade) {
  ImuErrorProfile profile;
  profile.gyro.arw_deg_per_sqrt_h.setConstant(grade.gyro.white);
  profile.gyro.bias_gm_sigma_deg_per_h.setConstant(grade.gyro.gm_sigma);
  profile.gyro.bias_gm_correlation_time_s.setConstant(grade.gyro.gm_time_s);
  profile.accel.vrw_m_per_s_per_sqrt_h.setConstant(grade.accel.white);
  profile.accel.bias_gm_sigma_mgal.setConstant(grade.accel.gm_sigma);
  profile.accel.bias_gm_correlation_time_s.setConstant(grade.accel.gm_time_s);
  return profile;
}

std::vector<TriadResult> verify_grade(const Grade& grade, const std::vector<std::uint64_t>& seeds,
                                      const std::function<void(const std::string&)>& progress,
                                      const Subjects& subjects) {
  std::vector<allan::Likelihood> records[2];
  std::vector<std::vector<allan::AllanPoint>> curves[2];
  const ImuErrorProfile profile = profile_of(grade);
  for (const std::uint64_t seed : seeds) {
    progress(fmt::format("{} at rest, seed {}", run_length(grade.duration_s), seed));
    const auto axes = record_still_imu(profile, grade.rate_hz, grade.duration_s, seed, subjects.simulation);
    for (std::size_t axis = 0; axis < axes.size(); ++axis) {
      records[axis / 3].emplace_back(axes[axis].record);
      curves[axis / 3].push_back(axes[axis].curve);
    }
  }
  progress("fitting");
  std::vector<TriadResult> results;
  for (const bool is_gyro : {true, false}) {
    const std::size_t which = is_gyro ? 0 : 1;
    const allan::NoiseModel set = in_si(triad(grade, is_gyro), is_gyro);
    const std::vector<allan::Term> terms = terms_of(triad(grade, is_gyro));
    TriadResult result;
    result.is_gyro = is_gyro;
    result.grade = grade;
    result.records = records[which].size();
    result.pooled = allan::pooled_fit(records[which], terms);
    fit_singles(records[which], terms, set, result);
    compare_curves(curves[which], set, result);
    results.push_back(result);
  }
  return results;
}

std::vector<double> standard_errors_of_a_record(const Grade& grade, bool is_gyro) {
  const TriadSetting& setting = triad(grade, is_gyro);
  const double ordinates = 0.5 * grade.duration_s * grade.rate_hz;
  if (setting.gm_sigma == 0.0) return {1.0 / std::sqrt(4.0 * ordinates)};
  // ln S = 2 ln sigma + ln T - ln(1 + u^2), u = 2 pi f T: its slopes are 2 and w - 1 with w = 2/(1 + u^2).
  double sum = 0.0, squares = 0.0;
  constexpr double kNegligible = 1e4;
  const double step = 2.0 * units::kPi * setting.gm_time_s / grade.duration_s;
  for (double k = 1.0; k <= ordinates && k * step < kNegligible; k += 1.0) {
    const double w = 2.0 / (1.0 + k * step * k * step);
    sum += w;
    squares += w * w;
  }
  const double mean = sum / ordinates - 1.0, scatter = squares - sum * sum / ordinates;
  return {std::sqrt(0.25 / ordinates + 0.25 * mean * mean / scatter), std::sqrt(1.0 / scatter)};
}

allan::Interval allowed_spread(std::size_t records) {
  const boost::math::normal normal;
  const double chance = boost::math::cdf(boost::math::complement(normal, kAllowed));
  const double degrees = static_cast<double>(records) - 1.0;
  return {std::sqrt(allan::chi_square_quantile(chance, degrees) / degrees),
          std::sqrt(allan::chi_square_quantile(1.0 - chance, degrees) / degrees)};
}

int allowed_outside(int intervals) {
  const double miss = 1.0 - kConfidence;
  const auto n = static_cast<double>(intervals);
  return static_cast<int>(n * miss + kAllowed * std::sqrt(n * miss * kConfidence));
}

std::vector<Table> tables_of(const std::vector<TriadResult>& results) {
  return {parameter_table(results), curve_table(results), single_table(results)};
}

std::vector<Table> allan_tables(bool full, const std::function<void(const std::string&)>& progress) {
  constexpr std::uint64_t kSeeds = 20, kSeedsOfLongRuns = 8;
  std::vector<TriadResult> results;
  std::uint64_t next_seed = 1;
  for (const Grade& grade : full ? thesis_grades() : thesis_grades(10.0)) {
    // Of their own: the same draws, scaled, would be one experiment shown three times.
    std::vector<std::uint64_t> seeds(grade.duration_s > kHour_s && !full ? kSeedsOfLongRuns : kSeeds);
    std::iota(seeds.begin(), seeds.end(), next_seed);
    next_seed += kSeeds;
    for (const TriadResult& result : verify_grade(grade, seeds, progress)) results.push_back(result);
  }
  return tables_of(results);
}

}  // namespace inslab::verify
