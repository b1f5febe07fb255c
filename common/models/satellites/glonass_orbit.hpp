#pragma once

#include <array>
#include <vector>

#include "inslab/data/samples/glonass_ephemeris.hpp"
#include "inslab/models/satellites/satellite_state.hpp"

namespace inslab::satellites {

/// A satellite of GLONASS by its ephemeris: the equations of motion of the ICD 5.1, appendix A.3.1, from the state that
/// it broadcasts, by Runge-Kutta of fourth order over whole 30 s and one step from there to the instant asked for. An
/// instant's state is the same in whatever order instants are asked for.
class GlonassOrbit {
 public:
  explicit GlonassOrbit(const GlonassEphemeris& ephemeris);

  /// The first time that an instant further from tb than all before is asked for costs the steps in between.
  SatelliteState at(const time::GpsTime& gps);

  const GlonassEphemeris& ephemeris() const { return ephemeris_; }

 private:
  struct Node {
    Vector3 r_e_m, v_e_m_per_s;
  };

  Node step(const Node& from, double dt_s) const;
  Vector3 acceleration(const Node& node) const;

  GlonassEphemeris ephemeris_;
  std::array<std::vector<Node>, 2> nodes_;  ///< before tb, after tb: 30 s apart, the first at tb
};

}  // namespace inslab::satellites
