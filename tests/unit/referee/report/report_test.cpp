#include <gmock/gmock.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/referee/report/report_files.hpp"
#include "inslab/referee/report/report_limits.hpp"
#include "inslab/referee/score/score_words.hpp"
#include "inslab/referee/score/swap_intervals.hpp"
#include "inslab/sim/run_log.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"
#include "tests/unit/sim/run_recorder.hpp"

/// The report of a log that is written here: a car's ten seconds with an outage and a swap, and an app that is off by a
/// constant.
namespace inslab::report {
namespace report_test {

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
  const nav::Geodetic place = nav::displaced(geodetic_of(truth), Vector3(kOff_m, 0.0, 0.0));
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
  enum class With { Everything, NoImuTruth, ImuSamplesToo, ImuSamplesWithoutNoise };

  std::string log(With with) {
    scenario::LoadedScenario loaded = turning();
    if (with == With::ImuSamplesToo) {
      loaded.imus[0].errors.gyro.arw_deg_per_sqrt_h.setConstant(0.1);
      loaded.imus[0].errors.accel.vrw_m_per_s_per_sqrt_h.setConstant(0.1);
    }
    sim::OfflineRun run(loaded, {2400, 0}, RunId{}, recorder_);
    while (run.step()) {
    }
    sim::RunLog log(path("log.mcap"), loaded, "");
    const auto write = [&log](const std::string& topic, const auto& samples) {
      log::LogChannel<typename std::decay_t<decltype(samples)>::value_type> channel(log.file(), topic);
      std::uint32_t number = 0;
      for (const auto& sample : samples) {
        const auto time_ns = static_cast<std::uint64_t>(sample.header.sim_time_ns);
        channel.write(sample, number++, time_ns, time_ns);
      }
    };
    write(catalog::kTruth.name, recorder_.truths);
    if (with != With::NoImuTruth) write(catalog::stream_topic<ImuTruth>(0), recorder_.imu_truths);
    if (with >= With::ImuSamplesToo) write(catalog::stream_topic<ImuSample>(0), recorder_.samples);
    write(catalog::stream_topic<GnssFix>(0), recorder_.fixes);
    log::LogChannel<ImuErrorProfile> journal(log.file(), catalog::journal_topic(ProfileKind::ImuError));
    journal.write(std::get<ImuErrorProfile>(recorder_.entries.front()), 0, 0, 0);
    log::LogChannel<NavSolution> nav(log.file(), catalog::kNav.name);
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
  const ReportData data = report_data(mcap::McapReader(log(With::Everything)));
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
  const nlohmann::ordered_json json = report_json(report_data(mcap::McapReader(log(With::Everything))));
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
  const ReportData data = report_data(mcap::McapReader(log(With::NoImuTruth)));
  EXPECT_TRUE(data.expectation.curve.empty());
  EXPECT_EQ(report_json(data).at("expected").at("missing"), "the log has no inslab/imu_truth/0");
  EXPECT_GT(data.score.scorer.counts().scored, 100u);
}

scenario::AcceptanceLimit at_most(scenario::Metric metric, double value, scenario::Phase phase) {
  scenario::AcceptanceLimit limit;
  limit.metric = metric;
  limit.phase = phase;
  limit.at_most = value;
  return limit;
}

/// The error is a constant, but for one solution at 7 s, in the outage and after the swap.
ReportData with_a_leap(ReportData data, const TruthState& truth) {
  NavSolution solution = off_by_a_constant(truth);
  const score::TruePose pose{geodetic_of(truth), truth.v_n, truth.q_nv};
  score::SolutionError error;
  error.position_ned_m = Vector3(3.0, 4.0, -1.0);
  solution.position_sigma_ned_m = Vector3(0.6, 0.8, 1.0);
  data.score.worst.add({truth.header.sim_time_ns, true, solution, pose, error});
  return data;
}

TEST_F(Report, NamesTheWorstMomentWithTheOutageTheMotionAndTheSwapBeforeIt) {
  const std::string path = log(With::Everything);
  const ReportData data = with_a_leap(report_data(mcap::McapReader(path)), recorder_.truths[1400]);
  const std::string words = score::worst_words(data.score);
  EXPECT_THAT(words, HasSubstr("5 m horizontally and 1 m vertically at 7.000 s"));
  EXPECT_THAT(words, HasSubstr("3.00 s after the last fix (outage from 4.00 s to 8.10 s)"));
  EXPECT_THAT(words, HasSubstr("at 10.0 m/s"));
  EXPECT_THAT(words, HasSubstr("1 sigma was 1 m, so the error was 5 times as large"));
  EXPECT_THAT(words, HasSubstr("imu_error 'worse' for imu0 at 6.000 s"));
  EXPECT_EQ(report_json(data).at("worst").at("swap_interval"), 1);
  EXPECT_THAT(html(report_page(data)), HasSubstr("<strong>Worst moment:</strong> 5 m horiz"));
}

TEST_F(Report, SaysBesideItsPassWhatWasNotJudged) {
  ReportData data = report_data(mcap::McapReader(log(With::Everything)));
  const auto judged = [&data](const std::vector<scenario::AcceptanceLimit>& lines) {
    data.score.verdicts = score::judge(data.score.scorer, lines);
    return score::verdict_words(data.score);
  };
  using scenario::Metric;
  using scenario::Phase;
  EXPECT_EQ(judged({}), "");
  EXPECT_EQ(judged({at_most(Metric::HorizontalRms, 1.0, Phase::SwapInterval)}),
            "PASS: 1 of 1 acceptance lines passed; errors are judged only before the first swap, at 6.000 s");
  EXPECT_EQ(judged({at_most(Metric::HorizontalRms, 1.0, Phase::BetweenOutages)}),
            "PASS: 1 of 1 acceptance lines passed; errors in outages are not judged");
  EXPECT_EQ(judged({at_most(Metric::Stale, 0.0, Phase::All)}),
            "PASS: 1 of 1 acceptance lines passed; no error is judged");
  EXPECT_EQ(judged({at_most(Metric::HorizontalRms, 0.1, Phase::All)}), "FAIL: 0 of 1 acceptance lines passed");
  EXPECT_EQ(judged({at_most(Metric::HorizontalRms, 1.0, Phase::SwapInterval),
                    at_most(Metric::OutageDriftMax, 1.0, Phase::All)}),
            "PASS: 2 of 2 acceptance lines passed");
}

TEST_F(Report, NamesIntervalsByWhatWasSwapped) {
  const ReportData data = report_data(mcap::McapReader(log(With::Everything)));
  const score::SwapIntervals intervals(data.summary);
  EXPECT_EQ(intervals.count(), 1u);
  EXPECT_EQ(intervals.at(6.0), 0u) << "an entry counts for what is later than its apply time";
  EXPECT_EQ(intervals.at(6.005), 1u);
  EXPECT_EQ(intervals.name(0), "before the first swap");
  EXPECT_EQ(intervals.name(2), "swap 2, which never came");
  EXPECT_THAT(report_text(data), HasSubstr("swap_interval 1: after imu_error 'worse' for imu0 at 6.000 s\n"));
}

TEST_F(Report, DrawsALimitWhereItJudgesAndLinksItsLine) {
  const std::string path = log(With::Everything);
  ReportData data = report_data(mcap::McapReader(path));
  using scenario::Metric;
  scenario::AcceptanceLimit early = at_most(Metric::HorizontalRms, 1.5, scenario::Phase::SwapInterval);
  early.after_s = 2.0;
  data.score.verdicts =
      score::judge(data.score.scorer, {early, at_most(Metric::HorizontalRms, 0.1, scenario::Phase::BetweenOutages)});
  const auto curves = limit_curves({Metric::HorizontalRms}, data.score, 10.0);
  ASSERT_EQ(curves.size(), 2u);
  EXPECT_EQ(curves[0].title, "horizontal_rms_m at most 1.5");
  ASSERT_EQ(curves[0].x.size(), 3u);
  EXPECT_DOUBLE_EQ(curves[0].x[0], 2.0);
  EXPECT_DOUBLE_EQ(curves[0].x[1], 6.0);
  EXPECT_DOUBLE_EQ(curves[0].y[0], 1.5);
  ASSERT_EQ(curves[1].x.size(), 6u) << "before the outage and after it";
  EXPECT_NEAR(curves[1].x[1], 4.0, 1e-9);
  EXPECT_NEAR(curves[1].x[3], 8.1, 1e-9);
  EXPECT_TRUE(limit_curves({Metric::VerticalRms}, data.score, 10.0).empty());
  const std::string text = html(report_page(data));
  EXPECT_THAT(text,
              HasSubstr("<a href=\"#position-sizes\">horizontal_rms_m, before the first swap, after 2 s, at most 1.5"));
  EXPECT_THAT(text, HasSubstr("<h2 id=\"position-sizes\">"));
  EXPECT_THAT(text, HasSubstr("horizontal_rms_m at most 1.5</text>")) << "the limit is drawn";
  EXPECT_THAT(text, HasSubstr("<div class=\"narrow\"><svg")) << "and drawn for a narrow screen";
}

TEST_F(Report, GivesFiguresTheColourOfTheirVerdictAndSaysWhichRunItIs) {
  const std::string path = log(With::Everything);
  ReportData data = report_data(mcap::McapReader(path));
  using scenario::Metric;
  data.score.verdicts = score::judge(data.score.scorer, {at_most(Metric::HorizontalRms, 0.1, scenario::Phase::All),
                                                         at_most(Metric::VerticalRms, 0.1, scenario::Phase::All)});
  const std::string text = html(report_page(data));
  EXPECT_THAT(text, HasSubstr("<td class=\"bad\">0.3</td>"));
  EXPECT_THAT(text, testing::ContainsRegex("<td class=\"good\">[0-9.e-]+</td>"));
  EXPECT_THAT(text,
              HasSubstr("Simulated in one process, id 00000000000000000000000000000000; scenario turning, seed 1"));
  EXPECT_EQ(report_json(data).at("run").at("scenario"), "turning");
}

TEST_F(Report, SaysWhyThereIsNoAllanDeviationAndGoesOn) {
  const ReportData data = report_data(mcap::McapReader(log(With::ImuSamplesWithoutNoise)));
  EXPECT_FALSE(data.imu_errors);
  EXPECT_THAT(html(report_page(data)), HasSubstr("No Allan deviation: "));
  EXPECT_GT(data.score.scorer.counts().scored, 100u);
}

/// How often a file was opened since, by anybody.
class Openings {
 public:
  explicit Openings(const std::string& path) : queue_(inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
    // Equal events in a row become one: the reads keep the openings apart.
    inotify_add_watch(queue_, path.c_str(), IN_OPEN | IN_ACCESS | IN_CLOSE_NOWRITE);
  }
  ~Openings() { ::close(queue_); }
  Openings(const Openings&) = delete;
  Openings& operator=(const Openings&) = delete;

