#include "inslab/formats/recordings/nav_text.hpp"

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"

namespace inslab::recordings {

void NavTextWriter::write(const time::GpsTime& time, const TrajectoryRow& row) {
  const nav::Vector3& v_n = row.v_n.value();
  const nav::RollPitchYaw& rpy = row.rpy.value();
  out_.integer(time.week).number(time::to_seconds(time.time_of_week_ns), 9);
  out_.number(row.position.latitude_rad / units::kDeg, 12).number(row.position.longitude_rad / units::kDeg, 12);
  out_.number(row.position.height_m, 6);
  for (const double component : v_n) out_.number(component, 6);
  for (const double angle_rad : {rpy.roll_rad, rpy.pitch_rad, rpy.yaw_rad}) out_.number(angle_rad / units::kDeg, 9);
  out_.end_line();
}

}  // namespace inslab::recordings
