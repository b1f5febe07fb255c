#pragma once

#include <optional>
#include <string>
#include <vector>

#include "inslab/data/catalog/profile_kinds.hpp"
#include "inslab/data/json/json_file.hpp"

namespace inslab::scenario {

/// What a JSON file of Inslab is. The profiles come first, in the order of ProfileKind and by its values.
enum class DocumentKind : std::uint32_t {
  Scenario = catalog::ProfileKinds::size,
  Schedule,
  Navigation,
  Inventory,
};

/// The kind whose schema the document names, or else the one whose keys are most of its own, `likely` before others of
/// as many; nothing when none of its keys is known.
std::optional<DocumentKind> document_kind(const json::Json& document, std::optional<DocumentKind> likely = {});

/// "an IMU error profile (imu_error)", "a scenario": for messages.
std::string words_of(DocumentKind kind);

constexpr DocumentKind document_of(ProfileKind kind) { return static_cast<DocumentKind>(kind); }
constexpr std::optional<ProfileKind> profile_of(DocumentKind kind) {
  if (kind >= DocumentKind::Scenario) return std::nullopt;
  return static_cast<ProfileKind>(kind);
}

/// The words for kinds of profile on the command line: those of scenarios and logs (imu_error, ...), and the short
/// ones imu and gnss for two of them.
std::vector<std::string> profile_kind_words();
std::optional<ProfileKind> profile_kind_named(const std::string& word);

}  // namespace inslab::scenario
