#include "inslab/services/inslab/study/outages_over_dds.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/data/samples/nav_state.hpp"
#include "inslab/data/wire/cdr.hpp"
#include "inslab/formats/log/log_topic.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/referee/verify/navigation.hpp"
#include "inslab/referee/verify/outage_figures.hpp"
#include "inslab/referee/verify/outage_verdict.hpp"
#include "inslab/services/inslab/live/live_run.hpp"
#include "inslab/sim/offline_run.hpp"
#include "inslab/sim/scenario_folder.hpp"

namespace inslab::study {

namespace {

constexpr std::uint64_t kSeed = 1;

/// A folder that goes with the object.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_(std::filesystem::temp_directory_path() / ("inslab_outages_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// One IMU of the protocol and its receiver with the first outages, the app told what its filter is told offline. It
/// begins at rest with the attitude that is given to it and the first fix.
std::string write_scenario(const verify::NavigationSetup& setup, std::size_t imu, const std::string& folder) {
  scenario::LoadedScenario loaded = verify::navigation_scenario(setup);
  loaded.imus = {loaded.imus[imu]};
  loaded.gnss.resize(1);
  loaded.gnss.front().errors.velocity_sigma_ned_m_per_s.setZero();  // positions alone
  loaded.scenario.reference_nav = scenario::ReferenceNav{loaded.imus.front().number, loaded.gnss.front().number, ""};
  navigation::NavigationParameters parameters = verify::filter_parameters(setup, imu);
  parameters.name = "outages";
  parameters.initial.attitude = navigation::InitialAttitude::Given;
  const scenario::InitialState& initial = setup.motion.initial;
  parameters.initial.rpy_deg = {initial.roll_deg, initial.pitch_deg, initial.yaw_deg};
  if (setup.file) {
    const nav::RollPitchYaw& rpy = *setup.file->rows.front().rpy;
    parameters.initial.rpy_deg = Vector3(rpy.roll_rad, rpy.pitch_rad, rpy.yaw_rad) / units::kDeg;
  }
  return sim::write_scenario_folder(loaded, parameters, folder);
}

/// The solutions and what they are measured by.
struct Solutions {
  std::vector<NavSolution> solutions;
  std::vector<ImuTruth> truths;  ///< by the sequence number of their IMU sample
};

class SolutionSink : public sim::RunSink {
 public:
  Solutions found;

  void journal(const catalog::AnyProfile&) override {}
  void truth(const TruthState&) override {}
  void imu(std::size_t, const ImuSample&, const ImuTruth& truth) override { found.truths.push_back(truth); }
  void gnss(std::size_t, const GnssFix&) override {}
  void nav(const NavSolution& solution) override { found.solutions.push_back(solution); }
  void ack(const ProfileAck&) override {}
};

Solutions in_one_process(const std::string& scenario_file) {
  const scenario::LoadedScenario loaded = scenario::load(scenario_file);
  SolutionSink sink;
  sim::OfflineRun run(loaded, loaded.start({}), RunId{}, sink);
  while (run.step()) continue;
  return std::move(sink.found);
}

std::vector<NavSolution> over_dds(const std::string& scenario_file, const service::NetworkOptions& network,
                                  const std::string& folder) {
  live::RunOptions options;
  options.scenario = scenario_file;
  options.network = network;
  options.clock.mode = "lockstep";
  options.log_file = folder + "/log.mcap";
  options.state_folder = folder;
  const scenario::LoadedScenario loaded = scenario::load(scenario_file);
  live::LiveRun run(options, loaded);
  run.start_services();
  run.follow();
  if (const auto failure = run.failure()) throw std::runtime_error("the run over DDS failed: " + *failure);
  std::vector<NavSolution> solutions;
  log::for_each_sample<NavSolution>(mcap::McapReader(options.log_file), catalog::kNav.name,
                                    [&](const NavSolution& solution, std::uint64_t) {
                                      solutions.push_back(solution);
                                      return true;
                                    });
  return solutions;
}

std::size_t same_bits(const std::vector<NavSolution>& a, const std::vector<NavSolution>& b) {
  std::size_t same = 0;
  std::vector<std::uint8_t> of_a, of_b;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    wire::encode(a[i], of_a);
    wire::encode(b[i], of_b);
    same += of_a == of_b ? 1 : 0;
  }
  return same;
}

verify::DriftFigures drift_of(const std::vector<NavSolution>& solutions, const std::vector<ImuTruth>& truths,
                              const verify::NavigationSetup& setup) {
  verify::OutageScore score(setup.outages, setup.duration_s);
  for (const NavSolution& s : solutions) {
    const ImuTruth& truth = truths.at(s.imu_sequence);
    score.add(truth.header.sim_time_ns, {geodetic_of(s), s.v_n, s.q_n_body}, nav_state(truth));
  }
  verify::NavigationRun run;
  run.outages = score.outages();
  return verify::drift_of({run});
}

}  // namespace

verify::Table outages_over_dds(const service::NetworkOptions& network, const verify::OutageTimes& outages) {
  verify::Table table;
  table.judged = outages == verify::OutageTimes{};
  table.title = "The same over DDS in lockstep: horizontal / vertical m; roll pitch yaw deg";
  table.columns = {"IMU", "motion", "over DDS", "same bits as in one process", "thesis simulated", "outside"};
  for (const verify::MotionFrom motion : {verify::MotionFrom::Parameters, verify::MotionFrom::File}) {
    verify::NavigationSetup setup = verify::thesis_setup(kSeed, motion, outages);
    setup.shifts_s = {0.0};
    for (std::size_t i = 0; i < setup.imus.size(); ++i) {
      const TemporaryFolder folder;
      const std::string scenario_file = write_scenario(setup, i, folder.path());
      const std::vector<NavSolution> live = over_dds(scenario_file, network, folder.path());
      const Solutions offline = in_one_process(scenario_file);
      const std::size_t same = same_bits(live, offline.solutions);
      const verify::DriftFigures found = drift_of(live, offline.truths, setup);
      const verify::PublishedDrift& published = verify::published_drifts()[i];
      const verify::DriftFigures& simulated = verify::simulated(published, motion);
      const bool all_same = same == offline.truths.size() && live.size() == same;
      const verify::DriftFigures ratios = verify::ratios(found, simulated);
      const bool none_is_worse =
          *std::max_element(ratios.begin(), ratios.end()) <= verify::allowed_factor(verify::Against::Simulated);
      table.rows.push_back({{published.imu, verify::name_of(motion), verify::text_of(found),
                             fmt::format("{} of {}", same, offline.truths.size()), verify::text_of(simulated),
                             verify::judged(ratios, verify::Against::Simulated, published.imu).misses},
                            all_same && none_is_worse});
    }
  }
  table.notes = {
      "Five processes a row: trajectory server, injector, emulator, inslab-reference-nav, logger; outages of the first "
      "of the three shifts above. The app begins at the first fix with the attitude that it is given. A row holds when "
      "the bits are the same and no figure is more than twice the thesis's: whether one is too small is judged above, "
      "of three times as many outages."};
  return table;
}

}  // namespace inslab::study
