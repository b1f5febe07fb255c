#include "inslab/formats/exports/log_file_export.hpp"

#include <filesystem>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/formats/log/log_topic.hpp"
#include "inslab/formats/log/logged_state.hpp"
#include "inslab/formats/recordings/gnss_text.hpp"
#include "inslab/formats/recordings/imu_text.hpp"
#include "inslab/formats/recordings/kml.hpp"
#include "inslab/formats/recordings/nav_text.hpp"

namespace inslab::exports {

namespace {

/// The topic that was asked for, or the only one of the type.
template <class T>
std::string only_topic(const mcap::McapReader& log, const std::string& asked) {
  if (!asked.empty()) return asked;
  std::string found;
  for (const auto& [id, channel] : log.channels()) {
    if (log::channels_of(log, channel.topic, catalog::WireType<T>::name).empty() || channel.topic == found) continue;
    if (!found.empty()) {
      throw files::ReadError(log.path() + ": has " + found + " and " + channel.topic + "; expected to be told which");
    }
    found = channel.topic;
  }
  if (!found.empty()) return found;
  throw files::ReadError(log.path() + ": has no topic of the type " + std::string(catalog::WireType<T>::name) +
                         "; it has " + log::topics_text(log));
}

/// `write(sample)` is false for a sample that holds nothing for the format.
template <class T, class Write>
void export_topic(const mcap::McapReader& log, ExportedFile& result, Write write) {
  result.unreadable = log::for_each_sample<T>(log, result.topic, [&](const T& sample, std::uint64_t) {
    ++(write(sample) ? result.rows : result.left_out);
    return true;
  });
}

/// `write(state)` for the truth or the solutions of the topic.
template <class Write>
void export_states(const mcap::McapReader& log, ExportedFile& result, Write write) {
  const auto write_if_any = [&](const auto& sample) {
    const log::LoggedState state = log::state_of(sample);
    if (!state.is_solution || !state.in_range()) return false;
    write(state);
    return true;
  };
  if (!log::channels_of(log, result.topic, catalog::WireType<NavSolution>::name).empty()) {
    export_topic<NavSolution>(log, result, write_if_any);
  } else {
    export_topic<TruthState>(log, result, write_if_any);
  }
}

void export_nav(const mcap::McapReader& log, const std::string& destination, ExportedFile& result) {
  recordings::NavTextWriter out(destination);
  export_states(log, result, [&](const log::LoggedState& state) { out.write(state.gps, state.row()); });
  out.close();
}

void export_kml(const mcap::McapReader& log, const std::string& destination, ExportedFile& result) {
  recordings::KmlTrack track;
  export_states(log, result, [&](const log::LoggedState& state) { track.add(state.position); });
  if (track.size() == 0) throw files::ReadError(log.path() + ": " + result.topic + " has no position to draw");
  track.write(destination, std::filesystem::path(log.path()).filename().string() + ": " + result.topic);
}

void export_imu(const mcap::McapReader& log, const std::string& destination, ExportedFile& result) {
  recordings::ImuTextWriter out(destination);
  export_topic<ImuSample>(log, result, [&](const ImuSample& sample) {
    if (sample.interval_ns == 0) return false;
    out.write({time::Nanoseconds(sample.header.gps_time_of_week_ns), sample.dtheta_b, sample.dv_b});
    return true;
  });
  out.close();
}

void export_gnss(const mcap::McapReader& log, const std::string& destination, ExportedFile& result) {
  recordings::GnssTextWriter out(destination);
  export_topic<GnssFix>(log, result, [&](const GnssFix& fix) {
    if (fix.fix_type == FixType::None) return false;
    out.write({time::Nanoseconds(fix.header.gps_time_of_week_ns), geodetic_of(fix), fix.position_sigma_ned_m});
    return true;
  });
  out.close();
}

void export_novatel(const mcap::McapReader& log, const FileExportOptions& options, ExportedFile& result) {
  novatel::NovatelImuFormatter format(options.novatel_imu_type, options.novatel_axes);
  const std::int64_t interval_ns = time::from_seconds(1.0 / format.type().rate_hz).count();
  files::TextWriter out(options.destination, "");
  export_topic<ImuSample>(log, result, [&](const ImuSample& sample) {
    if (sample.interval_ns == 0) return false;
    // Where the period is no whole number of nanoseconds, intervals differ by one.
    if (std::abs(sample.interval_ns - interval_ns) > 1) {
      // The lines do not say their interval: a reader takes it from the type.
      throw std::invalid_argument("IMU type " + std::to_string(options.novatel_imu_type) + " puts out a sample each " +
                                  std::to_string(interval_ns) + " ns, " + result.topic + " each " +
                                  std::to_string(sample.interval_ns) + " ns; expected a type of that rate");
    }
    out.text(format.line({sample.header.gps_week, sample.header.gps_time_of_week_ns}, sample.dtheta_b, sample.dv_b));
    out.end_line();
    return true;
  });
  out.close();
}

}  // namespace

ExportedFile export_file(const std::string& path, const FileExportOptions& options) {
  const mcap::McapReader log(path);
  ExportedFile result;
  switch (options.format) {
    case FileFormat::Nav:
    case FileFormat::Kml:
      result.topic = options.topic.empty() ? catalog::kTruth.name : options.topic;
      break;
    case FileFormat::Imu:
    case FileFormat::Novatel:
      result.topic = only_topic<ImuSample>(log, options.topic);
      break;
    case FileFormat::Gnss:
      result.topic = only_topic<GnssFix>(log, options.topic);
      break;
  }
  switch (options.format) {
    case FileFormat::Nav:
      export_nav(log, options.destination, result);
      break;
    case FileFormat::Kml:
      export_kml(log, options.destination, result);
      break;
    case FileFormat::Imu:
      export_imu(log, options.destination, result);
      break;
    case FileFormat::Gnss:
      export_gnss(log, options.destination, result);
      break;
    case FileFormat::Novatel:
      export_novatel(log, options, result);
      break;
  }
  return result;
}

}  // namespace inslab::exports
