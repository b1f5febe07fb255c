#pragma once

#include "inslab/models/navigation/parameters.hpp"
#include "inslab/nav/gravity_along_way.hpp"

namespace inslab::navigation {

/// The filter estimates gravity's departure from the model that it is told, as this says of it.
void match(const nav::GravityAlongWay& along_way, NavigationParameters& parameters);

/// The same in SI, of what the parameters say.
nav::GravityAlongWay along_way_of(const GravityBelief& belief);

}  // namespace inslab::navigation
