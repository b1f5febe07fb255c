#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace inslab::exports {

enum class ExportFormat { Csv, Hdf5 };

/// What became of one topic.
struct ExportedTopic {
  std::string topic;
  std::string type;
  std::string place;  ///< the CSV file or the HDF5 group; empty when the type is not ours
  std::uint64_t rows = 0;
  std::uint64_t unreadable = 0;  ///< messages that are not what their type says, left out
};

/// Writes the topics of a log as tables (formats/tables/columns.hpp), rows in the order of their log times.
///
/// Csv: `destination` is a folder, made when missing; one file a topic (inslab/imu/0: inslab_imu_0.csv), and
/// metadata.csv. Hdf5: `destination` is a file; one group a topic, the metadata as attributes of the file.
/// `topics`: those wanted; all when empty. Throws ReadError, also when the log has none of that name, and WriteError.
std::vector<ExportedTopic> export_log(const std::string& path, ExportFormat format, const std::string& destination,
                                      const std::vector<std::string>& topics = {});

}  // namespace inslab::exports
