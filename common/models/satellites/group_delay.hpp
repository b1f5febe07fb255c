#pragma once

#include "inslab/data/broadcast/gnss_signal.hpp"
#include "inslab/data/samples/glonass_ephemeris.hpp"
#include "inslab/data/samples/keplerian_ephemeris.hpp"

namespace inslab::satellites {

/// What a signal leaves its satellite later than the clock of that message says, s (data/broadcast/gnss_signal.hpp has
/// the rules). The clock of Galileo's F/NAV is right for E1 and E5a, and ahead of that of I/NAV, of which the rules
/// are, by BGD(E1,E5a) - BGD(E1,E5b) (OS SIS ICD, 5.1.5).
inline double group_delay_s(const broadcast::GnssSignal& signal, const KeplerianEphemeris& ephemeris) {
  const double ahead_s =
      ephemeris.message == KeplerianMessage::Fnav ? ephemeris.first_delay_s - ephemeris.second_delay_s : 0.0;
  return ahead_s + signal.delay.first * ephemeris.first_delay_s + signal.delay.second * ephemeris.second_delay_s;
}
inline double group_delay_s(const broadcast::GnssSignal& signal, const GlonassEphemeris& ephemeris) {
  return signal.delay.first * ephemeris.delta_tau_s;
}

/// The ephemeris that Galileo's F/NAV has of the satellite whose I/NAV that is: every signal leaves at the same time by
/// both.
inline KeplerianEphemeris fnav_of(const KeplerianEphemeris& inav) {
  KeplerianEphemeris e = inav;
  e.message = KeplerianMessage::Fnav;
  e.af0_s += inav.first_delay_s - inav.second_delay_s;
  return e;
}

}  // namespace inslab::satellites
