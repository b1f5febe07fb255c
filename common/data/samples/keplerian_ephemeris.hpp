#pragma once

#include "inslab/data/samples/gnss_system.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab {
inline namespace samples {

/// The message that an ephemeris came in, named as in RINEX 4.00: of GPS and QZSS, of Galileo, of BeiDou.
enum class KeplerianMessage : std::uint32_t { Lnav, Inav, Fnav, D1, D2 };

template <>
struct EnumNames<KeplerianMessage> {
  static constexpr std::string_view type = "KeplerianMessage";
  static constexpr std::string_view prefix = "MESSAGE_";
  static constexpr std::array<std::string_view, 5> values{"LNAV", "INAV", "FNAV", "D1", "D2"};
};

/// What a satellite of GPS, QZSS, Galileo or BeiDou broadcasts of its orbit and clock (IS-GPS-200, tables 20-I and
/// 20-III; the other systems' ICDs alike). Angles in rad, whatever is on the air; times are GPS time.
struct KeplerianEphemeris {
  SatelliteId satellite;
  KeplerianMessage message = KeplerianMessage::Lnav;
  time::GpsTime toe;          ///< of the orbit's reference
  time::GpsTime toc;          ///< of the clock's
  time::GpsTime transmitted;  ///< when the message was sent

  double sqrt_a_sqrt_m = 0.0;            ///< square root of the semi-major axis
  double eccentricity = 0.0;             ///< 1
  double m0_rad = 0.0;                   ///< mean anomaly at toe
  double delta_n_rad_per_s = 0.0;        ///< of the mean motion, beside Kepler's
  double omega0_rad = 0.0;               ///< longitude of the node at the beginning of toe's week
  double omega_dot_rad_per_s = 0.0;      ///< its rate, relative to the stars
  double i0_rad = 0.0;                   ///< inclination at toe
  double i_dot_rad_per_s = 0.0;          ///< its rate
  double argument_of_perigee_rad = 0.0;  ///< 1
  double cuc_rad = 0.0, cus_rad = 0.0;   ///< harmonics of the argument of latitude
  double crc_m = 0.0, crs_m = 0.0;       ///< of the radius
  double cic_rad = 0.0, cis_rad = 0.0;   ///< of the inclination
  double af0_s = 0.0;                    ///< clock: offset at toc
  double af1_s_per_s = 0.0;              ///< drift
  double af2_s_per_s2 = 0.0;             ///< and its rate
  double first_delay_s = 0.0;            ///< T_GD; BGD(E1,E5a); TGD1
  double second_delay_s = 0.0;           ///< BGD(E1,E5b); TGD2
  double accuracy_m = 0.0;               ///< URA, SISA
  std::uint32_t issue = 0;               ///< IODE, IODnav, AODE
  std::uint32_t issue_of_clock = 0;      ///< IODC, AODC
  std::uint32_t health = 0;              ///< 0: usable
};

}  // namespace samples
}  // namespace inslab
