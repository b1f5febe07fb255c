// The reference filter with every IMU of config/profiles in every scenario of config/scenarios: it begins, or says why
// it cannot, and what it then says of its own errors is true.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <filesystem>

#include "nav/attitude.hpp"
#include "scenario/load.hpp"
#include "services/inslab/offline_run.hpp"
#include "units/units.hpp"

namespace inslab::cli {
namespace filter_begins_test {

constexpr double kRate_hz = 50.0;
constexpr double kAfter_s = 10.0;  // looked at once it has begun
constexpr double kLongest_s = 100.0;

const std::filesystem::path& config_folder() {
  static const std::filesystem::path folder = std::filesystem::path(INSLAB_SOURCE_DIR) / "config";
  return folder;
}

std::vector<std::filesystem::path> files_of(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(config_folder() / folder)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The filter's attitude against its own covariance: 3 degrees of freedom.
class Watch final : public RunSink {
 public:
  void journal(const AnyProfile&) override {}
  void truth(const TruthState&) override {}
  void imu(std::size_t index, const ImuSample&, const ImuTruth& truth) override {
    if (index == 0) truth_ = truth;
  }
  void gnss(std::size_t, const GnssFix&) override {}
  void ack(const ProfileAck&) override {}
  void nav(const NavSolution& solution) override {
    if (solution.mode != NavMode::Navigating && solution.mode != NavMode::Coasting) return;
    const double t_s = 1e-9 * static_cast<double>(truth_.header.sim_time_ns);
    if (!begun_s) begun_s = t_s;
    const reference_nav::InertialFilter& filter = *navigator->filter().filter();
    const auto& P = filter.covariance().matrix();
    const nav::NavState state = filter.state();
    // The computed C_nb is (I - [phi x]) C_nb.
    const Vector3 phi = -nav::rotation_vector_from_quaternion(state.q_nb * truth_.q_nb.conjugate());
    const Matrix3 P_phi = P.block<3, 3>(reference_nav::kAttitude, reference_nav::kAttitude);
    attitude += phi.dot(P_phi.llt().solve(phi));
    if (count == 0.0) {
      heading_deg = phi.z() / units::kDeg;
      heading_sigma_deg = std::sqrt(P_phi(2, 2)) / units::kDeg;
    }
    count += 1.0;
  }

  const reference_nav::Navigator* navigator = nullptr;
  std::optional<double> begun_s;
  double attitude = 0.0, count = 0.0;
  double heading_deg = 0.0, heading_sigma_deg = 0.0;

 private:
  ImuTruth truth_;
};

GnssErrorProfile white_receiver(const SensorAddress& target) {
  const auto file = config_folder() / "profiles" / "gnss" / "rtk_white.json";
  return std::get<GnssErrorProfile>(scenario::load_profile(file, ProfileKind::GnssError, target));
}

/// The scenario with one IMU of the profile, at a lower rate for the sake of time.
scenario::LoadedScenario with(const std::filesystem::path& file, const ImuErrorProfile& errors) {
  scenario::LoadedScenario loaded = scenario::load(file);
  loaded.truth_rate = time::Rate(kRate_hz);
  loaded.imus.resize(1);
  loaded.gnss.resize(1);
  loaded.imus[0].rate = time::Rate(kRate_hz);
  const SensorAddress target = loaded.imus[0].errors.target;
  loaded.imus[0].errors = errors;
  loaded.imus[0].errors.target = target;
  // What no filter of this kind models: vibration, and what is slow in a receiver's errors.
  loaded.imus[0].vibration = {};
  loaded.imus[0].vibration.target = target;
  loaded.gnss[0].errors = white_receiver(loaded.gnss[0].errors.target);
  loaded.swaps.clear();
  loaded.scenario.swaps.clear();
  scenario::ReferenceNav app;
  app.imu = loaded.imus[0].number;
  app.gnss = loaded.gnss[0].number;
  loaded.scenario.reference_nav = app;
  return loaded;
}

TEST(ReferenceFilter, BeginsInEveryScenarioWithEveryImuOrSaysWhyNotAndKnowsItsHeading) {
  double runs = 0.0, pairs = 0.0, honest = 0.0;
  std::string beyond;
  for (const std::filesystem::path& scenario_file : files_of("scenarios")) {
    for (const std::filesystem::path& imu_file : files_of("profiles/imu")) {
      const AnyProfile profile = scenario::load_profile(imu_file, ProfileKind::ImuError, {SensorKind::Imu, 0});
      const scenario::LoadedScenario loaded = with(scenario_file, std::get<ImuErrorProfile>(profile));
      const std::string name = scenario_file.stem().string() + " with " + imu_file.stem().string();
      SCOPED_TRACE(name);
      Watch watch;
      OfflineRun run(loaded, {2446, 0}, RunId{}, watch);
      watch.navigator = run.navigator();
      const auto over = [&] {
        const double now_s = time::to_seconds(run.sim_time());
        if (now_s >= loaded.scenario.duration_s) return true;
        return watch.begun_s ? now_s > *watch.begun_s + kAfter_s : now_s > kLongest_s;
      };
      while (!over() && run.step()) {
      }
      pairs += 1.0;
      if (!watch.begun_s) {
        EXPECT_FALSE(run.navigator()->filter().motion_refusal().empty());
        continue;
      }
      runs += 1.0;
      const double nees = watch.attitude / watch.count;
      // Beyond 21 lies one honest attitude in ten thousand.
      if (nees < 21.0) honest += 1.0;
      if (nees >= 21.0) {
        beyond += name + ": attitude NEES " + std::to_string(nees) + ", began at " + std::to_string(*watch.begun_s) +
                  " s with a heading of " + std::to_string(watch.heading_deg) + " deg, sigma " +
                  std::to_string(watch.heading_sigma_deg) + "\n";
      }
    }
  }
  RecordProperty("began", std::to_string(runs) + " of " + std::to_string(pairs));
  EXPECT_GT(runs, 0.5 * pairs) << "of " << pairs;
  // Profiles with terms that the filter does not model, such as g-sensitivity, are among them.
  EXPECT_GT(honest, 0.9 * runs) << beyond;
}

}  // namespace filter_begins_test
}  // namespace inslab::cli
