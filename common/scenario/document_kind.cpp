#include "inslab/scenario/document_kind.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include "inslab/data/profiles/any_profile.hpp"
#include "inslab/scenario/scenario.hpp"

namespace inslab::scenario {

namespace {

/// The keys of a struct in JSON.
class KeyLister {
 public:
  std::vector<std::string> keys;

  template <class T>
  void operator()(const Field& field, T&) {
    // Every kind has these two: they tell nothing.
    if (!field.is_wire_only && field.name != "name" && field.name != "source") keys.emplace_back(field.name);
  }
};

template <class T>
std::vector<std::string> keys_of() {
  T value;
  KeyLister lister;
  T::fields(value, lister);
  return lister.keys;
}

struct Known {
  std::string schema;  ///< the name of its schema's file, without the ending; empty: it has none
  std::string words;
  std::vector<std::string> keys;
};

/// In the order of DocumentKind. The filter's parameters and the inventories of labs belong to parts above this one:
/// of them the keys that nothing else has.
const std::array<Known, 9>& known_documents() {
  static const std::array<Known, 9> all{
      {{"imu_error", "an IMU error profile (imu_error)", keys_of<ImuErrorProfile>()},
       {"vibration", "a vibration profile", keys_of<VibrationProfile>()},
       {"installation", "an installation profile", keys_of<InstallationProfile>()},
       {"gnss_error", "a GNSS error profile (gnss_error)", keys_of<GnssErrorProfile>()},
       {"fault", "a fault profile", keys_of<FaultProfile>()},
       {"scenario", "a scenario", keys_of<Scenario>()},
       {"", "a schedule of swaps", keys_of<Schedule>()},
       {"navigation",
        "a navigation filter's parameters",
        {"gyro", "accel", "lever_arm_b_m", "initial", "innovation_test", "zero_velocity", "coasting",
         "covariance_interval_s", "max_latency_s", "coasting_after_s"}},
       {"", "a lab's inventory", {"hosts", "discovery", "scenario", "domain", "unit", "log", "clock"}}}};
  return all;
}

std::optional<DocumentKind> kind_of_schema(const config::Json& document) {
  const auto schema = document.find("$schema");
  if (schema == document.end() || !schema->is_string()) return std::nullopt;
  const std::string file = std::filesystem::path(schema->get<std::string>()).filename().string();
  for (std::size_t i = 0; i < known_documents().size(); ++i) {
    const std::string& name = known_documents()[i].schema;
    if (!name.empty() && file == name + ".schema.json") return static_cast<DocumentKind>(i);
  }
  return std::nullopt;
}

}  // namespace

std::optional<DocumentKind> document_kind(const config::Json& document, std::optional<DocumentKind> likely) {
  if (!document.is_object()) return std::nullopt;
  if (const auto kind = kind_of_schema(document)) return kind;
  std::optional<DocumentKind> best;
  std::size_t most = 0;
  for (std::size_t i = 0; i < known_documents().size(); ++i) {
    const std::vector<std::string>& keys = known_documents()[i].keys;
    const auto count = static_cast<std::size_t>(
        std::count_if(keys.begin(), keys.end(), [&](const std::string& key) { return document.contains(key); }));
    // A schedule has but one key, which a scenario has too.
    const auto kind = static_cast<DocumentKind>(i);
    const bool is_preferred = likely ? kind == *likely : kind == DocumentKind::Schedule && count == document.size();
    if (count == 0 || count < most || (count == most && !is_preferred)) continue;
    most = count;
    best = kind;
  }
  return best;
}

std::string words_of(DocumentKind kind) { return known_documents()[static_cast<std::size_t>(kind)].words; }

std::vector<std::string> profile_kind_words() {
  std::vector<std::string> words(EnumNames<ProfileKind>::values.begin(), EnumNames<ProfileKind>::values.end());
  words.insert(words.end(), {"imu", "gnss"});
  return words;
}

std::optional<ProfileKind> profile_kind_named(const std::string& word) {
  if (word == "imu") return ProfileKind::ImuError;
  if (word == "gnss") return ProfileKind::GnssError;
  const auto& names = EnumNames<ProfileKind>::values;
  const auto found = std::find(names.begin(), names.end(), word);
  if (found == names.end()) return std::nullopt;
  return static_cast<ProfileKind>(found - names.begin());
}

}  // namespace inslab::scenario
