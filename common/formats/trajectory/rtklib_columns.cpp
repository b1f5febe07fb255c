#include "inslab/formats/trajectory/rtklib_columns.hpp"

#include <utility>
#include <vector>

#include "inslab/foundation/files/text_lines.hpp"

namespace inslab::trajectory {

namespace {

/// RTKLIB's name and ours; a name that is not here is left aside.
constexpr std::pair<std::string_view, std::string_view> kNames[] = {
    {"latitude(deg)", "lat_deg"}, {"longitude(deg)", "lon_deg"}, {"height(m)", "h_m"},
    {"vn(m/s)", "vn_mps"},        {"ve(m/s)", "ve_mps"},         {"vu(m/s)", "vu_mps"}};

}  // namespace

std::optional<TextColumns> rtklib_columns(std::string_view text) {
  std::vector<std::string_view> names;
  files::split(text, ' ', names);
  if (names.size() < 4 || names.front() != "GPST" || names[1] != "latitude(deg)") return std::nullopt;
  std::vector<TextColumn> columns{column_named("week").value(), column_named("sow_s").value()};
  for (std::size_t i = 1; i < names.size(); ++i) {
    TextColumn column{std::string(names[i]), Quantity::Ignored, 1.0};
    for (const auto& [theirs, ours] : kNames) {
      if (names[i] == theirs) column = column_named(ours).value();
    }
    columns.push_back(column);
  }
  return TextColumns(std::move(columns));
}

}  // namespace inslab::trajectory
