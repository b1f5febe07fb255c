#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>

#include "inslab/formats/tables/picture.hpp"
#include "inslab/foundation/files/error.hpp"
#include "inslab/foundation/files/output_file.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/referee/evidence/tell.hpp"
#include "inslab/referee/predict/expected_errors.hpp"
#include "inslab/services/inslab/commands/commands.hpp"
#include "inslab/sim/offline_run.hpp"

namespace inslab::cli {
namespace {

constexpr std::size_t kTableRows = 12;

struct PredictOptions {
  std::string scenario;
  std::string directory = ".";
  std::uint32_t sensor_number = 0;
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;
  double tilt_deg = 0.0;
  double yaw_deg = 0.0;
  bool hold_vertical = false;
  bool free_inertial = false;
};

predict::PredictedError start_of(const PredictOptions& options) {
  predict::PredictedError start;
  start.position_n_m.setConstant(options.position_m);
  start.velocity_n_m_per_s.setConstant(options.velocity_m_per_s);
  start.attitude_n_rad << options.tilt_deg / units::kDegPerRad, options.tilt_deg / units::kDegPerRad,
      options.yaw_deg / units::kDegPerRad;
  return start;
}

std::vector<AnyProfile> profiles_of(const scenario::LoadedScenario& loaded) {
  std::vector<AnyProfile> profiles;
  for_each_sensor(loaded, [&profiles](auto kind, const auto& sensor) {
    for_each_profile(kind, sensor, [&profiles](const auto& profile) { profiles.emplace_back(profile); });
  });
  profiles.insert(profiles.end(), loaded.swaps.begin(), loaded.swaps.end());
  return profiles;
}

/// What a run lets one expect, and when it has no fixes.
struct Prediction {
  predict::ExpectedErrors errors;
  std::vector<io::Band> outages = {};
};

class PredictionSink : public RunSink {
 public:
  PredictionSink(Prediction& prediction, const scenario::LoadedScenario& loaded, bool uses_fixes)
      : prediction_(prediction) {
    if (uses_fixes) longest_s_ = 1.5 * loaded.gnss.front().rate.period_s();
  }
  void journal(const AnyProfile&) override {}
  void truth(const TruthState&) override {}
  void imu(std::size_t, const ImuSample&, const ImuTruth& truth) override { prediction_.errors.add(truth); }
  void gnss(std::size_t index, const GnssFix& fix) override {
    prediction_.errors.add(fix);
    if (index == 0 && fix.fix_type != FixType::None) end_gap(static_cast<double>(fix.header.sim_time_ns) * 1e-9);
  }
  void ack(const ProfileAck&) override {}

  /// The next fix, or the end of the run.
  void end_gap(double time_s) {
    if (longest_s_ && time_s - last_fix_s_ > *longest_s_) prediction_.outages.push_back({last_fix_s_, time_s});
    last_fix_s_ = time_s;
  }

