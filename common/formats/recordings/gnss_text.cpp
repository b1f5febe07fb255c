#include "inslab/formats/recordings/gnss_text.hpp"

#include <stdexcept>

#include "inslab/foundation/units/units.hpp"

namespace inslab::recordings {

void GnssTextWriter::write(const GnssTextRecord& record) {
  out_.number(time::to_seconds(record.in_week % files::SecondsOfWeek::kWeek), 9);
  out_.number(record.position.latitude_rad / units::kDeg, 12).number(record.position.longitude_rad / units::kDeg, 12);
  out_.number(record.position.height_m, 6);
  for (const double sigma_m : record.sigma_ned_m) out_.number(sigma_m, 6);
  out_.end_line();
}

bool GnssTextReader::next(GnssTextRecord& record) {
  std::array<double, 7> n{};
  if (!files::next_numbers(lines_, n)) return false;
  record = {time_.of_line(lines_, n[0]), {n[1] * units::kDeg, n[2] * units::kDeg, n[3]}, {n[4], n[5], n[6]}};
  for (std::size_t i = 4; i < n.size(); ++i) {
    if (n[i] > 0.0) continue;
    throw files::ReadError(
        lines_.path() + ": line " + std::to_string(lines_.number()) + ", column " + std::to_string(i + 1) + ": is " +
        std::to_string(n[i]) +
        "; expected the standard deviation of the position (north, east, down in columns 5 to 7), above 0 m");
  }
  try {
    nav::check_domain(record.position);
  } catch (const std::domain_error& error) {
    throw files::ReadError(lines_.path() + ": line " + std::to_string(lines_.number()) + ": " + error.what());
  }
  return true;
}

}  // namespace inslab::recordings
