#include "inslab/formats/profile_import/conversion.hpp"

#include <fmt/format.h>

#include "inslab/data/catalog/profile_rules.hpp"
#include "inslab/foundation/fields/limits.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/input_file.hpp"

namespace inslab::profile_import {
namespace {

std::string vector_text(const Vector3& value) {
  if (value[0] == value[1] && value[1] == value[2]) return fmt::format("{:.6g}", value[0]);
  return fmt::format("[{:.6g} {:.6g} {:.6g}]", value[0], value[1], value[2]);
}

}  // namespace

std::string import_text(const std::string& file) {
  const files::InputFile input(file);
  if (input.size() > files::kMaxImportBytes) {
    throw files::ReadError(
        fmt::format("{}: has {} bytes; expected at most {}", file, input.size(), files::kMaxImportBytes));
  }
  std::string text(input.size(), '\0');
  input.read(0, reinterpret_cast<std::uint8_t*>(text.data()), text.size());
  return text;
}

void refuse_depth(const std::string& place, std::size_t levels) {
  throw files::ReadError(fmt::format("{}: is nested deeper than {} levels", place, levels));
}

std::string conversion_line(const std::string& from, const Vector3& from_value, const std::string& from_unit,
                            const std::string& to, const Vector3& to_value, const std::string& how) {
  return fmt::format("{} {} {} -> {} {}: {}", from, vector_text(from_value), from_unit, to, vector_text(to_value), how);
}

void check_imported(const std::string& file, const ImuErrorProfile& profile) {
  auto broken = limit_violation(profile);
  if (!broken) broken = catalog::violation(profile);
  if (broken) throw files::ReadError(file + ": makes no profile: " + broken->path + " " + broken->reason);
}

}  // namespace inslab::profile_import
