#pragma once

#include <vector>

#include "inslab/data/samples/glonass_ephemeris.hpp"
#include "inslab/data/samples/keplerian_ephemeris.hpp"

/// The numbers of the broadcast messages, each declared once: where it stands in RINEX and how many bits it has on the
/// air. Readers, writers, rounding and encoders walk these tables.
namespace inslab::broadcast {

/// How a number is broadcast: a whole number of `lsb`, in the unit of the ICD.
struct Coding {
  int bits = 0;  ///< with the sign; 0: not part of the message
  bool is_signed = false;
  double lsb = 0.0;
};

/// What the bits of a signed number are.
enum class Sign { TwosComplement, Magnitude };

/// One number of a message.
template <class Message>
struct MessageField {
  std::string_view name;  ///< of the member, with its unit
  double& (*of)(Message& message);
  int rinex_place;              ///< in a record: 0 to 2 behind the epoch, then four a line
  double rinex_unit;            ///< of the number in RINEX, in that of the member
  double air_unit;              ///< of the number on the air, in that of the member: pi of semicircles
  bool wraps;                   ///< an angle of the whole circle
  std::vector<Coding> codings;  ///< by the kind of message

  double value(const Message& message) const { return of(const_cast<Message&>(message)); }
};

/// IS-GPS-200, tables 20-I and 20-III (QZSS alike); Galileo OS SIS ICD, tables 60 to 65; BeiDou B1I ICD, tables 5-8 to
/// 5-11. RINEX 3.05, tables A5, A8, A13, A14.
const std::vector<MessageField<KeplerianEphemeris>>& keplerian_fields();

/// GLONASS ICD 5.1, table 4.5: sign and magnitude. RINEX 3.05, table A10.
const std::vector<MessageField<GlonassEphemeris>>& glonass_fields();

/// The coding of a field in a message of that kind.
const Coding& coding_of(const MessageField<KeplerianEphemeris>& field, KeplerianMessage message);
const Coding& coding_of(const MessageField<GlonassEphemeris>& field);

/// The whole number that is broadcast for `value`: the nearest one. Throws std::range_error, naming the field, its
/// value and its limits, when it does not fit.
template <class Message>
std::int64_t broadcast_number(const MessageField<Message>& field, const Coding& coding, Sign sign, double value);

/// The ephemeris as a receiver decodes it: every number rounded to its bits. Throws std::range_error as
/// broadcast_number() does.
KeplerianEphemeris as_broadcast(const KeplerianEphemeris& ephemeris);
GlonassEphemeris as_broadcast(const GlonassEphemeris& ephemeris);

/// The bits that the times of reference count in: 16 s of GPS and QZSS, 60 s of Galileo, 8 s of BeiDou.
std::int64_t reference_time_unit_s(KeplerianMessage message);

}  // namespace inslab::broadcast
