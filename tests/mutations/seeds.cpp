#include "tests/mutations/seeds.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include "inslab/formats/exports/log_export.hpp"
#include "inslab/formats/exports/log_file_export.hpp"
#include "inslab/formats/mcap/mcap_put.hpp"
#include "inslab/formats/mcap/mcap_reader.hpp"
#include "inslab/foundation/files/byte_writer.hpp"
#include "inslab/sim/log_sink.hpp"

namespace inslab::mutations {

namespace {

const std::filesystem::path kSource = INSLAB_SOURCE_DIR;

std::string contents(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

void add_folder(const std::filesystem::path& folder, const std::string& what, std::vector<Seed>& seeds) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    if (file.extension() == ".json") seeds.push_back({file.filename().string(), what, contents(file)});
  }
}

/// Two seconds of the demonstration, and a log of them.
std::string simulated_log(const std::string& folder) {
  scenario::LoadedScenario loaded = scenario::load(kSource / "config/scenarios/demo.json");
  loaded.scenario.duration_s = 2.0;
  loaded.truth_samples = 1 + loaded.truth_grid().index(time::from_seconds(loaded.scenario.duration_s));
  loaded.swaps.clear();
  loaded.scenario.swaps.clear();
  const time::GpsTime start{2401, 36000'000'000'000};
  const std::string path = folder + "/seed.mcap";
  sim::LogSink log(path, loaded, start);
  sim::OfflineRun run(loaded, start, RunId{}, log);
  while (run.step()) continue;
  log.close();
  return path;
}

/// The same log with one chunk as it is, no checksum and no summary.
std::string bare(const std::string& path) {
  const mcap::McapReader log(path);
  std::vector<std::uint8_t> records, out;
  files::ByteWriter in_chunk(records), writer(out);
  std::uint64_t first_ns = ~std::uint64_t{0}, last_ns = 0;
  log.for_each([&](const mcap::Message& message) {
    const std::size_t at = in_chunk.begin_record(mcap::kMessage);
    in_chunk.number(message.channel_id);
    in_chunk.number(message.sequence);
    in_chunk.number(message.log_time_ns);
    in_chunk.number(message.publish_time_ns);
    records.insert(records.end(), message.data, message.data + message.size);
    in_chunk.end_record(at);
    first_ns = std::min(first_ns, message.log_time_ns);
    last_ns = std::max(last_ns, message.log_time_ns);
    return true;
  });
  mcap::put_header("", "inslab", out);
  for (const auto& [id, schema] : log.schemas()) mcap::put_schema(schema, out);
  for (const auto& [id, channel] : log.channels()) mcap::put_channel(channel, out);
  for (const auto& metadata : log.metadata()) {
    const std::size_t at = writer.begin_record(mcap::kMetadata);
    writer.text(metadata.name);
    writer.text_map(metadata.values);
    writer.end_record(at);
  }
  const std::size_t chunk = writer.begin_record(mcap::kChunk);
  writer.number(first_ns);
  writer.number(last_ns);
  writer.number(std::uint64_t{records.size()});
  writer.number(std::uint32_t{0});
  writer.text("");
  writer.number(std::uint64_t{records.size()});
  out.insert(out.end(), records.begin(), records.end());
  writer.end_record(chunk);
  const std::size_t end = writer.begin_record(mcap::kDataEnd);
  writer.number(std::uint32_t{0});
  writer.end_record(end);
  const std::size_t footer = writer.begin_record(mcap::kFooter);
  writer.number(std::uint64_t{0});
  writer.number(std::uint64_t{0});
  writer.number(std::uint32_t{0});
  writer.end_record(footer);
  out.insert(out.end(), mcap::kMagic.begin(), mcap::kMagic.end());
  return std::string(out.begin(), out.end());
}

std::string exported(const std::string& log, const std::string& folder, exports::FileFormat format,
                     const std::string& topic) {
  exports::FileExportOptions options;
  options.format = format;
  options.destination = folder + "/exported";
  options.topic = topic;
  exports::export_file(log, options);
  return contents(options.destination);
}

}  // namespace

std::vector<Seed> scenario_seeds() {
  std::vector<Seed> seeds;
  add_folder(kSource / "config/scenarios", "scenario", seeds);
  return seeds;
}

std::vector<Seed> profile_seeds() {
  std::vector<Seed> seeds;
  add_folder(kSource / "config/profiles/imu", "imu_error", seeds);
  add_folder(kSource / "config/profiles/vibration", "vibration", seeds);
  add_folder(kSource / "config/profiles/installation", "installation", seeds);
  add_folder(kSource / "config/profiles/gnss", "gnss_error", seeds);
  add_folder(kSource / "config/profiles/fault", "fault", seeds);
  add_folder(kSource / "config/nav", "navigation", seeds);
  return seeds;
}

std::vector<Seed> text_seeds(const std::string& folder) {
  const std::string log = simulated_log(folder);
  const std::string imu = exported(log, folder, exports::FileFormat::Imu, "");
  exports::export_log(log, exports::ExportFormat::Csv, folder + "/csv", {"inslab/truth", "inslab/imu/0"});
  const std::string named_imu =
      "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],a_RS_S_x [m s^-2],a_RS_S_y [m "
      "s^-2],a_RS_S_z [m s^-2]\n1403636579758555392,-0.1,0.14,0.01,8.14,-0.37,-2.4\n1403636579763555584,-0.1,0.14,0.03,"
      "8.05,-0.38,-2.47\n1403636579768555520,-0.1,0.15,0.04,8.3,-0.43,-2.28\n1403636579773555456,-0.1,0.15,0.04,8.3,"
      "-0.43,-2.28\n";
  const std::string rtklib =
      "% program : RTKLIB\n%  GPST                  latitude(deg) longitude(deg)  height(m)   Q  ns   sdn(m)   sde(m)  "
      " "
      "sdu(m)  sdne(m)  sdeu(m)  sdun(m) age(s)  ratio\n2024/03/05 10:00:00.000   48.000000000   11.000000000   "
      "500.0000   "
      "1  12   0.0100   0.0100   0.0200   0.0000   0.0000   0.0000   0.50   99.9\n2024/03/05 10:00:01.000   "
      "48.000072000   "
      "11.000000000   500.0000   1  12   0.0100   0.0100   0.0200   0.0000   0.0000   0.0000   0.50   99.9\n";
  return {{"imu.txt", "recording", imu},
          {"euroc.csv", "recording", named_imu},
          {"imu.csv", "recording", contents(folder + "/csv/inslab_imu_0.csv")},
          {"imu.txt", "imu_text", imu},
          {"gnss.txt", "gnss_text", exported(log, folder, exports::FileFormat::Gnss, "")},
          {"gnss.txt", "trajectory", exported(log, folder, exports::FileFormat::Gnss, "")},
          {"truth.nav", "trajectory", exported(log, folder, exports::FileFormat::Nav, "")},
          {"truth.csv", "trajectory", contents(folder + "/csv/inslab_truth.csv")},
          {"solution.pos", "trajectory", rtklib},
          {"receiver.nmea", "trajectory",
           "$GPGGA,235959.50,4807.0380,N,01131.0000,W,4,12,0.8,545.4,M,46.9,M,1.0,0000\n"
           "$GPRMC,235959.50,A,4807.038,N,01131.000,W,0.0,0.0,311223,,\n"
           "$GPGGA,000000.00,4807.0381,N,01131.0000,W,4,12,0.8,545.5,M,46.9,M,1.0,0000\n"},
          {"matrix.csv", "matrix", contents(kSource / "config/scenarios/matrix.csv")},
          {"lines.asc", "novatel", contents(kSource / "tests/fuzz/novatel/rawimusxa.asc")},
          {"gps_2.rnx", "rinex", contents(kSource / "tests/data/gnss/gps_2.rnx")},
          {"glonass_210.rnx", "rinex", contents(kSource / "tests/data/gnss/glonass_210.rnx")},
          {"mixed_305.rnx", "rinex", contents(kSource / "tests/data/gnss/mixed_305.rnx")},
          {"mixed_400.rnx", "rinex", contents(kSource / "tests/data/gnss/mixed_400.rnx")},
          {"two_epochs.sp3", "orbits", contents(kSource / "tests/data/gnss/two_epochs.sp3")}};
}

std::vector<Seed> import_seeds() {
  const std::string kf_gins =
      "# Noise modeling parameters of IMU\nimunoise:\n  arw: [0.003, 0.003, 0.003]\n  vrw: [0.03, 0.03, 0.03]\n"
      "  gbstd: [0.027, 0.027, 0.027]\n  abstd: [15.0, 15.0, 15.0]\n  gsstd: [300.0, 300.0, 300.0]\n"
      "  asstd: [300.0, 300.0, 300.0]\n  corrtime: 4.0\ninitgyrbias: [0, 0, 0]\n";
  const std::string gnss_ins_sim =
      "# another program's dictionary\nimu_err = {'gyro_b': np.array([0.0, 0.0, 0.0]),\n"
      "  'gyro_arw': np.array([0.25, 0.25, 0.25]) * 1.0,\n  'gyro_b_stability': np.array([3.5, 3.5, 3.5]),\n"
      "  'gyro_b_corr': np.array([100.0, 100.0, 100.0]),\n  'accel_b': np.array([0.0e-3, 0.0e-3, 0.0e-3]),\n"
      "  'accel_vrw': np.array([0.03119, 0.03009, 0.04779]),\n  'accel_b_stability': np.array([4.29e-5, 5.72e-5, "
      "8.02e-5]),\n  'accel_b_corr': np.array([200.0, 200.0, 200.0]),\n  'mag_std': np.array([0.2, 0.2, 0.2])\n}\n";
  std::string gazebo =
      "<?xml version=\"1.0\"?>\n<sdf version=\"1.6\"><model name=\"m\"><link name=\"l\"><sensor name=\"imu\" "
      "type=\"imu\">\n<update_rate>200</update_rate><imu>\n";
  for (const char* quantity : {"angular_velocity", "linear_acceleration"}) {
    gazebo += std::string("<") + quantity + ">";
    for (const char* axis : {"x", "y", "z"}) {
      gazebo +=
          std::string("<") + axis +
          "><noise type=\"gaussian\"><mean>0</mean><stddev>0.0002</stddev><bias_mean>0.0000075</bias_mean>"
          "<bias_stddev>0.0000008</bias_stddev><dynamic_bias_stddev>0.0000004</dynamic_bias_stddev>"
          "<dynamic_bias_correlation_time>400</dynamic_bias_correlation_time><precision>0.0</precision></noise></" +
          axis + ">\n";
    }
    gazebo += std::string("</") + quantity + ">";
  }
  gazebo += "</imu></sensor></link></model></sdf>\n";
  return {{"kf-gins.yaml", "kf-gins", kf_gins},
          {"gnss-ins-sim.py", "gnss-ins-sim", gnss_ins_sim},
          {"model.sdf", "gazebo", gazebo}};
}

std::vector<Seed> log_seeds(const std::string& folder) {
  const std::string log = simulated_log(folder);
  return {{"run.mcap", "log", contents(log)}, {"bare.mcap", "log", bare(log)}};
}

}  // namespace inslab::mutations