  std::size_t count() const {
    std::array<inotify_event, 256> events{};  // of a watched file they have no name: all have one size
    const ssize_t bytes = ::read(queue_, events.data(), sizeof(events));
    const auto end = events.begin() + (bytes < 0 ? 0 : bytes / static_cast<ssize_t>(sizeof(inotify_event)));
    return static_cast<std::size_t>(
        std::count_if(events.begin(), end, [](const inotify_event& event) { return (event.mask & IN_OPEN) != 0; }));
  }

 private:
  int queue_;
};

/// Bytes that this process has read of files, by its own count in the kernel.
std::uint64_t bytes_read() {
  std::ifstream io("/proc/self/io");
  std::string name;
  std::uint64_t bytes = 0;
  io >> name >> bytes;
  return name == "rchar:" ? bytes : 0;
}

TEST_F(Report, OfEveryKindTogetherOpensTheLogOnceAndReadsItTwice) {
  const std::string path = log(With::ImuSamplesToo);
  const Openings openings(path);
  const std::uint64_t before = bytes_read();
  if (before == 0) GTEST_SKIP() << "the kernel does not count what is read";
  const ReportData data = report_data(mcap::McapReader(path));
  const double read = static_cast<double>(bytes_read() - before);
  ASSERT_TRUE(data.imu_errors) << data.why_no_imu_errors;
  judgement_of(data, {});
  write_report(data, this->path("report"));
  EXPECT_EQ(openings.count(), 1u);
  const auto size = static_cast<double>(std::filesystem::file_size(path));
  EXPECT_GT(read, 1.5 * size);
  EXPECT_LT(read, 2.2 * size) << "and its index";
}

TEST(ReportLimits, EveryMetricHasItsPlaceOnThePage) {
  for (std::size_t i = 0; i < EnumNames<scenario::Metric>::values.size(); ++i) {
    EXPECT_NE(page_id_of(static_cast<scenario::Metric>(i)), "") << EnumNames<scenario::Metric>::values[i];
  }
  EXPECT_EQ(page_id_of(scenario::Metric::LatencyP99), page_id::kLatency);
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

}  // namespace report_test
}  // namespace inslab::report
