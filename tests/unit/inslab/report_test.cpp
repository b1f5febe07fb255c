#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "services/inslab/report_files.hpp"
#include "services/truth_logger/run_log.hpp"
#include "tests/unit/inslab/run_recorder.hpp"
#include "tests/unit/io/temporary_folder.hpp"
#include "wire/topic_names.hpp"

/// The report of a log that is written here: a car's ten seconds with an outage and a swap, and an app that is off by a
/// constant.
namespace inslab::cli {
namespace {

using testing::HasSubstr;

constexpr double kOff_m = 0.3;

scenario::LoadedScenario turning() {
  scenario::LoadedScenario loaded;
  scenario::Scenario& s = loaded.scenario;
  s.name = "turning";
  s.duration_s = 10.0;
  s.trajectory.initial.latitude_deg = 30.0;
  s.trajectory.initial.speed_m_per_s = 10.0;
  scenario::Motion turn;
  turn.type = scenario::MotionType::Turn;
  turn.angle_deg = 90.0;
  s.trajectory.segments.push_back({"turn", 10.0, {turn}, true});
  loaded.truth_samples = 2001;
  s.imu.emplace_back();
  s.gnss.emplace_back().rate_hz = 10.0;
  scenario::LoadedImu imu;
  imu.errors.accel.bias_turn_on_sigma_mgal.setConstant(500.0);
  imu.errors.gyro.bandwidth_hz.setConstant(50.0);
  loaded.imus.push_back(imu);
  scenario::LoadedGnss gnss;
  gnss.rate = time::Rate(10.0);
  gnss.installation.target = gnss.nominal_installation.target = gnss.errors.target = {SensorKind::Gnss, 0};
  gnss.errors.fix_type = FixType::Fixed;
  gnss.errors.position_sigma_ned_m.setConstant(0.05);
  gnss.errors.velocity_sigma_ned_m_per_s.setConstant(0.05);
  gnss.outages.push_back({4.05, 4.0, 0.0});
  loaded.gnss.push_back(gnss);
  ImuErrorProfile worse = imu.errors;
  worse.name = "worse";
  worse.accel.bias_constant_mgal.setConstant(5000.0);
  worse.request.apply_at_ns = 6'000'000'000;
  loaded.swaps.emplace_back(worse);
  return loaded;
}

NavSolution off_by_a_constant(const TruthState& truth) {
  NavSolution solution;
  solution.gps_week = truth.header.gps_week;
  solution.gps_time_of_week_ns = truth.header.gps_time_of_week_ns;
  solution.mode = NavMode::Navigating;
  const nav::Geodetic place =
      nav::displaced({truth.latitude_rad, truth.longitude_rad, truth.height_m}, Vector3(kOff_m, 0.0, 0.0));
  solution.latitude_rad = place.latitude_rad;
  solution.longitude_rad = place.longitude_rad;
  solution.height_m = place.height_m;
  solution.v_n = truth.v_n;
  solution.q_n_body = truth.q_nv;
  solution.attitude_sigma_rad.setConstant(0.001);
  return solution;
}

class Report : public test::TemporaryFolder {
 protected:
  enum class With { Everything, NoImuTruth };

  std::string log(With with) {
    const scenario::LoadedScenario loaded = turning();
    OfflineRun run(loaded, {2400, 0}, RunId{}, recorder_);
    while (run.step()) {
    }
    logger::RunLog log(path("log.mcap"), loaded, "");
    const auto write = [&log](const std::string& topic, const auto& samples) {
      io::LogChannel<typename std::decay_t<decltype(samples)>::value_type> channel(log.file(), topic);
      std::uint32_t number = 0;
      for (const auto& sample : samples) {
        const auto time_ns = static_cast<std::uint64_t>(sample.header.sim_time_ns);
        channel.write(sample, number++, time_ns, time_ns);
      }
    };
    write(wire::topic_names::kTruth, recorder_.truths);
    if (with == With::Everything) write(wire::topic_names::imu_truth(0), recorder_.imu_truths);
    write(wire::topic_names::gnss(0), recorder_.fixes);
    io::LogChannel<ImuErrorProfile> journal(log.file(), wire::topic_names::journal(ProfileKind::ImuError));
    journal.write(std::get<ImuErrorProfile>(recorder_.entries.front()), 0, 0, 0);
    io::LogChannel<NavSolution> nav(log.file(), wire::topic_names::kNav);
    for (std::size_t k = 20; k < recorder_.truths.size(); k += 10) {
      const auto time_ns = static_cast<std::uint64_t>(recorder_.truths[k].header.sim_time_ns);
      nav.write(off_by_a_constant(recorder_.truths[k]), static_cast<std::uint32_t>(k), time_ns, time_ns);
    }
    log.file().close();
    return path("log.mcap");
  }

