#pragma once

#include <optional>
#include <string_view>

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::files {

/// Whether a text begins as a date does, 2024/03/05 or 2024-03-05.
bool is_calendar_date(std::string_view text);

/// The GPS time of a date and a time of day that are in GPS time themselves, "2024/03/05" and "10:00:00.000"; exact to
/// the nanosecond. Nothing when they are none, or before GPS began on 1980-01-06.
std::optional<time::GpsTime> gps_from_calendar(std::string_view date, std::string_view time_of_day);

}  // namespace inslab::files
