#include "inslab/referee/score/error_statistics.hpp"

namespace inslab::score {

void ErrorStatistics::add(const SolutionError& error, const NavSolution& solution) {
  ++count_;
  position_.add(error.position_ned_m);
  velocity_.add(error.velocity_ned_m_per_s);
  phi_.add(error.phi_rad);
  horizontal_m_.add(error.position_ned_m.head<2>().norm());
  vertical_m_.add(std::abs(error.position_ned_m.z()));
  position_nees_.add(error.position_ned_m, solution.position_sigma_ned_m);
  velocity_nees_.add(error.velocity_ned_m_per_s, solution.velocity_sigma_ned_m_per_s);
  attitude_nees_.add(error.phi_rad, solution.attitude_sigma_rad);
}

}  // namespace inslab::score
