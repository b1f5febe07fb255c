#include "inslab/referee/navigate/result_files.hpp"

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/files/unfinished.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::navigate {

ResultFiles::ResultFiles(const std::string& stem) : solution_(stem + ".nav"), sigmas_(stem + "_sigmas.txt", " ") {}

void ResultFiles::write(const NavSolution& s) {
  TrajectoryRow row;
  row.position = geodetic_of(s);
  row.v_n = s.v_n;
  row.rpy = nav::rpy_from_quaternion(s.q_n_body);
  solution_.write({s.gps_week, s.gps_time_of_week_ns}, row);
  sigmas_.integer(s.gps_week).number(time::to_seconds(s.gps_time_of_week_ns), 9);
  for (const double sigma : s.position_sigma_ned_m) sigmas_.number(sigma, 6);
  for (const double sigma : s.velocity_sigma_ned_m_per_s) sigmas_.number(sigma, 6);
  for (const double sigma : s.attitude_sigma_rad) sigmas_.number(sigma / units::kDeg, 9);
  sigmas_.end_line();
  ++rows_;
}

void ResultFiles::close() {
  const auto together = files::hold_unfinished();
  solution_.close();
  sigmas_.close();
}

}  // namespace inslab::navigate
