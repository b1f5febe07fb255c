#include "inslab/referee/evidence/swap_evidence.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <complex>
#include <filesystem>

#include "inslab/data/json/json_file.hpp"
#include "inslab/data/json/json_reader.hpp"
#include "inslab/referee/evidence/filter_response.hpp"
#include "inslab/referee/evidence/swap_window.hpp"
#include "inslab/sim/log_sink.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"
#include "tests/unit/sim/journal_of_faults.hpp"

namespace inslab::evidence {
namespace swap_evidence_test {

/// Writes a log that lies: what the log says differs from what the models did.
class TamperingSink : public sim::LogSink {
 public:
  using sim::LogSink::LogSink;
  double noise_factor = 1.0;
  std::uint64_t sequence_shift = 0;

  void imu(std::size_t index, const ImuSample& sample, const ImuTruth& truth) override {
    ImuSample changed = sample;
    changed.dtheta_b = truth.dtheta_b + noise_factor * (sample.dtheta_b - truth.dtheta_b);
    sim::LogSink::imu(index, noise_factor == 1.0 ? sample : changed, truth);
  }
  void ack(const ProfileAck& ack) override {
    ProfileAck changed = ack;
    changed.first_sequence += sequence_shift;
    sim::LogSink::ack(changed);
  }
};

class SwapEvidenceOfDemo : public test::TemporaryFolder {
 protected:
  /// A whole offline run of the demo: 60 s, four swaps, one of each kind.
  LogSummary write_log(double noise_factor = 1.0, std::uint64_t sequence_shift = 0, const char* name = "demo") {
    const auto loaded = scenario::load(std::string(INSLAB_SOURCE_DIR) + "/config/scenarios/" + name + ".json");
    const time::GpsTime start = loaded.start(time::Nanoseconds(0));
    TamperingSink sink(path("run.mcap"), loaded, start);
    sink.noise_factor = noise_factor;
    sink.sequence_shift = sequence_shift;
    sim::OfflineRun run(loaded, start, RunId{}, sink);
    while (run.step()) {
    }
    sink.close();
    return summarize(mcap::McapReader(path("run.mcap")));
  }

