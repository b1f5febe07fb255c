#include "inslab/referee/verify/realism.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>

namespace inslab::verify {

namespace {

constexpr double kEitherWayOfCause = 2.0;
/// What the independent simulation found without any cause: horizontal, vertical.
constexpr std::array<double, 2> kFoundWithout_m{0.194, 0.095};

/// One cause: how it comes into a drive, and what it was found to do.
struct Cause {
  const char* name;
  const char* profile_key;
  std::function<void(NavigationSetup& setup)> put_in;
  std::size_t figure;  ///< of kDriftNames: the one it is known for
  double found_m;      ///< by the independent simulation
};

void place_accelerometers(NavigationSetup& setup, double arm_m) {
  Vector9& places = setup.imus.front().errors.accel_place_m;
  for (int axis = 0; axis < 3; ++axis) places[4 * axis] = arm_m;
}

const std::vector<Cause>& causes() {
  constexpr std::size_t kHorizontal = 0, kVertical = 1;
  static const std::vector<Cause> all{
      {"none", "", [](NavigationSetup&) {}, kHorizontal, kFoundWithout_m[kHorizontal]},
      {"GNSS tagged 10 ms late", "time_tag.offset_s",
       [](NavigationSetup& setup) { setup.gnss.time_tag.offset_s = 0.010; }, kHorizontal, 0.738},
      {"accelerometers 2 ms after the gyros", "accel_delay_s",
       [](NavigationSetup& setup) { setup.imus.front().errors.accel_delay_s = 0.002; }, kHorizontal, 0.535},
      {"each accelerometer 1 cm out on its axis", "accel_place_m",
       [](NavigationSetup& setup) { place_accelerometers(setup, 0.01); }, kHorizontal, 0.357},
      {"each accelerometer 3 cm out on its axis", "accel_place_m",
       [](NavigationSetup& setup) { place_accelerometers(setup, 0.03); }, kHorizontal, 0.975},
      {"antenna 3 cm ahead of where the filter has it", "lever_arm_v_m",
       [](NavigationSetup& setup) { setup.antenna_off_v_m.x() = 0.03; }, kHorizontal, 0.272},
      {"fixes whose 2 cm last 115 s", "position_gm_sigma_ned_m",
       [](NavigationSetup& setup) {
         setup.gnss.position_gm_sigma_ned_m.setConstant(0.02);
         setup.gnss.position_gm_correlation_time_s.setConstant(115.0);
       },
       kVertical, 0.157}};
  return all;
}

/// What a cause adds to a drift: root of the difference of squares.
double added(double with_m, double without_m) {
  return std::sqrt(std::max(0.0, with_m * with_m - without_m * without_m));
}

DriftFigures drift_with(const Cause& cause, const OutageRuns& runs, const Subjects& subjects) {
  const auto setup = [&](std::uint64_t seed) {
    NavigationSetup drive = thesis_setup(seed, MotionFrom::Parameters, runs.outages);
    drive.duration_s = runs.duration_s;
    drive.imus.resize(1);
    cause.put_in(drive);
    return drive;
  };
  return drifts(runs.seeds, setup, subjects).front();
}

}  // namespace

Table realism_table(const OutageRuns& runs, const Subjects& subjects) {
  Table table;
  table.title =
      fmt::format("What a real set has besides, one cause at a time: {} in outages of {:g} s ({} seed{})",
                  published_drifts().front().imu, runs.outages.length_s, runs.seeds, runs.seeds == 1 ? "" : "s");
  table.columns = {"cause",   "profile key", "horizontal / vertical m; roll pitch yaw deg", "of it", "adds m",
                   "found m", "ratio"};
  const DriftFigures without = drift_with(causes().front(), runs, subjects);
  for (const Cause& cause : causes()) {
    const bool is_base = &cause == &causes().front();
    const DriftFigures with = is_base ? without : drift_with(cause, runs, subjects);
    const double found_m = is_base ? cause.found_m : added(cause.found_m, kFoundWithout_m[cause.figure]);
    const double share_m = is_base ? with[cause.figure] : added(with[cause.figure], without[cause.figure]);
    const double ratio = share_m / found_m;
    table.rows.push_back(
        {{cause.name, cause.profile_key, text_of(with), kDriftNames[cause.figure], fmt::format("{:.3f}", share_m),
          fmt::format("{:.3f}", found_m), fmt::format("{:.2f}", ratio)},
         ratio >= 1.0 / kEitherWayOfCause && ratio <= kEitherWayOfCause});
  }
  table.notes = {
      "adds: of the figure named beside it what the cause alone adds, root of the difference of squares; of the first "
      "row "
      "the drift itself.",
      "found: by an independent simulation that altered recorded files, in the thesis's protocol. A row holds within a "
      "factor 2 of what was found that the cause adds, either way."};
  return table;
}

}  // namespace inslab::verify
