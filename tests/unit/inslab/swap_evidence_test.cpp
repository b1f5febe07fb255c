#include "services/inslab/swap_evidence.hpp"

#include "services/inslab/log_sink.hpp"
#include "tests/unit/io/temporary_folder.hpp"

namespace inslab::cli {
namespace {

/// Writes a log that lies: what the log says differs from what the models did.
class TamperingSink : public LogSink {
 public:
  using LogSink::LogSink;
  double noise_factor = 1.0;
  std::uint64_t sequence_shift = 0;

  void imu(std::size_t index, const ImuSample& sample, const ImuTruth& truth) override {
    ImuSample changed = sample;
    changed.dtheta_b = truth.dtheta_b + noise_factor * (sample.dtheta_b - truth.dtheta_b);
    LogSink::imu(index, noise_factor == 1.0 ? sample : changed, truth);
  }
  void ack(const ProfileAck& ack) override {
    ProfileAck changed = ack;
    changed.first_sequence += sequence_shift;
    LogSink::ack(changed);
  }
};

class SwapEvidenceOfDemo : public test::TemporaryFolder {
 protected:
  /// A whole offline run of the demo: 60 s, four swaps, one of each kind.
  LogSummary write_log(double noise_factor = 1.0, std::uint64_t sequence_shift = 0) {
    const auto loaded = scenario::load(std::string(INSLAB_SOURCE_DIR) + "/config/scenarios/demo.json");
    const time::GpsTime start = loaded.start(time::Nanoseconds(0));
    TamperingSink sink(path("run.mcap"), loaded, start);
    sink.noise_factor = noise_factor;
    sink.sequence_shift = sequence_shift;
    OfflineRun run(loaded, start, RunId{}, sink);
    while (run.step()) {
    }
    sink.close();
    return summarize(io::McapReader(path("run.mcap")));
  }

  std::vector<SwapEvidence> weigh(const LogSummary& summary) {
    return weigh_swaps(io::McapReader(path("run.mcap")), summary);
  }

  static bool holds(const std::vector<SwapEvidence>& all, ProfileKind kind) {
    for (const SwapEvidence& evidence : all) {
      if (evidence.ack.kind == kind) return evidence.holds();
    }
    ADD_FAILURE() << "no evidence for " << enum_name(kind);
    return false;
  }
};

TEST_F(SwapEvidenceOfDemo, HoldsForAnHonestLogWithLinesForEverySwap) {
  const std::vector<SwapEvidence> all = weigh(write_log());
  ASSERT_EQ(all.size(), 4U);
  for (const SwapEvidence& evidence : all) {
    EXPECT_FALSE(evidence.lines.empty()) << enum_name(evidence.ack.kind);
    EXPECT_TRUE(evidence.first_sample_holds) << enum_name(evidence.ack.kind);
    EXPECT_TRUE(evidence.holds()) << enum_name(evidence.ack.kind);
    for (const EvidenceLine& line : evidence.lines) {
      for (const Measured& measured : {line.before, line.after}) {
        EXPECT_LE(std::abs(measured.value - measured.promised), measured.tolerance) << line.quantity;
        EXPECT_GT(measured.tolerance, 0.0) << line.quantity;
        // A tolerance as large as the promise would hold for anything; arms may be zero.
        if (line.unit == "m") continue;
        EXPECT_LT(measured.tolerance, 0.5 * measured.promised) << line.quantity;
      }
    }
  }
}

TEST_F(SwapEvidenceOfDemo, FailsWhenTheNoiseIsNotTheProfiles) {
  const std::vector<SwapEvidence> all = weigh(write_log(1.3));
  EXPECT_FALSE(holds(all, ProfileKind::ImuError));
  EXPECT_TRUE(holds(all, ProfileKind::GnssError));
}

TEST_F(SwapEvidenceOfDemo, FailsWhenTheAckNamesAnotherFirstSample) {
  for (const SwapEvidence& evidence : weigh(write_log(1.0, 1))) {
    EXPECT_FALSE(evidence.first_sample_holds) << enum_name(evidence.ack.kind);
    EXPECT_FALSE(evidence.holds());
  }
}

/// Every promise of every profile in the log made a little different: the samples no longer keep it.
void break_promises(AnyProfile& profile) {
  if (auto* imu = std::get_if<ImuErrorProfile>(&profile)) {
    imu->gyro.arw_deg_per_sqrt_h *= 1.3;
  } else if (auto* shaking = std::get_if<VibrationProfile>(&profile)) {
    for (LinearSinusoid& term : shaking->linear) term.amplitude_m_per_s2 *= 3.0;
  } else if (auto* installation = std::get_if<InstallationProfile>(&profile)) {
    installation->lever_arm_v_m.y() += 0.05;
  } else if (auto* gnss = std::get_if<GnssErrorProfile>(&profile)) {
    gnss->position_sigma_ned_m *= 1.5;
  }
}

TEST_F(SwapEvidenceOfDemo, FailsForEachKindWhoseProfilePromisesOtherwise) {
  const LogSummary honest = write_log();
  for (const ProfileKind kind :
       {ProfileKind::ImuError, ProfileKind::Vibration, ProfileKind::Installation, ProfileKind::GnssError}) {
    LogSummary tampered = honest;
    for (ProfileInUse& in_use : tampered.profiles) {
      if (kind_of(in_use.profile) == kind) break_promises(in_use.profile);
    }
    EXPECT_FALSE(holds(weigh(tampered), kind)) << enum_name(kind);
  }
}

TEST_F(SwapEvidenceOfDemo, SummaryCountsEverySampleOfEveryStream) {
  const LogSummary summary = write_log();
  EXPECT_EQ(summary.scenario.name, "demo");
  EXPECT_EQ(summary.streams.at("inslab/truth").logged.samples, 12001U);
  EXPECT_EQ(summary.streams.at("inslab/imu/0").logged.samples, 12000U);
  EXPECT_EQ(summary.streams.at("inslab/imu_truth/0").logged.samples, 12000U);
  for (const auto& [topic, stream] : summary.streams) {
    EXPECT_EQ(stream.logged.lost, 0U) << topic;
    EXPECT_EQ(stream.logged.duplicates, 0U) << topic;
  }
  EXPECT_EQ(summary.acks.size(), 4U);
}

}  // namespace
}  // namespace inslab::cli
