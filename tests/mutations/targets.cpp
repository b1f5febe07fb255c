#include "tests/mutations/targets.hpp"

#include <filesystem>

#include "inslab/data/json/json_text.hpp"
#include "inslab/formats/exports/log_export.hpp"
#include "inslab/formats/exports/log_file_export.hpp"
#include "inslab/formats/log/log_info.hpp"
#include "inslab/formats/novatel/novatel_imu.hpp"
#include "inslab/formats/profile_import/conversion.hpp"
#include "inslab/formats/recordings/gnss_text.hpp"
#include "inslab/formats/recordings/imu_recording.hpp"
#include "inslab/formats/rinex/precise_orbits.hpp"
#include "inslab/formats/trajectory/trajectory_judge.hpp"
#include "inslab/formats/trajectory/trajectory_repair.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/models/navigation/parameters_file.hpp"
#include "inslab/referee/calibrate/profile_file.hpp"
#include "inslab/referee/navigate/offline_filter.hpp"
#include "inslab/referee/report/report_files.hpp"
#include "inslab/scenario/document_kind.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/scenario/motion_matrix.hpp"
#include "inslab/sim/navigation_files.hpp"
#include "inslab/sim/offline_run.hpp"

namespace inslab::mutations {

namespace {

/// Takes what comes and forgets it.
class Nothing : public sim::RunSink {
 public:
  void journal(const catalog::AnyProfile&) override {}
  void truth(const TruthState&) override {}
  void imu(std::size_t, const ImuSample&, const ImuTruth&) override {}
  void gnss(std::size_t, const GnssFix&) override {}
  void ack(const ProfileAck&) override {}
};

/// What was accepted must run: a few of its samples.
void run_scenario(const std::string& path) {
  constexpr int kSteps = 20;
  const scenario::LoadedScenario loaded = scenario::load(path);
  if (loaded.scenario.trajectory.source == scenario::TrajectorySource::VehicleState) return;
  Nothing nothing;
  sim::OfflineRun run(loaded, loaded.start(time::Nanoseconds(1'800'000'000'000'000'000)), RunId{}, nothing);
  try {
    for (int i = 0; i < kSteps && run.step(); ++i) continue;
  } catch (const std::domain_error& error) {  // as inslab simulate says it
    throw std::domain_error(path + ": " + error.what());
  }
}

void read_profile(const std::string& path, const std::string& what) {
  if (what == "navigation") {
    navigation::read_parameters(path);
    return;
  }
  const ProfileKind kind = scenario::profile_kind_named(what).value();
  const SensorKind sensor = kind == ProfileKind::GnssError ? SensorKind::Gnss : SensorKind::Imu;
  scenario::load_profile(path, kind, {sensor, 0});
}

void read_trajectory(const std::string& path) {
  trajectory::TrajectoryReading reading = trajectory::read_trajectory(path, {"", "inslab/truth", false});
  if (reading.file.rows.size() < 2) return;
  const TrajectoryLimits limits;
  trajectory::judge_trajectory(reading, limits, false);
  if (!reading.file.rows.front().v_n || !reading.file.rows.front().rpy) return;
  std::vector<trajectory::RepairNote> notes;
  trajectory::repaired(reading, limits, trajectory::RepairBounds{}, notes);
}

void read_text(const std::string& path, const std::string& what) {
  if (what == "trajectory") read_trajectory(path);
  if (what == "matrix") scenario::read_motion_matrix(path);
  if (what == "rinex") sim::load_navigation_files({path});
  if (what == "orbits") rinex::read_precise_orbits(path);
  if (what == "recording") {
    recordings::read_imu_recording(
        path, {}, [](const recordings::ImuRecordingInfo&) {}, [](const recordings::ImuIncrements&) {});
  }
  if (what == "imu_text") navigate::for_each_text_sample(path, 2401, [](const ImuSample&) {});
  if (what == "gnss_text") {
    recordings::GnssTextReader reader(path);
    for (recordings::GnssTextRecord record; reader.next(record);) continue;
  }
  if (what == "novatel") {
    novatel::NovatelImuReader reader(path);
    for (novatel::NovatelImuRecord record; reader.next(record);) continue;
  }
}

void import(const std::string& path, const std::string& what) {
  const profile_import::ImportOptions options{200.0, ""};
  const profile_import::ImportedProfile imported = what == "kf-gins" ? profile_import::import_kf_gins(path, options)
                                                   : what == "gazebo"
                                                       ? profile_import::import_gazebo(path, options)
                                                       : profile_import::import_gnss_ins_sim(path, options);
  calibrate::profile_text(imported.profile);
}

void read_log(const std::string& path, const std::string& folder) {
  log::inspect_log(path);
  const mcap::McapReader log(path);
  const report::ReportData data = report::report_data(log);
  report::report_text(data);
  json::json_text(report::report_json(data));
  exports::export_log(path, exports::ExportFormat::Csv, folder + "/tables", {});
  for (const exports::FileFormat format :
       {exports::FileFormat::Nav, exports::FileFormat::Imu, exports::FileFormat::Gnss, exports::FileFormat::Kml}) {
    exports::FileExportOptions options;
    options.format = format;
    options.destination = folder + "/out";
    exports::export_file(path, options);
  }
  trajectory::read_trajectory(path, {"", "inslab/truth", false});
}

}  // namespace

void read(const std::string& path, const Seed& seed, const std::string& folder) {
  if (seed.what == "scenario") {
    run_scenario(path);
  } else if (seed.what == "log") {
    read_log(path, folder);
  } else if (seed.what == "kf-gins" || seed.what == "gazebo" || seed.what == "gnss-ins-sim") {
    import(path, seed.what);
  } else if (scenario::profile_kind_named(seed.what) || seed.what == "navigation") {
    read_profile(path, seed.what);
  } else {
    read_text(path, seed.what);
  }
}

}  // namespace inslab::mutations
