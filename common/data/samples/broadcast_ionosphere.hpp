#pragma once

#include "inslab/data/samples/gnss_system.hpp"

namespace inslab {
inline namespace samples {

/// The eight numbers of the ionosphere's delay that a system broadcasts (IS-GPS-200, 20.3.3.5.2.5): of its amplitude
/// and of its period, cubic in the geomagnetic latitude. Seconds, and s per semicircle to the first, second and third
/// power.
struct BroadcastIonosphere {
  GnssSystem system = GnssSystem::Gps;
  std::array<double, 4> alpha{};
  std::array<double, 4> beta{};
};

}  // namespace samples
}  // namespace inslab
