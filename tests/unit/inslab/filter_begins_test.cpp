// The reference filter with every IMU of config/profiles in every scenario of config/scenarios: it begins, or says why
// it cannot, and what it then says of its own errors is true.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <filesystem>

#include "nav/attitude.hpp"
#include "samples/units.hpp"
#include "scenario/load.hpp"
#include "services/inslab/offline_run.hpp"

namespace inslab::cli {
namespace {

constexpr double kRate_hz = 50.0;
constexpr double kAfter_s = 30.0;  // looked at once it has begun
constexpr double kLongest_s = 150.0;

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

/// The filter's errors squared over its own covariance, 3 degrees of freedom each.
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
    const auto squared = [&](reference_nav::StateIndex first, const Vector3& error) {
      const Matrix3 block = P.block<3, 3>(first, first);
      return error.dot(block.llt().solve(error));
    };
    const nav::Geodetic true_place{truth_.latitude_rad, truth_.longitude_rad, truth_.height_m};
    const nav::NavState state = filter.state();
    position += squared(reference_nav::kPosition, nav::ned_from(true_place, state.position));
    velocity += squared(reference_nav::kVelocity, state.v_n - truth_.v_n);
    // The computed C_nb is (I - [phi x]) C_nb.
    attitude +=
        squared(reference_nav::kAttitude, -nav::rotation_vector_from_quaternion(state.q_nb * truth_.q_nb.conjugate()));
    if (count == 0.0) {
      heading_deg = nav::rotation_vector_from_quaternion(state.q_nb * truth_.q_nb.conjugate()).z() / units::kDeg;
      heading_sigma_deg = std::sqrt(P(8, 8)) / units::kDeg;
    }
    count += 1.0;
  }

  const reference_nav::Navigator* navigator = nullptr;
  std::optional<double> begun_s;
  double position = 0.0, velocity = 0.0, attitude = 0.0, count = 0.0;
  double heading_deg = 0.0, heading_sigma_deg = 0.0;

 private:
  ImuTruth truth_;
};

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
  loaded.swaps.clear();
  loaded.scenario.swaps.clear();
  scenario::ReferenceNav app;
  app.imu = loaded.imus[0].number;
  app.gnss = loaded.gnss[0].number;
  loaded.scenario.reference_nav = app;
  return loaded;
}

TEST(ReferenceFilter, BeginsInEveryScenarioWithEveryImuOrSaysWhyNotAndIsHonestAfter) {
  // Errors of the first half minute are those of the beginning, so a run is about one draw of a chi-square with 3
  // degrees of freedom: beyond 30 lies one in 700 thousand; the mean of hundreds is 3 to 0.15.
  constexpr double kMost = 30.0, kMostMean = 4.5;
  double position = 0.0, velocity = 0.0, attitude = 0.0, runs = 0.0, pairs = 0.0;
  for (const std::filesystem::path& scenario_file : files_of("scenarios")) {
    for (const std::filesystem::path& imu_file : files_of("profiles/imu")) {
      const AnyProfile profile = scenario::load_profile(imu_file, ProfileKind::ImuError, {SensorKind::Imu, 0});
      const scenario::LoadedScenario loaded = with(scenario_file, std::get<ImuErrorProfile>(profile));
      SCOPED_TRACE(scenario_file.stem().string() + " with " + imu_file.stem().string());
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
        const auto& filter = run.navigator()->filter();
        EXPECT_FALSE(filter.motion_refusal().empty());
        EXPECT_NE(filter.motion_refusal().find_first_of("0123456789"), std::string::npos) << filter.motion_refusal();
        continue;
      }
      runs += 1.0;
      position += watch.position / watch.count;
      velocity += watch.velocity / watch.count;
      attitude += watch.attitude / watch.count;
      const std::string heading = "began at " + std::to_string(*watch.begun_s) + " s with a heading of " +
                                  std::to_string(watch.heading_deg) + " deg, sigma " +
                                  std::to_string(watch.heading_sigma_deg);
      EXPECT_LT(watch.position / watch.count, kMost) << heading;
      EXPECT_LT(watch.velocity / watch.count, kMost) << heading;
      EXPECT_LT(watch.attitude / watch.count, kMost) << heading;
    }
  }
  RecordProperty("began", std::to_string(runs) + " of " + std::to_string(pairs));
  EXPECT_GT(runs, 0.75 * pairs) << pairs;
  EXPECT_LT(position / runs, kMostMean);
  EXPECT_LT(velocity / runs, kMostMean);
  EXPECT_LT(attitude / runs, kMostMean);
}

}  // namespace
}  // namespace inslab::cli
