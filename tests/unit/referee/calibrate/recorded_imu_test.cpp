#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "inslab/data/catalog/profile_rules.hpp"
#include "inslab/data/json/json_reader.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/referee/calibrate/fitted_profile.hpp"
#include "inslab/referee/calibrate/profile_file.hpp"
#include "inslab/referee/calibrate/report.hpp"
#include "inslab/sim/log_sink.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

/// "Record a sensor, get its twin": a profile makes a log, the log a fit, the fit a profile.
namespace inslab::calibrate {
namespace recorded_imu_test {

constexpr double kRate_hz = 50.0;
constexpr double kDuration_s = 1200.0;

ImuErrorProfile sensor() {
  ImuErrorProfile profile;
  profile.name = "sensor";
  profile.gyro.arw_deg_per_sqrt_h = {0.1, 0.2, 0.3};
  profile.gyro.bias_gm_sigma_deg_per_h.setConstant(40.0);
  profile.gyro.bias_gm_correlation_time_s.setConstant(15.0);
  profile.accel.vrw_m_per_s_per_sqrt_h = {0.05, 0.1, 0.2};
  return profile;
}

/// A car that turns, so that only the errors stay still.
scenario::LoadedScenario turning() {
  scenario::LoadedScenario loaded;
  loaded.scenario.name = "turning";
  loaded.scenario.seed = 11;
  loaded.scenario.duration_s = kDuration_s;
  loaded.scenario.truth_rate_hz = kRate_hz;
  loaded.scenario.trajectory.initial.latitude_deg = 30.0;
  loaded.scenario.trajectory.initial.speed_m_per_s = 10.0;
  scenario::Motion turn;
  turn.type = scenario::MotionType::ConstantRate;
  turn.rate_deg_per_s = 3.0;
  scenario::Segment circle;
  circle.duration_s = kDuration_s;
  circle.motions.push_back(turn);
  loaded.scenario.trajectory.segments.push_back(circle);
  loaded.truth_rate = time::Rate(kRate_hz);
  loaded.truth_samples = static_cast<std::uint64_t>(kDuration_s * kRate_hz) + 1;
  scenario::LoadedImu imu;
  imu.rate = loaded.truth_rate;
  imu.errors = sensor();
  loaded.imus.push_back(imu);
  return loaded;
}

class RecordedImu : public test::TemporaryFolder {
 protected:
  void SetUp() override {
    test::TemporaryFolder::SetUp();
    const scenario::LoadedScenario loaded = turning();
    sim::LogSink log(path("car.mcap"), loaded, {2400, 0});
    sim::OfflineRun run(loaded, {2400, 0}, RunId{}, log);
    while (run.step()) {
    }
    log.close();
  }

