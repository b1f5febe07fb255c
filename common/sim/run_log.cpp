#include "inslab/sim/run_log.hpp"

#include "inslab/data/json/json_writer.hpp"

namespace inslab::sim {

namespace {

constexpr const char* kVersion = INSLAB_VERSION;

mcap::McapWriter::Options log_options(std::size_t chunk_bytes, files::OutputFile::Kind kind) {
  mcap::McapWriter::Options options;
  options.kind = kind;
  options.chunk_bytes = chunk_bytes;
  options.library = std::string("inslab ") + kVersion;
  return options;
}

}  // namespace

std::string profile_record(ProfileKind kind, const SensorAddress& sensor, std::uint32_t journal_number) {
  return "profile/" + std::string(enum_name(kind)) + "/" + catalog::sensor_name(sensor) + "/" +
         std::to_string(journal_number);
}

RunLog::RunLog(const std::string& path, const scenario::LoadedScenario& scenario, const std::string& cpu_features,
               std::size_t chunk_bytes, files::OutputFile::Kind kind)
    : path_(path), file_(path, log_options(chunk_bytes, kind)) {
  file_.metadata("scenario", {{"file", scenario.file.filename().string()},
                              {"name", scenario.scenario.name},
                              {"unit", scenario.unit},
                              {"json", json::json_from_struct(scenario.scenario).dump(2)}});
  file_.metadata("build", {{"version", kVersion}, {"cpu_features", cpu_features}});
  for_each_sensor(scenario, [this](auto of_kind, const auto& sensor) {
    for_each_profile(of_kind, sensor, [this](const auto& profile) { add_profile(profile); });
  });
}

RunLog::RunLog(const std::string& path, std::uint64_t known_size, std::size_t chunk_bytes)
    : RunLog(path, mcap::read_unfinished(path, known_size), chunk_bytes) {}

RunLog::RunLog(const std::string& path, const mcap::UnfinishedLog& unfinished, std::size_t chunk_bytes)
    : path_(path), file_(path, log_options(chunk_bytes, files::OutputFile::Kind::Log), unfinished) {
  for (const mcap::MetadataIndex& record : unfinished.metadata) {
    if (record.name.rfind("ack/", 0) == 0) ++acks_;
    if (record.name.rfind("recovery/", 0) == 0) ++recoveries_;
    if (record.name.rfind("profile/", 0) == 0) profiles_.insert(record.name);
  }
}

void RunLog::add_recovery(const std::string& what, const mcap::StringMap& details) {
  mcap::StringMap record = details;
  record["what"] = what;
  file_.metadata("recovery/" + std::to_string(++recoveries_), record);
}

void RunLog::add_profile(const catalog::AnyProfile& entry) {
  const ProfileRequest& request = catalog::request_of(entry);
  const std::string record = profile_record(catalog::kind_of(entry), catalog::target_of(entry), request.journal_number);
  if (!profiles_.insert(record).second) return;
  file_.metadata(
      record,
      {{"name", catalog::name_of(entry)},
       {"journal_number", std::to_string(request.journal_number)},
       {"apply_at_ns", std::to_string(request.apply_at_ns)},
       {"json", std::visit([](const auto& profile) { return json::json_from_struct(profile).dump(2); }, entry)}});
}

void RunLog::add_ack(const ProfileAck& ack) {
  file_.metadata("ack/" + std::to_string(++acks_), {{"json", json::wire_to_json(ack).dump(2)}});
}

}  // namespace inslab::sim
