#pragma once

#include "inslab/nav/geodesy.hpp"

namespace inslab {

/// Where a sample says that it was: of any that has latitude_rad, longitude_rad (rad) and height_m (m, above WGS84).
template <typename Sample>
nav::Geodetic geodetic_of(const Sample& sample) {
  return {sample.latitude_rad, sample.longitude_rad, sample.height_m};
}

}  // namespace inslab
