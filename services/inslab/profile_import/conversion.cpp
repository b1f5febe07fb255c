#include "services/inslab/profile_import/conversion.hpp"

#include <fmt/format.h>

#include "io/error.hpp"
#include "samples/limits.hpp"
#include "samples/profile_rules.hpp"

namespace inslab::cli {
namespace {

std::string vector_text(const Vector3& value) {
  if (value[0] == value[1] && value[1] == value[2]) return fmt::format("{:.6g}", value[0]);
  return fmt::format("[{:.6g} {:.6g} {:.6g}]", value[0], value[1], value[2]);
}

}  // namespace

std::string conversion_line(const std::string& from, const Vector3& from_value, const std::string& from_unit,
                            const std::string& to, const Vector3& to_value, const std::string& how) {
  return fmt::format("{} {} {} -> {} {}: {}", from, vector_text(from_value), from_unit, to, vector_text(to_value), how);
}

void check_imported(const std::string& file, const ImuErrorProfile& profile) {
  auto broken = limit_violation(profile);
  if (!broken) broken = violation(profile);
  if (broken) throw io::ReadError(file + ": makes no profile: " + broken->path + " " + broken->reason);
}

}  // namespace inslab::cli