  test::RunRecorder recorder_;
};

TEST_F(Report, ExpectsWhatThePredictionAlongTheRunExpects) {
  const ReportData data = report_data(io::McapReader(log(With::Everything)));
  predict::ExpectedErrors::Setup setup;
  setup.gnss_number = 0;
  setup.start.time_s = 0.1;
  setup.start.position_n_m = Vector3(kOff_m, 0.0, 0.0);  // the app reports none: its error is
  setup.start.attitude_n_rad.setConstant(0.001);
  const scenario::LoadedScenario loaded = turning();
  predict::ExpectedErrors along(setup, {loaded.imus[0].errors, loaded.gnss[0].errors, recorder_.entries.front()});
  auto fix = recorder_.fixes.begin();
  for (const ImuTruth& truth : recorder_.imu_truths) {
    for (; fix != recorder_.fixes.end() && fix->header.sim_time_ns < truth.header.sim_time_ns; ++fix) along.add(*fix);
    along.add(truth);
  }
  ASSERT_EQ(data.expectation.curve.size(), along.curve().size());
  // The app's error is that of a double of the latitude: 1e-9 m.
  for (std::size_t i = 0; i < along.curve().size(); ++i) {
    EXPECT_DOUBLE_EQ(data.expectation.curve[i].time_s, along.curve()[i].time_s);
    EXPECT_NEAR((data.expectation.curve[i].position_n_m - along.curve()[i].position_n_m).norm(), 0.0, 1e-7);
  }
  EXPECT_THAT(data.expectation.left_out, testing::ElementsAre("bandwidth"));
}

TEST_F(Report, SaysInJsonWhatWasToBeExpectedOfAnOutage) {
  const nlohmann::ordered_json json = report_json(report_data(io::McapReader(log(With::Everything))));
  const auto& expected = json.at("expected");
  EXPECT_EQ(expected.at("of"), "the best filter of the fixes of gnss 0");
  ASSERT_EQ(expected.at("outages").size(), 1u);
  EXPECT_EQ(expected.at("columns").size(), expected.at("sigma").front().size());
  // 5000 mGal for the last 2.1 s: 0.05 t^2 / 2 on two axes at least.
  EXPECT_GT(expected.at("outages")[0].at("horizontal_sigma_m"), 0.15);
  EXPECT_GT(expected.at("measured_over_expected_between_outages").at("position"), 2.0);
  EXPECT_LT(expected.at("measured_over_expected_in_outages").at("position"),
            expected.at("measured_over_expected_between_outages").at("position"));
}

TEST_F(Report, OfALogWithoutTheImusTruthSaysThatNothingIsExpected) {
  const ReportData data = report_data(io::McapReader(log(With::NoImuTruth)));
  EXPECT_TRUE(data.expectation.curve.empty());
  EXPECT_EQ(report_json(data).at("expected").at("missing"), "the log has no inslab/imu_truth/0");
  EXPECT_GT(data.score.scorer.counts().scored, 100u);
}

TEST(ReportPage, ShowsTablesThatStandOutWhereALimitFailsAndNoMarkupOfTheScenario) {
  ReportPage page;
  page.title = "a <b> & c";
  page.verdict = "FAIL: 0 of 1";
  page.accepted = false;
  page.tables = {{"Acceptance", {"result", "limit"}, {{"FAIL", "x < 1"}}, "why", 2}};
  page.figures = {{"Plot", "of it", "<?xml?><svg id=\"a\"><use xlink:href=\"#a\"/></svg>"}};
  const std::string text = html(page);
  EXPECT_THAT(text, HasSubstr("<title>a &lt;b&gt; &amp; c</title>"));
  EXPECT_THAT(text, HasSubstr("<p class=\"verdict failed\">FAIL: 0 of 1</p>"));
  EXPECT_THAT(text, HasSubstr("<td class=\"word bad\">FAIL</td><td class=\"word\">x &lt; 1</td>"));
  EXPECT_THAT(text, HasSubstr("id=\"figure0_a\"><use href=\"#figure0_a\"/>"));
}

}  // namespace
}  // namespace inslab::cli
