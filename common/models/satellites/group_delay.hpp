#pragma once

#include "inslab/data/broadcast/gnss_signal.hpp"
#include "inslab/data/samples/glonass_ephemeris.hpp"
#include "inslab/data/samples/keplerian_ephemeris.hpp"

namespace inslab::satellites {

/// What a signal leaves its satellite later than the broadcast clock says, s (data/broadcast/gnss_signal.hpp). The
/// clock is that of the ephemeris of I/NAV, for all signals of Galileo.
inline double group_delay_s(const broadcast::GnssSignal& signal, const KeplerianEphemeris& ephemeris) {
  return signal.delay.first * ephemeris.first_delay_s + signal.delay.second * ephemeris.second_delay_s;
}
inline double group_delay_s(const broadcast::GnssSignal& signal, const GlonassEphemeris& ephemeris) {
  return signal.delay.first * ephemeris.delta_tau_s;
}

/// The ephemeris that Galileo's F/NAV has of the satellite whose I/NAV that is: the clock of E1 and E5a, ahead by
/// BGD(E1,E5a) - BGD(E1,E5b) (OS SIS ICD, 5.1.5).
inline KeplerianEphemeris fnav_of(const KeplerianEphemeris& inav) {
  KeplerianEphemeris e = inav;
  e.message = KeplerianMessage::Fnav;
  e.af0_s += inav.first_delay_s - inav.second_delay_s;
  return e;
}

}  // namespace inslab::satellites
