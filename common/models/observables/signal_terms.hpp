#pragma once

#include <cmath>

#include "inslab/data/broadcast/gnss_signal.hpp"

/// What a receiver measures of a signal, and everything that it is the sum of.
namespace inslab::observables {

/// Terms of one satellite's signal at the tag of a receiver's clock. Clocks are minus GPS time; the satellite's is at
/// transmission. Rates are by GPS time.
struct SignalTerms {
  double light_time_s = 0.0, light_time_rate = 0.0;
  double receiver_clock_s = 0.0, receiver_drift = 0.0;
  double satellite_clock_s = 0.0, satellite_drift = 0.0;
  double group_delay_s = 0.0;                                ///< beside the broadcast clock
  double hardware_bias_s = 0.0;                              ///< of the receiver's channel
  double ionosphere_m = 0.0, ionosphere_rate_m_per_s = 0.0;  ///< of this frequency: code late, phase early
  double troposphere_m = 0.0, troposphere_rate_m_per_s = 0.0;
  double code_multipath_m = 0.0, phase_multipath_m = 0.0;
  double code_noise_m = 0.0, phase_noise_m = 0.0, doppler_noise_hz = 0.0;
  double ambiguity_cycles = 0.0;          ///< a whole number
  bool is_half_cycle_unresolved = false;  ///< the phase may then be off by half a cycle: here it is
};

struct Observed {
  double pseudorange_m = 0.0;
  double phase_cycles = 0.0;  ///< grows with the range
  double doppler_hz = 0.0;  ///< positive when coming nearer: minus the derivative of the phase by the receiver's clock
};

/// The sums. The time of reception in the Doppler is the receiver's own, hence the division by 1 + its drift.
inline Observed observed(const SignalTerms& s, double frequency_hz) {
  constexpr double kC = broadcast::kSpeedOfLight_m_per_s;
  const double wavelength_m = kC / frequency_hz;
  const double common_m = kC * (s.light_time_s + (s.receiver_clock_s - s.satellite_clock_s)) + s.troposphere_m;
  Observed observed;
  observed.pseudorange_m =
      common_m + kC * (s.group_delay_s + s.hardware_bias_s) + s.ionosphere_m + s.code_multipath_m + s.code_noise_m;
  observed.phase_cycles = (common_m - s.ionosphere_m + s.phase_multipath_m + s.phase_noise_m) / wavelength_m +
                          s.ambiguity_cycles + (s.is_half_cycle_unresolved ? 0.5 : 0.0);
  const double stretched = s.light_time_rate + s.receiver_drift - s.satellite_drift * (1.0 - s.light_time_rate);
  observed.doppler_hz = -frequency_hz * stretched / (1.0 + s.receiver_drift) +
                        (s.ionosphere_rate_m_per_s - s.troposphere_rate_m_per_s) / wavelength_m + s.doppler_noise_hz;
  return observed;
}

/// The whole number of cycles with which the phase, in metres, is within half a wavelength of the pseudorange, and
/// `drawn` cycles from there: what a receiver begins to count from.
inline double first_ambiguity(const SignalTerms& terms, double frequency_hz, double drawn_cycles) {
  SignalTerms unset = terms;
  unset.ambiguity_cycles = 0.0;
  const Observed bare = observed(unset, frequency_hz);
  const double wavelength_m = broadcast::kSpeedOfLight_m_per_s / frequency_hz;
  return std::round(bare.pseudorange_m / wavelength_m - bare.phase_cycles) + std::round(drawn_cycles);
}

}  // namespace inslab::observables
