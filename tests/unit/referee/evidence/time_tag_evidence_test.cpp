#include "inslab/referee/evidence/time_tag_evidence.hpp"

#include <gtest/gtest.h>

#include "inslab/sim/log_sink.hpp"
#include "inslab/sim/offline_run.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::evidence {
namespace time_tag_evidence_test {

TimeTagErrors* clock_of(catalog::AnyProfile& profile) {
  if (auto* imu = std::get_if<ImuErrorProfile>(&profile)) return &imu->time_tag;
  if (auto* gnss = std::get_if<GnssErrorProfile>(&profile)) return &gnss->time_tag;
  return nullptr;
}

/// The demo of 60 s, whose swaps of the IMU and the receiver bring other clocks.
class TimeTagEvidence : public test::TemporaryFolder {
 protected:
  LogSummary write_log() {
    auto loaded = scenario::load(std::string(INSLAB_SOURCE_DIR) + "/config/scenarios/demo.json");
    for (catalog::AnyProfile& swap : loaded.swaps) {
      if (TimeTagErrors* clock = clock_of(swap)) *clock = {0.003, 100.0, 2e-4, 1e-4, 100.0, 1e-5, {}};
    }
    const time::GpsTime start = loaded.start(time::Nanoseconds(0));
    sim::LogSink sink(path("run.mcap"), loaded, start);
    sim::OfflineRun run(loaded, start, RunId{}, sink);
    while (run.step()) {
    }
    sink.close();
    return summarize(mcap::McapReader(path("run.mcap")));
  }

  /// The line of that name of the swap of that kind, and whether both its sides hold.
  std::optional<bool> holds(const LogSummary& summary, ProfileKind kind, const std::string& quantity) {
    for (const SwapEvidence& evidence : weigh_swaps(mcap::McapReader(path("run.mcap")), summary)) {
      if (evidence.ack.kind != kind) continue;
      for (const EvidenceLine& line : evidence.lines) {
        if (line.quantity == quantity) return line.before.holds && line.after.holds;
      }
    }
    return std::nullopt;
  }
};

TEST_F(TimeTagEvidence, HoldsForAnHonestLogAndFailsForAnotherPromise) {
  const LogSummary honest = write_log();
  for (const ProfileKind kind : {ProfileKind::ImuError, ProfileKind::GnssError}) {
    EXPECT_EQ(holds(honest, kind, "time tag"), true) << enum_name(kind);
    EXPECT_EQ(holds(honest, kind, "jitter of the time tag"), true) << enum_name(kind);
    LogSummary other = honest;
    for (ProfileInUse& in_use : other.profiles) {
      if (TimeTagErrors* clock = clock_of(in_use.profile)) clock->offset_s += 0.001;
    }
    EXPECT_EQ(holds(other, kind, "time tag"), false) << enum_name(kind);
    LogSummary calmer = honest;
    for (ProfileInUse& in_use : calmer.profiles) {
      if (TimeTagErrors* clock = clock_of(in_use.profile)) clock->white_sigma_s *= 0.5;
    }
    EXPECT_EQ(holds(calmer, kind, "jitter of the time tag"), false) << enum_name(kind);
    LogSummary slower = honest;
    for (ProfileInUse& in_use : slower.profiles) {
      if (TimeTagErrors* clock = clock_of(in_use.profile)) clock->drift_ppm = -clock->drift_ppm;
    }
    EXPECT_EQ(holds(slower, kind, "time tag"), false) << enum_name(kind);
  }
}

TEST_F(TimeTagEvidence, HasNoLineWhereNoClockErrs) {
  auto loaded = scenario::load(std::string(INSLAB_SOURCE_DIR) + "/config/scenarios/demo.json");
  const time::GpsTime start = loaded.start(time::Nanoseconds(0));
  sim::LogSink sink(path("run.mcap"), loaded, start);
  sim::OfflineRun run(loaded, start, RunId{}, sink);
  while (run.step()) {
  }
  sink.close();
  EXPECT_EQ(holds(summarize(mcap::McapReader(path("run.mcap"))), ProfileKind::ImuError, "time tag"), std::nullopt);
}

}  // namespace time_tag_evidence_test
}  // namespace inslab::evidence
