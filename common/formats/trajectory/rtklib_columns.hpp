#pragma once

#include <optional>
#include <string_view>

#include "inslab/formats/trajectory/trajectory_columns.hpp"

namespace inslab::trajectory {

/// The columns of an RTKLIB solution (.pos) from the line of names in its comments, without the %: "GPST latitude(deg)
/// longitude(deg) height(m) Q ns sdn(m) ...", with vn(m/s), ve(m/s), vu(m/s) where the file has velocities. GPST stands
/// over two columns: week and seconds of week, or a date and a time of day. Nothing when the line is none, or its times
/// are not in GPS time. (RTKLIB manual 2.4.2, appendix B.1)
std::optional<TextColumns> rtklib_columns(std::string_view names);

}  // namespace inslab::trajectory
