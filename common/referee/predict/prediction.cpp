#include "inslab/referee/predict/prediction.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/sim/offline_run.hpp"

namespace inslab::predict {
namespace {

constexpr std::size_t kTableRows = 12;

PredictedError start_of(const PredictionOptions& options) {
  PredictedError start;
  start.position_n_m.setConstant(options.position_m);
  start.velocity_n_m_per_s.setConstant(options.velocity_m_per_s);
  start.attitude_n_rad << options.tilt_deg / units::kDegPerRad, options.tilt_deg / units::kDegPerRad,
      options.yaw_deg / units::kDegPerRad;
  return start;
}

std::vector<catalog::AnyProfile> profiles_of(const scenario::LoadedScenario& loaded) {
  std::vector<catalog::AnyProfile> profiles;
  for_each_sensor(loaded, [&profiles](auto kind, const auto& sensor) {
    for_each_profile(kind, sensor, [&profiles](const auto& profile) { profiles.emplace_back(profile); });
  });
  profiles.insert(profiles.end(), loaded.swaps.begin(), loaded.swaps.end());
  return profiles;
}

class PredictionSink : public sim::RunSink {
 public:
  PredictionSink(Prediction& prediction, const scenario::LoadedScenario& loaded, bool uses_fixes)
      : prediction_(prediction) {
    if (uses_fixes) longest_s_ = 1.5 * loaded.gnss.front().rate.period_s();
  }
  void journal(const catalog::AnyProfile&) override {}
  void truth(const TruthState&) override {}
  void imu(std::size_t, const ImuSample&, const ImuTruth& truth) override { prediction_.errors.add(truth); }
  void gnss(std::size_t index, const GnssFix& fix) override {
    prediction_.errors.add(fix);
    if (index == 0 && fix.fix_type != FixType::None) end_gap(time::to_seconds(fix.header.sim_time_ns));
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

using Figures = std::array<double, 10>;

Figures figures(const PredictedError& error) {
  const nav::Vector3 attitude_deg = error.attitude_n_rad * units::kDegPerRad;
  const nav::Vector3 &r = error.position_n_m, &v = error.velocity_n_m_per_s;
  return {error.time_s, r.x(), r.y(), r.z(), v.x(), v.y(), v.z(), attitude_deg.x(), attitude_deg.y(), attitude_deg.z()};
}

}  // namespace

Prediction predicted(const scenario::LoadedScenario& loaded, const PredictionOptions& options) {
  if (loaded.scenario.trajectory.source == scenario::TrajectorySource::VehicleState) {
    throw files::ReadError(loaded.file.string() + ": follows a live vehicle, whose motion is not known beforehand");
  }
  ExpectedErrors::Setup setup;
  setup.gravity = loaded.gravity();
  setup.imu_number = loaded.sensor<catalog::Imu>(options.sensor_number).number;
  const bool uses_fixes = !options.free_inertial && !loaded.gnss.empty();
  if (uses_fixes) setup.gnss_number = loaded.gnss.front().number;
  setup.start = start_of(options);
  setup.vertical = options.hold_vertical ? Vertical::Held : Vertical::Free;
  if (const auto along_way = loaded.gravity_along_way()) {
    setup.gravity_errors = GravityErrors{*along_way, options.plumb_line};
  }
  Prediction prediction{ExpectedErrors(setup, profiles_of(loaded))};
  PredictionSink sink(prediction, loaded, uses_fixes);
  sim::OfflineRun run(loaded, loaded.start(host::realtime_now()), RunId{}, sink);
  while (run.step()) {
  }
  sink.end_gap(time::to_seconds(run.sim_time()));
  return prediction;
}

std::string csv_text(const std::vector<PredictedError>& errors) {
  std::string text =
      "time_s,position_north_m,position_east_m,position_down_m,velocity_north_m_per_s,velocity_east_m_per_s,"
      "velocity_down_m_per_s,phi_north_deg,phi_east_deg,phi_down_deg\n";
  for (const PredictedError& error : errors) {
    text += fmt::format("{:.9g}\n", fmt::join(figures(error), ","));
  }
  return text;
}

std::string table_text(const std::vector<PredictedError>& errors) {
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

tables::Picture picture_of(const Prediction& prediction, const scenario::Scenario& scenario) {
  const std::array<const char*, 3> quantities{"position (m)", "velocity (m/s)", "phi angle (deg)"};
  const std::array<const char*, 3> axes{"north", "east", "down"};
  tables::Picture picture;
  picture.title = scenario.name + ": expected errors, 1 sigma";
  picture.panel_width_px = 900;
  for (std::size_t quantity = 0; quantity < 3; ++quantity) {
    tables::Panel panel;
    panel.x_label = quantity == 2 ? "sim time (s)" : "";
    panel.log_y = panel.tight_x = true;
    panel.has_key = quantity == 2;
    panel.y_label = quantities[quantity];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      tables::Curve curve;
      curve.title = axes[axis];
      for (const PredictedError& error : prediction.errors.curve()) {
        curve.x.push_back(error.time_s);
        curve.y.push_back(figures(error)[1 + 3 * quantity + axis]);
      }
      constexpr std::size_t kBins = 1000;
      panel.curves.push_back(tables::thinned_by_logarithm(curve, kBins));
    }
    panel.bands = prediction.outages;
    for (const scenario::ScheduledSwap& swap : scenario.swaps) panel.marks.push_back(swap.at_s);
    picture.panels.push_back(panel);
  }
  return picture;
}

std::string heading(const scenario::LoadedScenario& loaded, const PredictionOptions& options) {
  const bool has_fixes = !options.free_inertial && !loaded.gnss.empty();
  return fmt::format("{}: {} with imu {}, {}, 1 sigma", loaded.scenario.name,
                     has_fixes ? fmt::format("the best filter of the fixes of gnss {}", loaded.gnss.front().number)
                               : std::string("free inertial navigation"),
                     options.sensor_number, options.hold_vertical ? "height held" : "height free");
}

}  // namespace inslab::predict
