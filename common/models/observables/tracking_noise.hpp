#pragma once

#include <cmath>

#include "inslab/data/broadcast/gnss_signal.hpp"
#include "inslab/foundation/units/units.hpp"

namespace inslab::observables {

/// Loops of a receiver.
struct TrackingLoops {
  double code_bandwidth_hz = 0.5;
  double phase_bandwidth_hz = 15.0;
  double frequency_bandwidth_hz = 2.0;
  double integration_s = 0.02;
  double correlator_spacing_chips = 0.2;
};

/// Standard deviations of thermal noise.
struct TrackingNoise {
  double code_m = 0.0;
  double phase_m = 0.0;
  double rate_m_per_s = 0.0;
};

/// Of a signal at a density of carrier to noise, dB-Hz. Source: E. Kaplan and C. Hegarty, Understanding GPS/GNSS, third
/// edition, chapter 8: early-minus-late power discriminator of the code, arctangent of the phase (a pilot's without the
/// loss of squaring), frequency. A code with a subcarrier correlates three times as steeply.
inline TrackingNoise tracking_noise(const broadcast::GnssSignal& signal, double frequency_hz, double cn0_db_hz,
                                    const TrackingLoops& loops) {
  const double c0 = std::pow(10.0, 0.1 * cn0_db_hz), T = loops.integration_s, d = loops.correlator_spacing_chips;
  const double steepness = signal.modulation == broadcast::Modulation::BinaryOffset ? 3.0 : 1.0;
  const double squaring = signal.is_pilot ? 0.0 : 1.0 / (2.0 * T * c0);
  const double chip_m = broadcast::kSpeedOfLight_m_per_s / signal.chip_rate_hz;
  const double radian_m = broadcast::kSpeedOfLight_m_per_s / frequency_hz / (2.0 * units::kPi);
  return {chip_m * std::sqrt(loops.code_bandwidth_hz * d / (2.0 * c0 * steepness) * (1.0 + 2.0 / ((2.0 - d) * T * c0))),
          radian_m * std::sqrt(loops.phase_bandwidth_hz / c0 * (1.0 + squaring)),
          radian_m / T * std::sqrt(4.0 * loops.frequency_bandwidth_hz / c0 * (1.0 + 1.0 / (T * c0)))};
}

}  // namespace inslab::observables
