#pragma once

#include "inslab/data/samples/gnss_system.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab {
inline namespace samples {

/// What a satellite of GLONASS broadcasts of its orbit and clock (GLONASS ICD 5.1, table 4.5). The frame is PZ-90,
/// which counts as e; times are GPS time.
struct GlonassEphemeris {
  SatelliteId satellite{GnssSystem::Glonass, 0};
  time::GpsTime tb;           ///< of the state and the clock
  time::GpsTime transmitted;  ///< when the message was sent

  Vector3 r_e_m = Vector3::Zero();
  Vector3 v_e_m_per_s = Vector3::Zero();
  Vector3 lunisolar_e_m_per_s2 = Vector3::Zero();  ///< what Moon and Sun pull with
  double tau_s = 0.0;                              ///< GLONASS time minus the satellite's at tb
  double gamma = 0.0;                              ///< relative offset of the frequency
  double delta_tau_s = 0.0;                        ///< delay of G2 beside G1
  std::int32_t channel = 0;                        ///< -7 to 6: k of the frequencies
  std::uint32_t health = 0;                        ///< 0: usable
  std::uint32_t age_days = 0;                      ///< of the data
};

}  // namespace samples
}  // namespace inslab
