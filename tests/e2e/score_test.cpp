#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "inslab/formats/mcap/mcap_reader.hpp"
#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace score_test {

using std::chrono::seconds;
using testing::HasSubstr;
using testing::Not;

constexpr int kBadInput = 2;
constexpr int kNotAccepted = 4;

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// What the logger made of the app while it listened.
std::string live_score(const std::string& log_path) {
  const mcap::McapReader log(log_path);
  for (const auto& record : log.metadata()) {
    if (record.name == "score") return record.values.at("json");
  }
  return "";
}

TEST(Score, AnAppThatMissesALimitFailsTheRunAndTheLogSaysTheSame) {
  const TestFolder folder;
  const std::string log = folder / "log.mcap", junit = folder / "junit.xml";
  Process run("inslab",
              {"run", source("tests/data/scored.json"), "--domain", own_domain(), "--log", log, "--junit", junit});
  setenv("FASTRTPS_DEFAULT_PROFILES_FILE", source("config/dds/loopback.xml").c_str(), 1);
  Process app("fastdds_nav_client", {"--domain", own_domain(), "--seconds", "90"});
  unsetenv("FASTRTPS_DEFAULT_PROFILES_FILE");
  EXPECT_EQ(run.wait(seconds(90)), kNotAccepted) << run.output();
  EXPECT_EQ(app.wait(seconds(30)), 0) << app.output();
  EXPECT_THAT(run.output(), HasSubstr("PASS  horizontal_rms_m, between_outages, after 1 s, at most 2: "));
  EXPECT_THAT(run.output(), HasSubstr("FAIL  cep50_m, all, after 1 s, at most 1e-06: "));
  EXPECT_THAT(text_of(junit), HasSubstr("tests=\"2\" failures=\"1\""));

  Process json("inslab", {"report", log, "--json"});
  EXPECT_EQ(json.wait(seconds(30)), kNotAccepted);
  auto again = nlohmann::json::parse(json.output());
  EXPECT_EQ(again.at("expected").at("outages").size(), 1u);
  for (const char* of_the_log_alone : {"run", "verdict", "worst", "swap_intervals", "swaps_not_weighed", "expected"}) {
    EXPECT_EQ(again.erase(of_the_log_alone), 1u) << of_the_log_alone;
  }
  EXPECT_EQ(again, nlohmann::json::parse(live_score(log)));
  EXPECT_GT(again.at("scored").get<int>(), 700);
  EXPECT_EQ(again.at("outages").size(), 1u);

  Process page("inslab", {"report", log, "-o", folder / "report"});
  EXPECT_EQ(page.wait(seconds(60)), kNotAccepted) << page.output();
  const std::string html = text_of(folder / "report/log.html");
  for (const char* title :
       {"Acceptance", "Measured over expected", "Track: truth and app", "Position error", "Size of the position error",
        "Velocity error", "Attitude error", "Latency", "Allan deviation of the IMU"}) {
    EXPECT_THAT(html, testing::ContainsRegex(std::string("<h2[^>]*>") + title));
  }
  EXPECT_THAT(html, HasSubstr("FAIL: 1 of 2 acceptance lines passed"));
  // Nothing is fetched: the only addresses are the names of SVG's own vocabularies.
  for (const char* reference : {"src=", "<link", "<script", "@import", "href=\"http", "url(http"}) {
    EXPECT_THAT(html, Not(HasSubstr(reference)));
  }
}

TEST(Score, AMissingAppFailsTheRun) {
  const TestFolder folder;
  const std::string junit = folder / "junit.xml";
  Process run("inslab", {"run", source("tests/data/app_missing.json"), "--domain", own_domain(), "--log",
                         folder / "log.mcap", "--junit", junit});
  EXPECT_EQ(run.wait(seconds(90)), kNotAccepted) << run.output();
  EXPECT_THAT(run.output(), HasSubstr("FAIL  stale, at most 0: - (no solution came: the app is missing)"));
  EXPECT_THAT(text_of(junit), HasSubstr("<testsuite name=\"app_missing\" tests=\"1\" failures=\"1\" errors=\"0\">"));
  EXPECT_THAT(text_of(junit), HasSubstr("<failure message=\"no solution came: the app is missing\"/>"));
}

TEST(Score, ALimitOnTheLatencyIsRefusedInLockstepBeforeAnythingStarts) {
  const TestFolder folder;
  Process run("inslab", {"run", source("tests/data/latency_limit.json"), "--domain", own_domain(), "--log",
                         folder / "log.mcap", "--clock", "lockstep"});
  EXPECT_EQ(run.wait(seconds(30)), kBadInput) << run.output();
  EXPECT_THAT(run.output(), HasSubstr("latency_limit.json: acceptance[0].metric: is latency_p99_ms, but in lockstep"));
  EXPECT_FALSE(std::filesystem::exists(folder / "log.mcap"));
}

// The app is levelled for 2 of 3 seconds of sim time. What it gives then is good, but it comes too late.
TEST(Score, ALateAppFailsTheRun) {
  const TestFolder folder;
  const std::string junit = folder / "junit.xml";
  Process run("inslab", {"run", source("tests/data/app_late.json"), "--domain", own_domain(), "--log",
                         folder / "log.mcap", "--junit", junit});
  EXPECT_EQ(run.wait(seconds(90)), kNotAccepted) << run.output();
  EXPECT_THAT(run.output(), HasSubstr("FAIL  horizontal_rms_m, at most 5: "));
  EXPECT_THAT(run.output(), HasSubstr("(solutions cover "));
  EXPECT_THAT(run.output(), HasSubstr("FAIL  time_to_first_solution_s, at most 1: 2"));
  EXPECT_THAT(run.output(), HasSubstr("PASS  horizontal_rms_m, all, after 2.2 s, at most 5: "));
  EXPECT_THAT(run.output(), HasSubstr("latency: not judged, the run was in lockstep"));
  EXPECT_THAT(text_of(junit), HasSubstr("tests=\"3\" failures=\"2\""));
  EXPECT_THAT(text_of(junit), HasSubstr("<failure message=\"solutions cover "));
  EXPECT_THAT(text_of(junit), HasSubstr("is above 1\"/>"));
}

}  // namespace score_test
}  // namespace inslab::e2e
