// The reference filter with every IMU of config/profiles in every scenario of config/scenarios: it begins, or
// `inslab check` says that it cannot and what to set, and what the filter says of its own errors is true.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/navigation/app_setup.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/sim/look_ahead.hpp"
#include "inslab/sim/offline_run.hpp"

namespace inslab::sim {
namespace filter_begins_test {

constexpr double kRate_hz = 50.0;
constexpr double kLongest_s = 700.0;  // of waiting for the beginning
/// Looked at so long after the beginning.
constexpr std::array<double, 4> kMoments_s{0.0, 1.0, 3.0, 10.0};

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

/// Squared errors over their covariance, position, velocity, attitude: 3 degrees of freedom each.
using Nees = std::array<double, 3>;

Nees nees_of(const navigation::InertialFilter& filter, const ImuTruth& truth) {
  const nav::NavState state = filter.state();
  std::array<Vector3, 3> errors;
  errors[0] = nav::ned_from(state.position, geodetic_of(truth));
  errors[1] = state.v_n - truth.v_n;
  // The computed C_nb is (I - [phi x]) C_nb.
  errors[2] = -nav::rotation_vector_from_quaternion(state.q_nb * truth.q_nb.conjugate());
  Nees nees{};
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Matrix3 P = filter.covariance().matrix().block<3, 3>(3 * i, 3 * i);
    nees[static_cast<std::size_t>(i)] =
        errors[static_cast<std::size_t>(i)].dot(P.llt().solve(errors[static_cast<std::size_t>(i)]));
  }
  return nees;
}

/// One IMU of the scenario, its receiver and its filter.
struct Unit {
  std::string name;
  scenario::LoadedScenario loaded;
  Sensor<catalog::Imu> injector;
  Sensor<catalog::Gnss> emulator;
  navigation::Navigator navigator;
  bool has_fix = false;
  std::optional<nav::RollPitchYaw> first_rpy;  ///< at the first fix
  std::optional<double> begun_s;
  std::vector<Nees> nees;                    ///< at the moments
  std::map<std::uint64_t, ImuTruth> truths;  ///< of the samples that the filter has not had, by their number

  Unit(const std::string& imu_name, const scenario::LoadedScenario& scenario, const navigation::AppSetup& setup)
      : name(imu_name),
        loaded(scenario),
        injector(scenario, scenario.imus[0]),
        emulator(scenario, scenario.gnss[0]),
        navigator(setup.parameters, setup.gravity) {}

  bool is_done() const { return nees.size() == kMoments_s.size(); }