  /// Without terms, those that the record speaks for are looked for.
  ImuAnalysis errors(const std::vector<allan::Term>& terms = {}) {
    AnalysisOptions options;
    options.recording.minus_truth = true;
    options.terms = terms;
    return analyse_imu(path("car.mcap"), options);
  }
};

/// What the sensor was made with, in SI.
double set_value(const AxisAnalysis& axis, allan::Parameter parameter) {
  const auto place = static_cast<Eigen::Index>(axis.axis % 3);
  const ImuErrorProfile profile = sensor();
  const double unit = profile_unit(parameter, axis.is_gyro()).si;
  if (parameter == allan::Parameter::White) {
    return unit * (axis.is_gyro() ? profile.gyro.arw_deg_per_sqrt_h : profile.accel.vrw_m_per_s_per_sqrt_h)[place];
  }
  return unit * (parameter == allan::Parameter::GmSigma ? profile.gyro.bias_gm_sigma_deg_per_h
                                                        : profile.gyro.bias_gm_correlation_time_s)[place];
}

TEST_F(RecordedImu, GivesBackTheProfileThatMadeItWithinItsConfidence) {
  using allan::Term;
  const ImuAnalysis analysis = errors();
  ASSERT_EQ(analysis.axes.size(), 6u);
  for (const AxisAnalysis& axis : analysis.axes) {
    const std::vector<Term> made_of =
        axis.is_gyro() ? std::vector<Term>{Term::White, Term::GaussMarkov} : std::vector<Term>{Term::White};
    EXPECT_THAT(axis.fit.terms, ::testing::UnorderedElementsAreArray(made_of)) << axis.axis;
    for (const FittedParameter& fitted : axis.parameters) {
      const double set = set_value(axis, fitted.parameter);
      EXPECT_TRUE(fitted.interval.contains(set)) << recordings::kImuAxisNames[axis.axis] << ": " << set << " is not in "
                                                 << fitted.interval.low << " to " << fitted.interval.high;
    }
  }
}

TEST_F(RecordedImu, ItsProfileIsAFileThatOurReaderTakes) {
  const ImuErrorProfile profile = fitted_profile(errors({allan::Term::White, allan::Term::GaussMarkov}));
  write_profile(path("twin.json"), profile);
  const auto again =
      json::struct_from_json<ImuErrorProfile>(json::read_json_file(path("twin.json")), path("twin.json"));
  EXPECT_EQ(catalog::violation(again), std::nullopt);
  EXPECT_EQ(again.gyro.arw_deg_per_sqrt_h, profile.gyro.arw_deg_per_sqrt_h);
  EXPECT_EQ(again.gyro.bias_gm_correlation_time_s, profile.gyro.bias_gm_correlation_time_s);
  EXPECT_EQ(again.accel.vrw_m_per_s_per_sqrt_h, profile.accel.vrw_m_per_s_per_sqrt_h);
  EXPECT_THAT(again.source, ::testing::HasSubstr("60000 samples at 50 Hz of car.mcap"));
}

TEST_F(RecordedImu, ReportAndPlotShowEveryAxis) {
  const ImuAnalysis analysis = errors({allan::Term::White});
  const std::string text = report_text(analysis);
  for (const char* name : recordings::kImuAxisNames) EXPECT_THAT(text, ::testing::HasSubstr(name));
  EXPECT_THAT(text, ::testing::HasSubstr("white noise (angle random walk)"));
  EXPECT_THAT(curve_csv(analysis), ::testing::HasSubstr("\naccel z,0.02"));
  const std::string svg = tables::drawn(curve_picture(analysis), tables::PictureFormat::Svg);
  for (const char* name : recordings::kImuAxisNames) EXPECT_THAT(svg, ::testing::HasSubstr(name));
}

TEST_F(RecordedImu, TheCurveIsFullyOverlappedAndEndsAtAQuarterOfTheRecord) {
  const ImuAnalysis analysis = errors({allan::Term::White});
  std::vector<double> phase{0.0};
  recordings::ImuRecordingOptions options;
  options.minus_truth = true;
  recordings::read_imu_recording(
      path("car.mcap"), options, [](const recordings::ImuRecordingInfo&) {},
      [&](const recordings::ImuIncrements& increments) { phase.push_back(phase.back() + increments[4]); });
  const std::vector<CurvePoint>& curve = analysis.axes[4].curve;
  const auto samples = static_cast<std::int64_t>(phase.size()) - 1;
  ASSERT_FALSE(curve.empty());
  EXPECT_NEAR(curve.back().tau_s, static_cast<double>(samples / 4) / kRate_hz, 1e-9);
  for (const CurvePoint& point : curve) {
    const std::int64_t m = std::llround(point.tau_s * kRate_hz);
    const double every = std::sqrt(allan::overlapped_allan_variance(phase, 1.0 / kRate_hz, m).variance);
    EXPECT_NEAR(point.deviation, every, 1e-9 * every) << m;
    EXPECT_LT(point.interval.low, point.deviation);
    EXPECT_GT(point.interval.high, point.deviation);
  }
}

TEST_F(RecordedImu, APoorFitIsNamedInTheReportAndInTheTwin) {
  const ImuAnalysis poor = errors({allan::Term::White});  // the gyros have a Gauss-Markov bias, too
  EXPECT_THAT(report_text(poor), ::testing::HasSubstr("the fit is poor: at tau "));
  EXPECT_THAT(poor_fits(poor), ::testing::StartsWith("gyro x: the fit is poor"));
  EXPECT_THAT(fitted_profile(poor).source, ::testing::HasSubstr("; poor: gyro x"));
  const ImuAnalysis good = errors();
  EXPECT_EQ(poor_fits(good), "");
  EXPECT_THAT(report_text(good), ::testing::HasSubstr("the fit explains the curve"));
}

TEST_F(RecordedImu, WithoutItsTruthTheMeanIsNoBias) {
  AnalysisOptions options;
  options.terms = {allan::Term::White};
  const ImuAnalysis analysis = analyse_imu(path("car.mcap"), options);
  EXPECT_NEAR(analysis.axes[2].mean / units::kDegPerS, 3.0, 0.1);
  EXPECT_TRUE(fitted_profile(analysis).gyro.bias_constant_deg_per_h.isZero(0.0));
}

TEST_F(RecordedImu, AnImuThatTheLogLacksIsRefusedWithWhatItHas) {
  AnalysisOptions options;
  options.recording.sensor_number = 5;
  try {
    analyse_imu(path("car.mcap"), options);
    FAIL();
  } catch (const files::ReadError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("has no topic inslab/imu/5"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("inslab/imu/0"));
  }
}

}  // namespace recorded_imu_test
}  // namespace inslab::calibrate
