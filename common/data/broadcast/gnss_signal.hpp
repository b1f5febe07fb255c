#pragma once

#include "inslab/data/samples/gnss_system.hpp"

/// The signals that are simulated: one table, from which models, files and streams take what they need.
namespace inslab::broadcast {

inline constexpr double kSpeedOfLight_m_per_s = 299792458.0;

/// How the code is modulated, as far as tracking noise asks.
enum class Modulation { Bpsk, BinaryOffset };

/// How much of the first and the second broadcast delay of a message (KeplerianEphemeris, GlonassEphemeris) a signal
/// comes late by, beside the broadcast clock.
struct DelayRule {
  double first = 0.0;
  double second = 0.0;
};

struct GnssSignal {
  GnssSystem system;
  std::string_view rinex;  ///< band and attribute of the observation codes (RINEX 3.05, tables 4 to 9)
  double frequency_hz;     ///< of channel 0
  double channel_step_hz;  ///< from channel to channel of GLONASS, else 0
  double chip_rate_hz;
  Modulation modulation;
  bool is_pilot;                   ///< without data bits
  std::uint8_t msm;                ///< signal id of RTCM's MSM messages (RTCM 10403.3, tables 3.5-91 to 3.5-108)
  std::uint8_t ubx;                ///< sigId of u-blox (M10 and F9 interface descriptions, "signal identifiers")
  std::uint8_t ubx_geostationary;  ///< of BeiDou's geostationary satellites, which send D2
  DelayRule delay;
};

/// Ordered by system and frequency; within a system `msm` and `rinex` are unique.
const std::vector<GnssSignal>& gnss_signals();

/// The signal of that name, such as "2I"; throws std::out_of_range, naming it, when there is none.
const GnssSignal& gnss_signal(GnssSystem system, std::string_view rinex);

/// Hz, of a channel of GLONASS; other systems' signals have one frequency.
inline double carrier_hz(const GnssSignal& signal, int channel = 0) {
  return signal.frequency_hz + channel * signal.channel_step_hz;
}

}  // namespace inslab::broadcast
