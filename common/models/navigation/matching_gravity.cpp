#include "inslab/models/navigation/matching_gravity.hpp"

#include "inslab/foundation/units/units.hpp"

namespace inslab::navigation {

void match(const nav::GravityAlongWay& along_way, NavigationParameters& parameters) {
  parameters.gravity_disturbance.sigma_ned_mgal = along_way.sigma_n / units::kMGal;
  parameters.gravity_disturbance.correlation_m = along_way.correlation_m;
  parameters.states.gravity_disturbance = true;
}

nav::GravityAlongWay along_way_of(const GravityBelief& belief) {
  return {units::kMGal * belief.sigma_ned_mgal, belief.correlation_m};
}

}  // namespace inslab::navigation
