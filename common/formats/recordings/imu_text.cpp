#include "inslab/formats/recordings/imu_text.hpp"

namespace inslab::recordings {

void ImuTextWriter::write(const ImuTextRecord& record) {
  out_.number(time::to_seconds(record.in_week % files::SecondsOfWeek::kWeek), 9);
  for (const double component : record.dtheta_b) out_.number(component, 15);
  for (const double component : record.dv_b) out_.number(component, 12);
  out_.end_line();
}

bool ImuTextReader::next(ImuTextRecord& record) {
  std::array<double, 7> n{};
  if (!files::next_numbers(lines_, n)) return false;
  record = {time_.of_line(lines_, n[0]), {n[1], n[2], n[3]}, {n[4], n[5], n[6]}};
  return true;
}

}  // namespace inslab::recordings
