#pragma once

#include "inslab/data/samples/glonass_ephemeris.hpp"
#include "inslab/data/samples/keplerian_ephemeris.hpp"

/// One orbit, told anew: the same satellite at every instant, with another time of reference. What is broadcast during
/// a run are re-references of one record, so that no range jumps when a message changes.
namespace inslab::satellites {

class GlonassOrbit;

/// The ephemeris with toe and toc at `toe`: orbit and clock at any instant are the same to 5e-7 m over five days, and
/// across weeks. The issue counts on by one for each period of messages.
///
/// M0 + n D, i0 + idot D, OMEGA0 + OMEGAdot D less what the Earth turns in the weeks that the time of week has begun
/// anew, af0 and af1 by their series. A geostationary satellite of BeiDou must hold its plane (held_for_run()):
/// R' = R_X(5 deg) R_Z(w D) R_X(-5 deg) R with R = R_Z(-(OMEGA0 - w toes)) R_X(-i0) R_Z(-omega). Derived from the user
/// algorithms (kepler_state), whose coordinates both must give.
KeplerianEphemeris re_referenced(const KeplerianEphemeris& ephemeris, const time::GpsTime& toe);

/// The same of GLONASS: the orbit's state at `tb`.
GlonassEphemeris re_referenced(GlonassOrbit& orbit, const time::GpsTime& tb);

/// What of an ephemeris can be held for a whole run. Geostationary satellites of BeiDou lose OMEGAdot, idot and
/// harmonics, which the 5 deg between the poles of their orbit and of their messages forbid to re-reference: another
/// orbit by some km, as good as the first. GLONASS loses the pull of Moon and Sun, which a message gives for its half
/// hour.
KeplerianEphemeris held_for_run(const KeplerianEphemeris& ephemeris);
GlonassEphemeris held_for_run(const GlonassEphemeris& ephemeris);

/// How long a message is broadcast: 2 h of GPS and QZSS, 10 min of Galileo, 1 h of BeiDou, 30 min of GLONASS.
time::Nanoseconds message_period(GnssSystem system);

/// The time of reference of the message that is broadcast at `gps`. GPS, QZSS: the end of its two hours, in the middle
/// of the interval of fit (IS-GPS-200, 20.3.4.5). Galileo, BeiDou: the beginning of its period in the system's own
/// time. GLONASS: the middle of its half hour of UTC, at minute 15 or 45 (ICD 5.1, 4.4).
time::GpsTime reference_time_at(GnssSystem system, const time::GpsTime& gps);

}  // namespace inslab::satellites
