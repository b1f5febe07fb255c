#include "inslab/data/broadcast/message_field.hpp"

#include <cmath>
#include <stdexcept>

#include "inslab/foundation/units/units.hpp"

namespace inslab::broadcast {

namespace {

using Kepler = KeplerianEphemeris;
using Glonass = GlonassEphemeris;

Coding twos(int bits, int exponent) { return {bits, true, std::ldexp(1.0, exponent)}; }
Coding plain(int bits, int exponent) { return {bits, false, std::ldexp(1.0, exponent)}; }
const Coding kAbsent{};

constexpr double kKm = 1000.0;
constexpr double kSemicircle = units::kPi;

/// The three families of messages: LNAV, I/NAV and F/NAV, D1 and D2.
std::size_t family(KeplerianMessage message) {
  constexpr std::array<std::size_t, 5> kFamilies{0, 1, 1, 2, 2};
  return kFamilies.at(static_cast<std::size_t>(message));
}

constexpr std::array<std::int64_t, 3> kReferenceUnits_s{16, 60, 8};

/// A member that is a plain number.
template <class Message, double Message::*member>
double& of(Message& message) {
  return message.*member;
}

/// One axis of a member that is a vector.
template <class Message, samples::Vector3 Message::*member, int axis>
double& axis_of(Message& message) {
  return (message.*member)[axis];
}

std::vector<MessageField<Kepler>> make_keplerian_fields() {
  const std::vector<Coding> angle{twos(32, -31), twos(32, -31), twos(32, -31)},
      rate_16{twos(16, -43), twos(16, -43), twos(16, -43)}, rate_24{twos(24, -43), twos(24, -43), twos(24, -43)},
      rate_14{twos(14, -43), twos(14, -43), twos(14, -43)}, root{plain(32, -19), plain(32, -19), plain(32, -19)},
      shape{plain(32, -33), plain(32, -33), plain(32, -33)}, turned{twos(16, -29), twos(16, -29), twos(18, -31)},
      lifted{twos(16, -5), twos(16, -5), twos(18, -6)};
  const Coding tenth_of_ns{10, true, 1e-10};
  return {
      {"af0_s", of<Kepler, &Kepler::af0_s>, 0, 1.0, 1.0, false, {twos(22, -31), twos(31, -34), twos(24, -33)}},
      {"af1_s_per_s",
       of<Kepler, &Kepler::af1_s_per_s>,
       1,
       1.0,
       1.0,
       false,
       {twos(16, -43), twos(21, -46), twos(22, -50)}},
      {"af2_s_per_s2",
       of<Kepler, &Kepler::af2_s_per_s2>,
       2,
       1.0,
       1.0,
       false,
       {twos(8, -55), twos(6, -59), twos(11, -66)}},
      {"crs_m", of<Kepler, &Kepler::crs_m>, 4, 1.0, 1.0, false, lifted},
      {"delta_n_rad_per_s", of<Kepler, &Kepler::delta_n_rad_per_s>, 5, 1.0, kSemicircle, false, rate_16},
      {"m0_rad", of<Kepler, &Kepler::m0_rad>, 6, 1.0, kSemicircle, true, angle},
      {"cuc_rad", of<Kepler, &Kepler::cuc_rad>, 7, 1.0, 1.0, false, turned},
      {"eccentricity", of<Kepler, &Kepler::eccentricity>, 8, 1.0, 1.0, false, shape},
      {"cus_rad", of<Kepler, &Kepler::cus_rad>, 9, 1.0, 1.0, false, turned},
      {"sqrt_a_sqrt_m", of<Kepler, &Kepler::sqrt_a_sqrt_m>, 10, 1.0, 1.0, false, root},
      {"cic_rad", of<Kepler, &Kepler::cic_rad>, 12, 1.0, 1.0, false, turned},
      {"omega0_rad", of<Kepler, &Kepler::omega0_rad>, 13, 1.0, kSemicircle, true, angle},
      {"cis_rad", of<Kepler, &Kepler::cis_rad>, 14, 1.0, 1.0, false, turned},
      {"i0_rad", of<Kepler, &Kepler::i0_rad>, 15, 1.0, kSemicircle, true, angle},
      {"crc_m", of<Kepler, &Kepler::crc_m>, 16, 1.0, 1.0, false, lifted},
      {"argument_of_perigee_rad", of<Kepler, &Kepler::argument_of_perigee_rad>, 17, 1.0, kSemicircle, true, angle},
      {"omega_dot_rad_per_s", of<Kepler, &Kepler::omega_dot_rad_per_s>, 18, 1.0, kSemicircle, false, rate_24},
      {"i_dot_rad_per_s", of<Kepler, &Kepler::i_dot_rad_per_s>, 19, 1.0, kSemicircle, false, rate_14},
      {"first_delay_s",
       of<Kepler, &Kepler::first_delay_s>,
       25,
       1.0,
       1.0,
       false,
       {twos(8, -31), twos(10, -32), tenth_of_ns}},
      {"second_delay_s",
       of<Kepler, &Kepler::second_delay_s>,
       26,
       1.0,
       1.0,
       false,
       {kAbsent, twos(10, -32), tenth_of_ns}},
  };
}

std::vector<MessageField<Glonass>> make_glonass_fields() {
  // Kilometres on the air and in RINEX alike; RINEX has the clock's offset with the other sign.
  const std::vector<Coding> position{twos(27, -11)}, velocity{twos(24, -20)}, acceleration{twos(5, -30)};
  return {
      {"tau_s", of<Glonass, &Glonass::tau_s>, 0, -1.0, 1.0, false, {twos(22, -30)}},
      {"gamma", of<Glonass, &Glonass::gamma>, 1, 1.0, 1.0, false, {twos(11, -40)}},
      {"x_e_m", axis_of<Glonass, &Glonass::r_e_m, 0>, 3, kKm, kKm, false, position},
      {"vx_e_m_per_s", axis_of<Glonass, &Glonass::v_e_m_per_s, 0>, 4, kKm, kKm, false, velocity},
      {"ax_e_m_per_s2", axis_of<Glonass, &Glonass::lunisolar_e_m_per_s2, 0>, 5, kKm, kKm, false, acceleration},
      {"y_e_m", axis_of<Glonass, &Glonass::r_e_m, 1>, 7, kKm, kKm, false, position},
      {"vy_e_m_per_s", axis_of<Glonass, &Glonass::v_e_m_per_s, 1>, 8, kKm, kKm, false, velocity},
      {"ay_e_m_per_s2", axis_of<Glonass, &Glonass::lunisolar_e_m_per_s2, 1>, 9, kKm, kKm, false, acceleration},
      {"z_e_m", axis_of<Glonass, &Glonass::r_e_m, 2>, 11, kKm, kKm, false, position},
      {"vz_e_m_per_s", axis_of<Glonass, &Glonass::v_e_m_per_s, 2>, 12, kKm, kKm, false, velocity},
      {"az_e_m_per_s2", axis_of<Glonass, &Glonass::lunisolar_e_m_per_s2, 2>, 13, kKm, kKm, false, acceleration},
      {"delta_tau_s", of<Glonass, &Glonass::delta_tau_s>, 16, 1.0, 1.0, false, {twos(5, -30)}},
  };
}

/// The number that the bits of `value` stand for, in the unit of the member.
template <class Message>
void round_to_bits(const MessageField<Message>& field, const Coding& coding, Sign sign, Message& message) {
  double& value = field.of(message);
  value = coding.bits == 0
              ? 0.0
              : static_cast<double>(broadcast_number(field, coding, sign, value)) * coding.lsb * field.air_unit;
}

}  // namespace

const std::vector<MessageField<KeplerianEphemeris>>& keplerian_fields() {
  static const auto kFields = make_keplerian_fields();
  return kFields;
}

const std::vector<MessageField<GlonassEphemeris>>& glonass_fields() {
  static const auto kFields = make_glonass_fields();
  return kFields;
}

const Coding& coding_of(const MessageField<KeplerianEphemeris>& field, KeplerianMessage message) {
  return field.codings[family(message)];
}

const Coding& coding_of(const MessageField<GlonassEphemeris>& field) { return field.codings.front(); }

template <class Message>
std::int64_t broadcast_number(const MessageField<Message>& field, const Coding& coding, Sign sign, double value) {
  const std::int64_t count = std::int64_t{1} << (coding.is_signed ? coding.bits - 1 : coding.bits);
  const std::int64_t least = !coding.is_signed ? 0 : sign == Sign::Magnitude ? 1 - count : -count;
  double counted = std::nearbyint(value / field.air_unit / coding.lsb);
  if (field.wraps) {
    counted = std::remainder(counted, 2.0 * static_cast<double>(count));
    if (counted == static_cast<double>(count)) counted = -counted;  // half a turn is minus half a turn
  }
  if (!(counted >= static_cast<double>(least) && counted < static_cast<double>(count))) {
    const double unit = coding.lsb * field.air_unit;
    throw std::range_error(std::string(field.name) + ": is " + std::to_string(value / unit) +
                           " units of the message, " + "which has " + std::to_string(least) + " to " +
                           std::to_string(count - 1));
  }
  return static_cast<std::int64_t>(counted);
}

template std::int64_t broadcast_number(const MessageField<KeplerianEphemeris>&, const Coding&, Sign, double);
template std::int64_t broadcast_number(const MessageField<GlonassEphemeris>&, const Coding&, Sign, double);

KeplerianEphemeris as_broadcast(const KeplerianEphemeris& ephemeris) {
  KeplerianEphemeris rounded = ephemeris;
  for (const auto& field : keplerian_fields()) {
    round_to_bits(field, coding_of(field, ephemeris.message), Sign::TwosComplement, rounded);
  }
  return rounded;
}

GlonassEphemeris as_broadcast(const GlonassEphemeris& ephemeris) {
  GlonassEphemeris rounded = ephemeris;
  for (const auto& field : glonass_fields()) round_to_bits(field, coding_of(field), Sign::Magnitude, rounded);
  return rounded;
}

std::int64_t reference_time_unit_s(KeplerianMessage message) { return kReferenceUnits_s.at(family(message)); }

}  // namespace inslab::broadcast