 private:
  Prediction& prediction_;
  std::optional<double> longest_s_;  ///< between fixes in a row; nothing: there are none
  double last_fix_s_ = 0.0;
};

Prediction predicted(const scenario::LoadedScenario& loaded, const PredictOptions& options) {
  if (loaded.scenario.trajectory.source == scenario::TrajectorySource::VehicleState) {
    throw io::ReadError(loaded.file.string() + ": follows a live vehicle, whose motion is not known beforehand");
  }
  predict::ExpectedErrors::Setup setup;
  setup.gravity = loaded.gravity();
  setup.imu_number = loaded.sensor<catalog::Imu>(options.sensor_number).number;
  const bool uses_fixes = !options.free_inertial && !loaded.gnss.empty();
  if (uses_fixes) setup.gnss_number = loaded.gnss.front().number;
  setup.start = start_of(options);
  setup.vertical = options.hold_vertical ? predict::Vertical::Held : predict::Vertical::Free;
  Prediction prediction{predict::ExpectedErrors(setup, profiles_of(loaded))};
  PredictionSink sink(prediction, loaded, uses_fixes);
  OfflineRun run(loaded, loaded.start(app::realtime_now()), RunId{}, sink);
  while (run.step()) {
  }
  sink.end_gap(time::to_seconds(run.sim_time()));
  return prediction;
}

using Figures = std::array<double, 10>;

Figures figures(const predict::PredictedError& error) {
  const nav::Vector3 attitude_deg = error.attitude_n_rad * units::kDegPerRad;
  const nav::Vector3 &r = error.position_n_m, &v = error.velocity_n_m_per_s;
  return {error.time_s, r.x(), r.y(), r.z(), v.x(), v.y(), v.z(), attitude_deg.x(), attitude_deg.y(), attitude_deg.z()};
}

void write(const std::string& path, const std::string& text) {
  io::write_file(path, text);
  tell("{} written\n", path);
}

std::string csv(const std::vector<predict::PredictedError>& errors) {
  std::string text =
      "time_s,position_north_m,position_east_m,position_down_m,velocity_north_m_per_s,velocity_east_m_per_s,"
      "velocity_down_m_per_s,phi_north_deg,phi_east_deg,phi_down_deg\n";
  for (const predict::PredictedError& error : errors) {
    text += fmt::format("{:.9g}\n", fmt::join(figures(error), ","));
  }
  return text;
}

std::string table(const std::vector<predict::PredictedError>& errors) {
  std::string text = fmt::format("{:>9}  {:>32}  {:>29}  {:>29}\n", "time, s", "position N E D, m",
                                 "velocity N E D, m/s", "phi N E D, deg");
  const std::size_t stride = std::max<std::size_t>(1, (errors.size() - 1) / kTableRows);
  for (std::size_t k = 0; k < errors.size(); k += stride) {
    const Figures f = figures(errors[k]);
    text +=
        fmt::format("{:>9.1f}  {:>10.3f} {:>10.3f} {:>10.3f}  {:>9.4f} {:>9.4f} {:>9.4f}  {:>9.5f} {:>9.5f} {:>9.5f}\n",
                    f[0], f[1], f[2], f[3], f[4], f[5], f[6], f[7], f[8], f[9]);
  }
  return text;
}

io::Picture picture_of(const Prediction& prediction, const scenario::Scenario& scenario) {
  const std::array<const char*, 3> quantities{"position (m)", "velocity (m/s)", "phi angle (deg)"};
  const std::array<const char*, 3> axes{"north", "east", "down"};
  io::Picture picture;
  picture.title = scenario.name + ": expected errors, 1 sigma";
  picture.panel_width_px = 900;
  for (std::size_t quantity = 0; quantity < 3; ++quantity) {
    io::Panel panel;
    panel.x_label = quantity == 2 ? "sim time (s)" : "";
    panel.log_y = panel.tight_x = true;
    panel.has_key = quantity == 2;
    panel.y_label = quantities[quantity];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      io::Curve curve;
      curve.title = axes[axis];
      for (const predict::PredictedError& error : prediction.errors.curve()) {
        curve.x.push_back(error.time_s);
        curve.y.push_back(figures(error)[1 + 3 * quantity + axis]);
      }
      constexpr std::size_t kBins = 1000;
      panel.curves.push_back(io::thinned_by_logarithm(curve, kBins));
    }
    panel.bands = prediction.outages;
    for (const scenario::ScheduledSwap& swap : scenario.swaps) panel.marks.push_back(swap.at_s);
    picture.panels.push_back(panel);
  }
  return picture;
}

std::string heading(const scenario::LoadedScenario& loaded, const PredictOptions& options) {
  const bool has_fixes = !options.free_inertial && !loaded.gnss.empty();
  return fmt::format("{}: {} with imu {}, {}, 1 sigma", loaded.scenario.name,
                     has_fixes ? fmt::format("the best filter of the fixes of gnss {}", loaded.gnss.front().number)
                               : std::string("free inertial navigation"),
                     options.sensor_number, options.hold_vertical ? "height held" : "height free");
}

int run_predict(const PredictOptions& options) {
  const scenario::LoadedScenario loaded = scenario::load(options.scenario);
  const Prediction prediction = predicted(loaded, options);
  const std::vector<predict::PredictedError>& errors = prediction.errors.curve();
  if (errors.empty()) return app::kFailed;
  const std::vector<std::string> left_out = prediction.errors.left_out();
  tell("{}\n\n{}\n", heading(loaded, options), table(errors));
  if (!left_out.empty()) tell("left out: {}\n", fmt::join(left_out, ", "));
  std::filesystem::create_directories(options.directory);
  const std::string stem = (std::filesystem::path(options.directory) / (loaded.scenario.name + "_predicted")).string();
  write(stem + ".csv", csv(errors));
  write(stem + ".svg", io::drawn(picture_of(prediction, loaded.scenario), io::PictureFormat::Svg));
  return app::kOk;
}

}  // namespace

void add_predict(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<PredictOptions>();
  CLI::App* command = app.add_subcommand(kPredict.name, kPredict.purpose);
  command->add_option("scenario", options->scenario, "scenario file (JSON)")->required();
  command->add_option("-o,--output", options->directory, "folder for NAME_predicted.csv and .svg")
      ->capture_default_str();
  command->add_option("--sensor", options->sensor_number, "the IMU's number")->capture_default_str();
  const auto sigma = [command](const char* name, double& value, const char* meaning) {
    command->add_option(name, value, meaning)->check(CLI::NonNegativeNumber)->capture_default_str();
  };
  sigma("--position", options->position_m, "sigma of each axis at the start, m");
  sigma("--velocity", options->velocity_m_per_s, "sigma of each axis at the start, m/s");
  sigma("--tilt", options->tilt_deg, "sigma of roll and pitch at the start, deg");
  sigma("--yaw", options->yaw_deg, "sigma of yaw at the start, deg");
  command->add_flag("--free-inertial", options->free_inertial, "without the fixes of the scenario's first receiver");
  command->add_flag("--hold-vertical", options->hold_vertical, "height and vertical velocity are known");
  add_overwrite(*command);
  command->callback([options, &action] { action = [options] { return run_predict(*options); }; });
}

}  // namespace inslab::cli
