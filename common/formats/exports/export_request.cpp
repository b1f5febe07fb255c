#include "inslab/formats/exports/export_request.hpp"

#include <stdexcept>

#include "inslab/formats/exports/log_export.hpp"
#include "inslab/formats/novatel/novatel_imu.hpp"

namespace inslab::exports {
namespace {

/// The formats that make one file of one topic, and what the file's name ends in.
struct NamedFormat {
  const char* name;
  FileFormat format;
  const char* ending;
};
constexpr NamedFormat kFileFormats[] = {{"nav", FileFormat::Nav, ".nav"},
                                        {"imu", FileFormat::Imu, "_imu.txt"},
                                        {"gnss", FileFormat::Gnss, "_gnss.txt"},
                                        {"kml", FileFormat::Kml, ".kml"},
                                        {"novatel", FileFormat::Novatel, "_novatel.txt"}};

/// run.mcap gives run_csv, run.h5, run.nav, ..., beside the log.
std::string default_destination(const std::string& log, const std::string& ending) {
  constexpr std::string_view kSuffix = ".mcap";
  std::string stem = log;
  if (stem.size() > kSuffix.size() && stem.compare(stem.size() - kSuffix.size(), kSuffix.size(), kSuffix) == 0) {
    stem.resize(stem.size() - kSuffix.size());
  }
  return stem + ending;
}

Exported export_tables(const ExportRequest& request) {
  const bool is_csv = request.format == "csv";
  const std::string destination =
      request.destination.empty() ? default_destination(request.log, is_csv ? "_csv" : ".h5") : request.destination;
  const ExportFormat format = is_csv ? ExportFormat::Csv : ExportFormat::Hdf5;
  Exported exported;
  for (const ExportedTopic& topic : export_log(request.log, format, destination, request.topics)) {
    if (topic.place.empty()) {
      exported.left_out.push_back(topic.topic + " left out: its type " + topic.type + " is not known");
      continue;
    }
    exported.made.push_back(topic.topic + ": " + std::to_string(topic.rows) + " rows in " +
                            (is_csv ? "" : destination + ":/") + topic.place);
    if (topic.unreadable > 0) {
      exported.left_out.push_back(topic.topic + ": " + std::to_string(topic.unreadable) + " messages are not " +
                                  topic.type + " and were left out");
    }
  }
  return exported;
}

Exported export_one_file(const ExportRequest& request, const NamedFormat& format) {
  if (request.topics.size() > 1) {
    throw std::invalid_argument(std::string("--format ") + format.name + " writes one topic; " +
                                std::to_string(request.topics.size()) + " were given");
  }
  FileExportOptions wanted;
  wanted.format = format.format;
  wanted.destination =
      request.destination.empty() ? default_destination(request.log, format.ending) : request.destination;
  if (!request.topics.empty()) wanted.topic = request.topics.front();
  wanted.novatel_imu_type = request.novatel_imu_type;
  wanted.novatel_axes = request.novatel_axes;
  const ExportedFile file = export_file(request.log, wanted);
  Exported exported;
  exported.made.push_back(file.topic + ": " + std::to_string(file.rows) + " rows in " + wanted.destination);
  if (file.left_out > 0) {
    exported.left_out.push_back(file.topic + ": " + std::to_string(file.left_out) +
                                " samples hold nothing for this format (no interval, fix or solution) and were left "
                                "out");
  }
  if (file.unreadable > 0) {
    exported.left_out.push_back(file.topic + ": " + std::to_string(file.unreadable) +
                                " messages are not what their type says and were left out");
  }
  return exported;
}

}  // namespace

std::vector<std::string> export_formats() {
  std::vector<std::string> names{"csv", "hdf5"};
  for (const NamedFormat& format : kFileFormats) names.emplace_back(format.name);
  return names;
}

Exported export_as(const ExportRequest& request) {
  for (const NamedFormat& format : kFileFormats) {
    if (request.format == format.name) return export_one_file(request, format);
  }
  return export_tables(request);
}

std::string novatel_imu_types_text() {
  std::string text;
  for (const novatel::NovatelImuType& type : novatel::novatel_imu_types()) {
    text += (text.empty() ? "" : ", ") + std::to_string(type.type) + " " + std::string(type.name);
  }
  return text;
}

}  // namespace inslab::exports
