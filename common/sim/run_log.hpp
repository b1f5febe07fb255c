#pragma once

#include <set>
#include <string>
#include <vector>

#include "inslab/formats/log/log_channel.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::sim {

/// The log of one run, live or offline: what every channel and metadata record is called and holds.
///
/// Metadata: "scenario" (the scenario as read, with every default written out, and the unit), "build" (version,
/// instruction set), "profile/KIND/SENSOR/NUMBER" (number 0: what the scenario began with; else the journal's; its
/// "json" is a profile file that can be used again), "ack/NUMBER", "recovery/NUMBER" (what was interrupted because its
/// process was started again, and how).
class RunLog {
 public:
  /// Creates the file and describes the scenario in it. Throws files::WriteError.
  RunLog(const std::string& path, const scenario::LoadedScenario& scenario, const std::string& cpu_features,
         std::size_t chunk_bytes = kChunkBytes, files::OutputFile::Kind kind = files::OutputFile::Kind::Log);

  /// Goes on with the log that a killed process left, from where it was `known_size` bytes long: what came behind is
  /// cut off. Throws files::ReadError, files::WriteError.
  RunLog(const std::string& path, std::uint64_t known_size, std::size_t chunk_bytes);

  static constexpr std::size_t kChunkBytes = std::size_t{1} << 20;

  mcap::McapWriter& file() { return file_; }
  std::uint64_t file_size() const { return file_.file_size(); }
  const std::string& path() const { return path_; }

  /// Keeps an entry of the journal as JSON, once.
  void add_profile(const catalog::AnyProfile& entry);
  /// Keeps an acknowledgement as JSON.
  void add_ack(const ProfileAck& ack);

  /// Keeps that a stream, or the log itself, was interrupted because its process was started again.
  void add_recovery(const std::string& what, const mcap::StringMap& details);

 private:
  RunLog(const std::string& path, const mcap::UnfinishedLog& unfinished, std::size_t chunk_bytes);

  std::string path_;
  mcap::McapWriter file_;
  std::uint64_t acks_ = 0;
  std::uint64_t recoveries_ = 0;
  std::set<std::string> profiles_;  ///< records that are there
};

/// Name of the metadata record of a profile.
std::string profile_record(ProfileKind kind, const SensorAddress& sensor, std::uint32_t journal_number);

}  // namespace inslab::sim