  void take(const TruthState& truth) {
    if (is_done()) return;
    if (const auto result = emulator.process(truth); result.output) {
      navigator.add(*result.output);
      has_fix = true;
    }
    const auto result = injector.process(truth);
    if (!result.output) return;
    if (has_fix && !first_rpy) first_rpy = nav::rpy_from_matrix(nav::matrix_from_quaternion(result.output->truth.q_nb));
    truths.emplace(result.output->sample.header.sequence_number, result.output->truth);
    navigator.add(result.output->sample);
    navigator.fixes_complete_up_to(truth.header.sim_time_ns);
    while (const auto step = navigator.step()) {
      const ImuTruth now = truths.at(step->imu_sequence);
      truths.erase(truths.begin(), truths.upper_bound(step->imu_sequence));
      const navigation::InertialFilter* filter = navigator.filter().filter();
      if (filter == nullptr) continue;
      const double t_s = time::to_seconds(now.header.sim_time_ns);
      if (!begun_s) begun_s = t_s;
      if (t_s - *begun_s > kMoments_s[nees.size()] - 0.5 / kRate_hz) nees.push_back(nees_of(*filter, now));
      if (is_done()) return;
    }
  }
};

/// The scenario with one IMU of the profile, at a lower rate for the sake of time.
scenario::LoadedScenario with(const scenario::LoadedScenario& scenario, const ImuErrorProfile& errors) {
  scenario::LoadedScenario loaded = scenario;
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
  const auto white = config_folder() / "profiles" / "gnss" / "rtk_white.json";
  loaded.gnss[0].errors =
      std::get<GnssErrorProfile>(scenario::load_profile(white, ProfileKind::GnssError, loaded.gnss[0].errors.target));
  loaded.swaps.clear();
  loaded.scenario.swaps.clear();
  scenario::ReferenceNav app;
  app.imu = loaded.imus[0].number;
  app.gnss = loaded.gnss[0].number;
  loaded.scenario.reference_nav = app;
  return loaded;
}

std::vector<std::unique_ptr<Unit>> units_of(const scenario::LoadedScenario& scenario) {
  std::vector<std::unique_ptr<Unit>> units;
  for (const std::filesystem::path& file : files_of("profiles/imu")) {
    const catalog::AnyProfile profile = scenario::load_profile(file, ProfileKind::ImuError, {SensorKind::Imu, 0});
    scenario::LoadedScenario loaded = with(scenario, std::get<ImuErrorProfile>(profile));
    loaded.scenario.seed += 1000 * units.size();
    const auto setup = navigation::setup_for(loaded, *loaded.scenario.reference_nav);
    units.push_back(std::make_unique<Unit>(file.stem().string(), loaded, setup));
  }
  return units;
}

/// Quantile of chi-square with k degrees of freedom at z standard deviations of the normal (Wilson, Hilferty 1931).
double chi_square(double k, double z) {
  const double v = 2.0 / (9.0 * k);
  return k * std::pow(1.0 - v + z * std::sqrt(v), 3.0);
}

/// Some 4300 values are looked at: of honest ones, one in a million is beyond chi-square's 30.66.
constexpr double kWorst = 30.66;
/// Of the 240 means over the IMUs of a scenario, one in a hundred thousand is beyond this many standard deviations.
constexpr double kSurely = 4.26;
constexpr std::array<const char*, 3> kQuantities{"position", "velocity", "attitude"};

/// Each for itself, and all IMUs of the scenario together; fixes make up for initial sigmas that are too large, so that
/// in the end those of position and velocity must not be too large either.
void expect_honest(const std::vector<std::unique_ptr<Unit>>& units) {
  for (std::size_t moment = 0; moment < kMoments_s.size(); ++moment) {
    for (std::size_t quantity = 0; quantity < kQuantities.size(); ++quantity) {
      double sum = 0.0, n = 0.0;
      const std::string what =
          kQuantities[quantity] + std::string(", seconds after the beginning: ") + std::to_string(kMoments_s[moment]);
      for (const auto& unit : units) {
        if (unit->nees.size() <= moment) continue;
        EXPECT_LT(unit->nees[moment][quantity], kWorst) << unit->name << ", " << what;
        sum += unit->nees[moment][quantity];
        n += 1.0;
      }
      if (n == 0.0) continue;
      EXPECT_LT(sum, chi_square(3.0 * n, kSurely)) << "of " << n << " IMUs: " << what;
      const bool is_settled = moment + 1 == kMoments_s.size() && quantity < 2;
      if (is_settled) {
        EXPECT_GT(sum, chi_square(3.0 * n, -kSurely)) << "of " << n << " IMUs: " << what;
      }
    }
  }
}

/// The unit with another initial attitude than the scenario's, run until its filter is known.
std::unique_ptr<Unit> begun_with(const Unit& unit, navigation::InitialAttitude attitude, const nav::RollPitchYaw& rpy,
                                 double longest_s) {
  navigation::AppSetup told = navigation::setup_for(unit.loaded, *unit.loaded.scenario.reference_nav);
  told.parameters.initial.attitude = attitude;
  told.parameters.initial.rpy_deg = Vector3(rpy.roll_rad, rpy.pitch_rad, rpy.yaw_rad) / units::kDeg;
  auto again = std::make_unique<Unit>(unit.name, unit.loaded, told);
  TruthSource source(unit.loaded, {2446, 0}, RunId{});
  double now_s = 0.0;
  while (source.has_next() && !again->is_done() && now_s < longest_s) {
    const TruthState truth = source.take();
    now_s = time::to_seconds(truth.header.sim_time_ns);
    again->take(truth);
  }
  return again;
}

/// What check says of a unit whose filter does not begin, and that what it tells to set makes it begin.
void expect_warned(const Unit& unit, const nav::RollPitchYaw& rpy) {
  SCOPED_TRACE(unit.name);
  const LookAhead ahead = look_ahead(unit.loaded, kLongest_s);
  ASSERT_TRUE(ahead.filter.has_value());
  EXPECT_FALSE(ahead.filter->begins_s.has_value());
  const std::string said = text_of(ahead);
  for (const std::string& why : {unit.navigator.filter().alignment_refusal(), unit.navigator.filter().motion_refusal(),
                                 std::string("'given' and all three angles")}) {
    EXPECT_NE(said.find(why), std::string::npos) << why << "\nis not in\n" << said;
  }
  const auto given = begun_with(unit, navigation::InitialAttitude::Given, rpy, kLongest_s);
  EXPECT_TRUE(given->begun_s && *given->begun_s < 2.0) << "with the attitude given";
  for (const Nees& nees : given->nees) EXPECT_LT(*std::max_element(nees.begin(), nees.end()), kWorst);
  const auto levelled = begun_with(unit, navigation::InitialAttitude::Levelled, rpy, kLongest_s);
  const bool is_offered = said.find("'levelled' and the yaw") != std::string::npos;
  EXPECT_EQ(is_offered, levelled->begun_s.has_value()) << said;
}

class ReferenceFilterBegins : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(ReferenceFilterBegins, OrCheckSaysWhatToSetAndKnowsItsErrors) {
  const scenario::LoadedScenario scenario = scenario::load(GetParam());
  std::vector<std::unique_ptr<Unit>> units = units_of(scenario);
  TruthSource source(units[0]->loaded, {2446, 0}, RunId{});
  const auto is_over = [&] {
    return std::all_of(units.begin(), units.end(), [](const auto& unit) { return unit->is_done(); });
  };
  double now_s = 0.0;
  while (source.has_next() && !is_over() && now_s < kLongest_s) {
    const TruthState truth = source.take();
    now_s = time::to_seconds(truth.header.sim_time_ns);
    for (auto& unit : units) unit->take(truth);
  }
  expect_honest(units);
  std::size_t begun = 0;
  for (const auto& unit : units) {
    if (!unit->begun_s) {
      expect_warned(*unit, unit->first_rpy.value());
    } else if (begun++ == 0) {
      const LookAhead ahead = look_ahead(unit->loaded, kLongest_s);
      ASSERT_TRUE(ahead.filter && ahead.filter->begins_s) << unit->name;
      EXPECT_NEAR(*ahead.filter->begins_s, *unit->begun_s, 1.5 / kRate_hz) << unit->name;
    }
  }
  RecordProperty("begun", std::to_string(begun) + " of " + std::to_string(units.size()));
}

INSTANTIATE_TEST_SUITE_P(Scenarios, ReferenceFilterBegins, testing::ValuesIn(files_of("scenarios")),
                         [](const auto& tested) { return tested.param.stem().string(); });

}  // namespace filter_begins_test
}  // namespace inslab::sim
