#include "inslab/formats/exports/log_export.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <system_error>

#include "inslab/formats/log/log_types.hpp"
#include "inslab/formats/mcap/mcap_reader.hpp"
#include "inslab/formats/tables/csv_writer.hpp"
#include "inslab/formats/tables/hdf5_writer.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/unfinished.hpp"

namespace inslab::exports {
namespace {

/// Where the tables go.
class Destination {
 public:
  virtual ~Destination() = default;
  /// Returns the number of the table; `place` is where it lies.
  virtual std::size_t add_table(const std::string& topic, const log::LogType& type, std::string& place) = 0;
  virtual void row(std::size_t table, const tables::Row& cells) = 0;
  virtual void metadata(const std::vector<mcap::Metadata>& metadata) = 0;
  virtual void close() = 0;
};

/// The topic as a name that stays inside the destination whatever the log says: letters, digits, _ and -, and
/// `separator` for the slashes between levels.
std::string safe_name(const std::string& topic, char separator) {
  std::string name;
  for (const char c : topic) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    if (c == '/') {
      if (!name.empty() && name.back() != separator) name += separator;
    } else {
      name += plain ? c : '_';
    }
  }
  while (!name.empty() && name.back() == '/') name.pop_back();
  return name.empty() ? "topic" : name;
}

/// Names that are taken; of each the number that the next one like it tries first.
using TakenNames = std::map<std::string, int>;

/// `name`, or `name`_2, _3, ... when it is taken.
std::string free_name(const std::string& name, TakenNames& taken) {
  if (taken.emplace(name, 2).second) return name;
  int& next = taken[name];
  while (true) {
    std::string candidate = name + "_" + std::to_string(next++);
    if (taken.emplace(candidate, 2).second) return candidate;
  }
}

class CsvFolder : public Destination {
 public:
  explicit CsvFolder(const std::string& folder) : folder_(folder) {
    std::error_code error;
    if (!std::filesystem::exists(folder_, error)) made_.emplace(folder);
    std::filesystem::create_directories(folder_, error);
    if (error) throw files::WriteError(folder, "create the folder", error.value());
  }

  std::size_t add_table(const std::string& topic, const log::LogType& type, std::string& place) override {
    place = (folder_ / (free_name(safe_name(topic, '_'), taken_) + ".csv")).string();
    tables_.push_back(std::make_unique<tables::CsvWriter>(place, type.columns));
    return tables_.size() - 1;
  }
  void row(std::size_t table, const tables::Row& cells) override { tables_[table]->row(cells); }
  void metadata(const std::vector<mcap::Metadata>& metadata) override {
    const std::vector<tables::Column> columns{{"name", "", tables::ColumnKind::Text},
                                              {"key", "", tables::ColumnKind::Text},
                                              {"value", "", tables::ColumnKind::Text}};
    tables_.push_back(std::make_unique<tables::CsvWriter>((folder_ / "metadata.csv").string(), columns));
    for (const mcap::Metadata& record : metadata) {
      for (const auto& [key, value] : record.values) tables_.back()->row({record.name, key, value});
    }
  }
  void close() override {
    const auto together = files::hold_unfinished();
    for (const auto& table : tables_) table->close();
    made_.reset();
  }

 private:
  std::filesystem::path folder_;
  std::optional<files::UnfinishedFile> made_;
  TakenNames taken_{{"metadata", 2}};
  std::vector<std::unique_ptr<tables::CsvWriter>> tables_;
};

class Hdf5File : public Destination {
 public:
  explicit Hdf5File(const std::string& path) : file_(path) {}

  std::size_t add_table(const std::string& topic, const log::LogType& type, std::string& place) override {
    place = free_name(safe_name(topic, '/'), taken_);
    tables_.push_back(&file_.add_table(place, topic, type.name, type.columns));
    return tables_.size() - 1;
  }
  void row(std::size_t table, const tables::Row& cells) override { tables_[table]->row(cells); }
  void metadata(const std::vector<mcap::Metadata>& metadata) override {
    TakenNames taken;
    for (const mcap::Metadata& record : metadata) {
      for (const auto& [key, value] : record.values) file_.attribute(free_name(record.name + "." + key, taken), value);
    }
  }
  void close() override { file_.close(); }

 private:
  tables::Hdf5Writer file_;
  TakenNames taken_;
  std::vector<tables::Hdf5Writer::Table*> tables_;
};

std::unique_ptr<Destination> open_destination(ExportFormat format, const std::string& destination) {
  if (format == ExportFormat::Csv) return std::make_unique<CsvFolder>(destination);
  return std::make_unique<Hdf5File>(destination);
}

void require_topics(const mcap::McapReader& log, const std::vector<std::string>& topics) {
  for (const std::string& topic : topics) {
    const auto& channels = log.channels();
    if (std::any_of(channels.begin(), channels.end(), [&](const auto& c) { return c.second.topic == topic; })) continue;
    std::string known;
    for (const auto& [id, channel] : channels) known += (known.empty() ? "" : ", ") + channel.topic;
    throw files::ReadError(log.path() + ": has no topic " + topic + "; it has " + (known.empty() ? "none" : known));
  }
}

}  // namespace

std::vector<ExportedTopic> export_log(const std::string& path, ExportFormat format, const std::string& destination,
                                      const std::vector<std::string>& topics) {
  const mcap::McapReader log(path);
  require_topics(log, topics);
  const std::unique_ptr<Destination> out = open_destination(format, destination);

  struct Target {
    const log::LogType* type;
    std::size_t table;
    ExportedTopic result;
  };
  std::map<std::uint16_t, Target> targets;
  std::set<std::uint16_t> wanted;
  for (const auto& [id, channel] : log.channels()) {
    if (!topics.empty() && std::find(topics.begin(), topics.end(), channel.topic) == topics.end()) continue;
    const auto schema = log.schemas().find(channel.schema_id);
    const std::string type_name = schema == log.schemas().end() ? "" : schema->second.name;
    Target target{log::find_log_type(type_name), 0, {channel.topic, type_name, "", 0, 0}};
    if (target.type != nullptr) {
      target.table = out->add_table(channel.topic, *target.type, target.result.place);
      wanted.insert(id);
    }
    targets.emplace(id, std::move(target));
  }
  out->metadata(log.metadata());

  tables::Row row;
  const auto write_row = [&](const mcap::Message& message) {
    Target& target = targets.at(message.channel_id);
    if (!target.type->row(message.data, message.size, row)) {
      ++target.result.unreadable;
      return true;
    }
    out->row(target.table, row);
    ++target.result.rows;
    return true;
  };
  if (!wanted.empty()) log.for_each(write_row, mcap::McapReader::Order::LogTime, wanted);
  out->close();

  std::vector<ExportedTopic> results;
  for (const auto& [id, target] : targets) results.push_back(target.result);
  std::sort(results.begin(), results.end(), [](const auto& a, const auto& b) { return a.topic < b.topic; });
  return results;
}

}  // namespace inslab::exports