  std::vector<SwapEvidence> weigh(const LogSummary& summary) {
    return weigh_swaps(mcap::McapReader(path("run.mcap")), summary);
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
void break_promises(catalog::AnyProfile& profile) {
  if (auto* imu = std::get_if<ImuErrorProfile>(&profile)) {
    imu->gyro.arw_deg_per_sqrt_h *= 1.3;
  } else if (auto* shaking = std::get_if<VibrationProfile>(&profile)) {
    for (LinearSinusoid& term : shaking->linear) term.amplitude_m_per_s2 *= 3.0;
  } else if (auto* installation = std::get_if<InstallationProfile>(&profile)) {
    installation->lever_arm_v_m.y() += 0.05;
  } else if (auto* gnss = std::get_if<GnssErrorProfile>(&profile)) {
    gnss->position_sigma_ned_m *= 1.5;
  } else if (auto* heading = std::get_if<HeadingErrorProfile>(&profile)) {
    heading->relative_sigma_ned_m *= 1.7;
  }
}

TEST_F(SwapEvidenceOfDemo, FailsForEachKindWhoseProfilePromisesOtherwise) {
  const LogSummary honest = write_log();
  for (const ProfileKind kind :
       {ProfileKind::ImuError, ProfileKind::Vibration, ProfileKind::Installation, ProfileKind::GnssError}) {
    LogSummary tampered = honest;
    for (ProfileInUse& in_use : tampered.profiles) {
      if (catalog::kind_of(in_use.profile) == kind) break_promises(in_use.profile);
    }
    EXPECT_FALSE(holds(weigh(tampered), kind)) << enum_name(kind);
  }
}

/// Another receiver, and another place of its antennas; what a profile has of both is told from the samples alone.
TEST_F(SwapEvidenceOfDemo, OfTwoAntennasHoldsAndFailsWhenAProfilePromisesOtherwise) {
  const LogSummary honest = write_log(1.0, 0, "two_antennas");
  for (const ProfileKind kind : {ProfileKind::HeadingError, ProfileKind::Installation}) {
    EXPECT_TRUE(holds(weigh(honest), kind)) << enum_name(kind);
    LogSummary tampered = honest;
    for (ProfileInUse& in_use : tampered.profiles) {
      if (catalog::kind_of(in_use.profile) == kind) break_promises(in_use.profile);
    }
    EXPECT_FALSE(holds(weigh(tampered), kind)) << enum_name(kind);
  }
}

/// Another probe, and another place of it.
TEST_F(SwapEvidenceOfDemo, OfAnAirDataProbeHoldsAndFailsWhenAProfilePromisesOtherwise) {
  const LogSummary honest = write_log(1.0, 0, "air_data");
  EXPECT_TRUE(holds(weigh(honest), ProfileKind::Installation));
  EXPECT_TRUE(holds(weigh(honest), ProfileKind::AirDataError));
  const auto breaks = [&](const auto& change) {
    LogSummary tampered = honest;
    for (ProfileInUse& in_use : tampered.profiles) {
      if (auto* errors = std::get_if<AirDataErrorProfile>(&in_use.profile)) change(*errors);
    }
    return !holds(weigh(tampered), ProfileKind::AirDataError);
  };
  EXPECT_TRUE(breaks([](AirDataErrorProfile& p) { p.impact_pressure.white_sigma_pa *= 1.7; }));
  EXPECT_TRUE(breaks([](AirDataErrorProfile& p) { p.impact_pressure.offset_pa += 20.0; }));
  EXPECT_TRUE(breaks([](AirDataErrorProfile& p) { p.impact_pressure.scale_factor_ppm += 20000.0; }));
  EXPECT_TRUE(breaks([](AirDataErrorProfile& p) { p.static_pressure.offset_pa += 60.0; }));
  EXPECT_TRUE(breaks([](AirDataErrorProfile& p) { p.angle_of_attack.white_sigma_deg *= 2.0; }));
  EXPECT_TRUE(breaks([](AirDataErrorProfile& p) { p.angle_of_attack.bias_deg += 1.0; }));
}

class SwapEvidenceOfShippedProfiles : public test::TemporaryFolder,
                                      public testing::WithParamInterface<std::filesystem::path> {
 protected:
  static ImuErrorProfile profile(const std::filesystem::path& file) {
    return json::struct_from_json<ImuErrorProfile>(json::read_json_file(file.string()), file.string());
  }

  /// The demo's car, whose IMU changes to `errors` and then begins to vibrate.
  std::vector<SwapEvidence> swapped_to(ImuErrorProfile errors, double noise_factor = 1.0) {
    auto loaded = scenario::load(std::string(INSLAB_SOURCE_DIR) + "/config/scenarios/demo.json");
    std::vector<catalog::AnyProfile> swaps;
    for (catalog::AnyProfile& swap : loaded.swaps) {
      if (catalog::kind_of(swap) == ProfileKind::Vibration) swaps.push_back(swap);
    }
    errors.target = {SensorKind::Imu, 0};
    errors.latency_s += 1e-6;  // the demo begins with stim300: no swap changes nothing
    errors.request.apply_at_ns = 15'000'000'000;
    swaps.insert(swaps.begin(), errors);
    loaded.swaps = swaps;
    const time::GpsTime start = loaded.start(time::Nanoseconds(0));
    TamperingSink sink(path("run.mcap"), loaded, start);
    sink.noise_factor = noise_factor;
    sim::OfflineRun run(loaded, start, RunId{}, sink);
    while (run.step()) {
    }
    sink.close();
    const mcap::McapReader log(path("run.mcap"));
    return weigh_swaps(log, summarize(log));
  }
};

TEST_P(SwapEvidenceOfShippedProfiles, IsMeasuredAndHolds) {
  const std::vector<SwapEvidence> all = swapped_to(profile(GetParam()));
  ASSERT_EQ(all.size(), 2U);
  for (const SwapEvidence& evidence : all) {
    const bool has_clock = evidence.ack.kind == ProfileKind::ImuError && !profile(GetParam()).time_tag.are_none();
    EXPECT_EQ(evidence.lines.size(), has_clock ? 4U : 2U)
        << enum_name(evidence.ack.kind) << ": " << evidence.why_nothing;
    for (const EvidenceLine& line : evidence.lines) {
      for (const Measured& measured : {line.before, line.after}) {
        EXPECT_TRUE(measured.holds) << line.quantity << ": " << measured.value << " where " << measured.promised
                                    << " within " << measured.tolerance << " is promised";
        if (line.unit == "s") continue;  // before it the clock was right
        EXPECT_LT(measured.tolerance, 0.5 * measured.promised + 1e-12) << line.quantity;
      }
    }
  }
}

std::vector<std::filesystem::path> shipped_imu_profiles() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(INSLAB_SOURCE_DIR "/config/profiles/imu")) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}
INSTANTIATE_TEST_SUITE_P(Config, SwapEvidenceOfShippedProfiles, testing::ValuesIn(shipped_imu_profiles()),
                         [](const auto& parameter) { return parameter.param.stem().string(); });

using SwapEvidenceOfAFilter = SwapEvidenceOfShippedProfiles;

TEST_F(SwapEvidenceOfAFilter, HoldsAndFailsWhenTheNoiseIsNotTheProfiles) {
  auto filtered = profile(std::string(INSLAB_SOURCE_DIR) + "/config/profiles/imu/stim300.json");
  for (const FilterOrder order : {FilterOrder::First, FilterOrder::Second}) {
    filtered.gyro.bandwidth_hz.setConstant(40.0);
    filtered.gyro.bandwidth_order = order;
    const std::vector<SwapEvidence> honest = swapped_to(filtered);
    EXPECT_TRUE(honest.front().holds());
    EXPECT_THAT(honest.front().lines.front().quantity, testing::HasSubstr("as the bandwidth lets it pass"));
    EXPECT_LT(honest.front().lines.front().after.promised, 0.8 * honest.front().lines.front().before.promised);
    for (const double factor : {0.9, 1.1}) EXPECT_FALSE(swapped_to(filtered, factor).front().holds()) << factor;
  }
}

TEST_F(SwapEvidenceOfAFilter, SaysTheTrueReasonWhereNothingIsMeasured) {
  ImuErrorProfile cut = profile(std::string(INSLAB_SOURCE_DIR) + "/config/profiles/imu/stim300.json");
  cut.gyro.full_scale_deg_per_s.setConstant(1e-6);  // noise alone is past its end
  const std::vector<SwapEvidence> all = swapped_to(cut);
  EXPECT_TRUE(all.front().lines.empty());
  EXPECT_EQ(all.front().why_nothing,
            "only 0 pairs of usable samples after it, in the 19.995 s to its neighbour or the end; 30 are needed");
}

TEST_F(SwapEvidenceOfDemo, ErrorsOfARecordingAreTakenOffBeforeTheRestIsWeighed) {
  const std::vector<SwapEvidence> all = weigh(write_log(1.0, 0, "grafting"));
  ASSERT_EQ(all.size(), 2U);
  EXPECT_THAT(all[0].left_out, testing::Contains("recorded errors"));
  for (const SwapEvidence& evidence : all) {
    EXPECT_EQ(evidence.lines.size(), 2U);
    EXPECT_TRUE(evidence.holds());
  }
  // What the profile beside the recording promises is nothing: more than that is seen.
  EXPECT_FALSE(weigh(write_log(1.1, 0, "grafting"))[0].holds());
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

/// A first-order filter of which the closed form is known: sampled with decay d = exp(-w dt), interval by interval.
TEST(FilterResponse, OfAFirstOrderFilterHasItsClosedForm) {
  constexpr double kBandwidth_hz = 20.0, kDt_s = 0.005;
  const FilterResponse response(kBandwidth_hz, FilterOrder::First, kDt_s);
  // h[0] = 1 - (1-d)/(w dt), h[k] = (1-d)^2 d^(k-1) / (w dt): the mean over the interval of an exponential approach.
  const double w_dt = 2.0 * 3.14159265358979323846 * kBandwidth_hz * kDt_s, d = std::exp(-w_dt);
  const double h0 = 1.0 - (1.0 - d) / w_dt, h1 = (1.0 - d) * (1.0 - d) / w_dt;
  EXPECT_NEAR(response.white_gain(), h0 * h0 + h1 * h1 / (1.0 - d * d), 1e-9);
  // |H(f)|^2 = |h0 + h1 z / (1 - d z)|^2, z = exp(-2 pi i f dt).
  const std::complex<double> z = std::polar(1.0, -2.0 * 3.14159265358979323846 * 30.0 * kDt_s);
  EXPECT_NEAR(response.power_at(30.0), std::norm(h0 + h1 * z / (1.0 - d * z)), 1e-6);
  EXPECT_NEAR(response.power_at(0.0), 1.0, 1e-5) << "nothing is lost";
}

TEST(FilterResponse, WithoutAFilterIsThatOfWhiteNoise) {
  const FilterResponse none;
  EXPECT_EQ(none.white_gain(), 1.0);
  EXPECT_EQ(none.difference_gain(), 1.0);
  EXPECT_EQ(none.white_correlation(), 1.0);
  EXPECT_EQ(none.difference_correlation(), 1.5);
}

/// As long a journal as a soak makes: each swap has its first sample. What it costs is measured by bench_offline.
TEST(SwapWindowsOfLog, FindTheFirstSampleOfEverySwapOfALongJournal) {
  constexpr std::uint32_t kSwaps = 16000;
  const LogSummary summary = sim::journal_of_faults(kSwaps);
  SwapWindowsOfLog windows(summary);
  for (std::uint32_t i = 1; i <= kSwaps; ++i) windows.add(sim::sample_after(i, kSwaps), ImuTruth{}, TruthState{});
  ASSERT_EQ(windows.all().size(), kSwaps);
  for (std::uint32_t i = 1; i <= kSwaps; ++i) ASSERT_EQ(windows.all()[i - 1].first_sequence_seen, i);
}

}  // namespace swap_evidence_test
}  // namespace inslab::evidence
