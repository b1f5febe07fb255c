#include "inslab/referee/calibrate/profile_file.hpp"

#include <algorithm>

#include "inslab/data/json/json_writer.hpp"
#include "inslab/foundation/files/output_file.hpp"

namespace inslab::calibrate {
namespace {

/// `value` without what equals `usual`.
json::Json shortened(const json::Json& value, const json::Json& usual) {
  if (value.is_array() && value.size() == 3 && value[0].is_number() && value[0] == value[1] && value[1] == value[2]) {
    return value[0];
  }
  if (!value.is_object()) return value;
  json::Json object = json::Json::object();
  for (const auto& item : value.items()) {
    const json::Json& other = usual.at(item.key());
    if (item.value() == other && item.key() != "name" && item.key() != "fix_type") continue;
    object[item.key()] = shortened(item.value(), other);
  }
  return object;
}

template <class Profile>
std::string text_of(const Profile& profile) {
  return shortened(json::json_from_struct(profile), json::json_from_struct(Profile())).dump(2) + "\n";
}

}  // namespace

std::string profile_text(const ImuErrorProfile& profile) { return text_of(profile); }

void write_profile(const std::string& path, const ImuErrorProfile& profile) {
  files::write_file(path, text_of(profile));
}
void write_profile(const std::string& path, const GnssErrorProfile& profile) {
  files::write_file(path, text_of(profile));
}

}  // namespace inslab::calibrate
