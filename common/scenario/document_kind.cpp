#include "inslab/scenario/document_kind.hpp"

#include <algorithm>
#include <filesystem>

#include "inslab/data/catalog/any_profile.hpp"
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

/// "an IMU error profile (imu_error)", with the name where the word for it is another.
template <class Profile>
Known known_profile() {
  const catalog::ProfileWords& words = catalog::kWords<Profile>;
  const std::string name(enum_name(Profile::kind));
  std::string text = std::string(words.article) + " " + std::string(words.document);
  if (words.word != name) text += " (" + name + ")";
  return {name, text, keys_of<Profile>()};
}

/// In the order of DocumentKind. The filter's parameters and the inventories of labs belong to parts above this one:
/// of them the keys that nothing else has.
const std::vector<Known>& known_documents() {
  static const std::vector<Known> all = [] {
    std::vector<Known> known;
    for_each(catalog::ProfileKinds{},
             [&known](auto profile) { known.push_back(known_profile<typename decltype(profile)::type>()); });
    known.push_back({"scenario", "a scenario", keys_of<Scenario>()});
    known.push_back({"", "a schedule of swaps", keys_of<Schedule>()});
    known.push_back({"navigation",
                     "a navigation filter's parameters",
                     {"gyro", "accel", "lever_arm_b_m", "initial", "innovation_test", "zero_velocity", "coasting",
                      "covariance_interval_s", "max_latency_s", "coasting_after_s"}});
    known.push_back({"", "a lab's inventory", {"hosts", "discovery", "scenario", "domain", "unit", "log", "clock"}});
    return known;
  }();
  return all;
}

std::optional<DocumentKind> kind_of_schema(const json::Json& document) {
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

std::optional<DocumentKind> document_kind(const json::Json& document, std::optional<DocumentKind> likely) {
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
  for_each(catalog::ProfileKinds{}, [&words](auto profile) {
    using Profile = typename decltype(profile)::type;
    const std::string_view word = catalog::kWords<Profile>.word;
    if (word != enum_name(Profile::kind)) words.emplace_back(word);
  });
  return words;
}

std::optional<ProfileKind> profile_kind_named(const std::string& word) {
  std::optional<ProfileKind> named;
  for_each(catalog::ProfileKinds{}, [&](auto profile) {
    using Profile = typename decltype(profile)::type;
    if (word == enum_name(Profile::kind) || word == catalog::kWords<Profile>.word) named = Profile::kind;
  });
  return named;
}

}  // namespace inslab::scenario
