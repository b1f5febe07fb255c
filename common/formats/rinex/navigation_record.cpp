#include "inslab/formats/rinex/navigation_record.hpp"

#include <cmath>

#include "inslab/data/broadcast/message_field.hpp"
#include "inslab/data/broadcast/system_time.hpp"
#include "inslab/formats/rinex/rinex_lines.hpp"
#include "inslab/foundation/files/file_error.hpp"

namespace inslab::rinex {

namespace {

constexpr std::size_t kNumberWidth = 19;  // of a number
constexpr double kUnknown = 9.0e8;        // and above: what writers put where they do not know
constexpr std::int64_t kDay_ns = 86400 * time::kNsPerSecond;

// RINEX 3.05, tables A5 to A14: places of what is no number of the message's tables.
constexpr int kIssue = 3, kToe = 11, kSources = 20, kAccuracy = 23, kHealth = 24, kIssueOfClock = 26, kSent = 27,
              kAgeOfClock = 28;
constexpr int kGlonassSent = 2, kGlonassHealth = 6, kGlonassChannel = 10, kGlonassAge = 14;

/// The line of a record that a place stands in, and its column there, in numbers.
std::pair<std::size_t, std::size_t> line_and_column(int place) {
  const auto shifted = static_cast<std::size_t>(place + 1);  // the epoch takes the first number's place
  return {shifted / 4, shifted % 4};
}

/// I/NAV or F/NAV by what a Galileo record says of its clock and its sources (RINEX 3.05, table A8): bit 9 the clock of
/// E1 and E5b, bit 8 that of E1 and E5a, bits 0 and 2 I/NAV of E1 and E5b, bit 1 F/NAV.
KeplerianMessage galileo_message(std::uint32_t sources) {
  if ((sources & 0x200U) != 0) return KeplerianMessage::Inav;
  if ((sources & 0x100U) != 0) return KeplerianMessage::Fnav;
  return (sources & 0x5U) == 0 && (sources & 0x2U) != 0 ? KeplerianMessage::Fnav : KeplerianMessage::Inav;
}

KeplerianMessage message_of(const RecordLines& record, const SatelliteId& satellite) {
  switch (satellite.system) {
    case GnssSystem::Galileo:
      return galileo_message(record.count_at(kSources, "data sources"));
    case GnssSystem::BeiDou:
      return is_beidou_geostationary(satellite) ? KeplerianMessage::D2 : KeplerianMessage::D1;
    default:
      return KeplerianMessage::Lnav;
  }
}

/// The time of that many seconds of a week of the system, nearest to `near`.
time::GpsTime in_week(GnssSystem system, const time::GpsTime& near, double seconds) {
  const time::Nanoseconds behind = broadcast::behind_gps(system);
  return broadcast::nearest_in_week(near + -behind, time::from_seconds(seconds).count()) + behind;
}

/// From a time to those seconds, the way round the day that is shorter: of the day in version 2, of the week since.
time::Nanoseconds late_in_day(const time::GpsTime& calendar, double seconds) {
  const std::int64_t late_ns = (time::from_seconds(seconds).count() - calendar.time_of_week_ns) % kDay_ns;
  const std::int64_t turns = late_ns > kDay_ns / 2 ? -1 : late_ns < -kDay_ns / 2 ? 1 : 0;
  return time::Nanoseconds(late_ns + turns * kDay_ns);
}

std::string place_text(int place) { return "number " + std::to_string(place + 1) + " of the record"; }

}  // namespace

void RecordLines::refuse(std::size_t line_of_record, const std::string& why) const {
  throw files::ReadError(path + ": line " + std::to_string(line + line_of_record) + ": " + why);
}

std::optional<double> RecordLines::at(int place) const {
  const auto [row, column] = line_and_column(place);
  if (row >= texts.size()) return std::nullopt;
  const std::string_view text = field_at(texts[row], indent + column * kNumberWidth, kNumberWidth);
  if (text.empty()) return std::nullopt;
  const auto number = fortran_number(text);
  if (!number) refuse(row, "has '" + std::string(text) + "' for " + place_text(place) + "; expected a number");
  return number;
}

std::optional<double> RecordLines::known_at(int place) const {
  const auto number = at(place);
  return number && std::abs(*number) < kUnknown ? number : std::nullopt;
}

double RecordLines::required(int place, std::string_view name) const {
  const auto number = at(place);
  if (number) return *number;
  const std::size_t row = line_and_column(place).first;
  refuse(std::min(row, texts.size() - 1), "lacks " + place_text(place) + ", " + std::string(name));
}

std::uint32_t RecordLines::count_at(int place, std::string_view name) const {
  const double number = at(place).value_or(0.0);
  if (std::abs(number) >= kUnknown) return 0;
  if (number >= 0.0 && number <= 4294967295.0 && number == std::floor(number))
    return static_cast<std::uint32_t>(number);
  refuse(line_and_column(place).first, "has " + std::to_string(number) + " for " + place_text(place) + ", " +
                                           std::string(name) + "; expected a whole number from 0 on");
}

time::GpsTime RecordLines::calendar() const {
  const std::string_view text = field_at(texts.front(), calendar_begin, calendar_width);
  const auto calendar = calendar_from(text);
  if (!calendar)
    refuse(0, "begins with the time '" + std::string(text) + "'; expected year, month, day, hour, minute, second");
  return *calendar;
}

KeplerianEphemeris keplerian_from(const RecordLines& record, const SatelliteId& satellite,
                                  std::optional<KeplerianMessage> message) {
  const GnssSystem system = satellite.system;
  KeplerianEphemeris e;
  e.satellite = satellite;
  e.message = message ? *message : message_of(record, satellite);
  e.toc = record.calendar() + broadcast::behind_gps(system);
  for (const auto& field : broadcast::keplerian_fields()) {
    if (coding_of(field, e.message).bits != 0) {
      field.of(e) = record.required(field.rinex_place, field.name) * field.rinex_unit;
    }
  }
  if (!(e.eccentricity >= 0.0 && e.eccentricity < 0.9)) {
    record.refuse(2, "has the eccentricity " + std::to_string(e.eccentricity) + "; expected 0 to 0.9");
  }
  if (!(e.sqrt_a_sqrt_m > 2500.0 && e.sqrt_a_sqrt_m < 8192.0)) {
    record.refuse(2, "has the root of the semi-major axis " + std::to_string(e.sqrt_a_sqrt_m) +
                         "; expected 2500 to 8192 m^(1/2)");
  }
  const double toe_s = record.required(kToe, "toe");
  if (!(toe_s >= 0.0 && toe_s <= 604800.0)) {
    record.refuse(3, "has toe " + std::to_string(toe_s) + "; expected seconds of a week");
  }
  e.toe = in_week(system, e.toc, toe_s);
  const auto sent_s = record.known_at(kSent);
  e.transmitted = sent_s ? in_week(system, e.toc, *sent_s) : e.toc;
  e.accuracy_m = record.at(kAccuracy).value_or(0.0);
  e.issue = record.count_at(kIssue, "the issue of the ephemeris");
  e.health = record.count_at(kHealth, "health");
  if (e.message == KeplerianMessage::Lnav) e.issue_of_clock = record.count_at(kIssueOfClock, "the issue of the clock");
  if (system == GnssSystem::BeiDou) e.issue_of_clock = record.count_at(kAgeOfClock, "the age of the clock's data");
  return e;
}

GlonassEphemeris glonass_from(const RecordLines& record, const SatelliteId& satellite) {
  GlonassEphemeris e;
  e.satellite = satellite;
  const time::GpsTime calendar = record.calendar();
  e.tb = from_utc(calendar);
  for (const auto& field : broadcast::glonass_fields()) {
    // Delay and what follows it came with version 3.05; until then a record has three lines.
    constexpr int kLastOfThreeLines = 14;
    const double number = field.rinex_place <= kLastOfThreeLines ? record.required(field.rinex_place, field.name)
                                                                 : record.at(field.rinex_place).value_or(kUnknown);
    field.of(e) = std::abs(number) >= kUnknown ? 0.0 : number * field.rinex_unit;
  }
  const auto sent_s = record.known_at(kGlonassSent);
  e.transmitted = sent_s ? e.tb + late_in_day(calendar, *sent_s) : e.tb;
  e.health = record.count_at(kGlonassHealth, "health");
  e.age_days = record.count_at(kGlonassAge, "the age of the data");
  const double channel = record.required(kGlonassChannel, "the frequency channel");
  // Writers that count channels 1 to 24 mean something else; -7 to 6 are in use, up to 13 were.
  if (!(channel >= -7.0 && channel <= 13.0 && channel == std::floor(channel))) {
    record.refuse(2, "has the frequency channel " + std::to_string(channel) + "; expected -7 to 13");
  }
  e.channel = static_cast<std::int32_t>(channel);
  return e;
}

BroadcastIonosphere ionosphere_from(const RecordLines& record, GnssSystem system) {
  BroadcastIonosphere ionosphere{system, {}, {}};
  for (int i = 0; i < 4; ++i) {
    ionosphere.alpha[static_cast<std::size_t>(i)] = record.required(i, "alpha of the ionosphere");
    ionosphere.beta[static_cast<std::size_t>(i)] = record.required(i + 4, "beta of the ionosphere");
  }
  return ionosphere;
}

}  // namespace inslab::rinex
