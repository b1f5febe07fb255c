#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "inslab/data/broadcast/gnss_signal.hpp"
#include "inslab/formats/rinex/rinex_navigation.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/text_lines.hpp"
#include "inslab/models/satellites/group_delay.hpp"
#include "inslab/referee/verify/raw_gnss_block.hpp"
#include "inslab/referee/verify/simulator_log.hpp"

namespace inslab::verify {

namespace {

namespace stdfs = std::filesystem;
constexpr double kLightSpeed_m_per_s = broadcast::kSpeedOfLight_m_per_s;
const satellites::Vector3 kReceiver_e_m(-481819.31349724, 5507219.95375401, 3170373.73538364);

/// One row: a simulator's signal.
struct RangeRow {
  const char* name;
  GnssSystem system;
  const char* rinex;
  const char* skydel;  ///< how its files begin
};

// Not Galileo's E5a: this simulator has one clock with both rules of delay, so its E1 and E5a do not belong together.
constexpr std::array<RangeRow, 8> kSkydelRows{{{"Skydel, GPS L1 C/A", GnssSystem::Gps, "1C", "L1CA"},
                                               {"Skydel, GPS L2C", GnssSystem::Gps, "2L", "L2C"},
                                               {"Skydel, GPS L5", GnssSystem::Gps, "5Q", "L5"},
                                               {"Skydel, Galileo E1", GnssSystem::Galileo, "1C", "E1"},
                                               {"Skydel, Galileo E5b", GnssSystem::Galileo, "7Q", "E5b"},
                                               {"Skydel, BeiDou B1I, medium, inclined", GnssSystem::BeiDou, "2I", "B1"},
                                               {"Skydel, BeiDou B2I, medium, inclined", GnssSystem::BeiDou, "7I", "B2"},
                                               {"Skydel, QZSS L1 C/A", GnssSystem::Qzss, "1C", "QZSSL1CA"}}};

/// What a row's signals are apart, at most.
struct Apart {
  int samples = 0;
  double range_m = 0.0, rate_m_per_s = 0.0;
};

using Messages = std::map<SatelliteId, std::vector<KeplerianEphemeris>>;

Messages read_messages(const std::string& folder) {
  Messages messages;
  for (const auto& entry : stdfs::directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.path().extension() == ".md") continue;
    for (const auto& record : rinex::read_navigation(entry.path().string()).keplerian) {
      messages[record.ephemeris.satellite].push_back(record.ephemeris);
    }
  }
  return messages;
}

/// The message that a simulator reckons with: the newest at the instant.
const KeplerianEphemeris* newest(const Messages& messages, const SatelliteId& satellite, const time::GpsTime& gps) {
  const auto found = messages.find(satellite);
  if (found == messages.end()) return nullptr;
  const KeplerianEphemeris* newest = nullptr;
  for (const KeplerianEphemeris& e : found->second) {
    const bool is_past = (gps - e.toe).count() >= 0;
    if (is_past && (newest == nullptr || (e.toe - newest->toe).count() > 0)) newest = &e;
  }
  return newest != nullptr ? newest : &found->second.front();
}

void compare_range(const RangeRow& row, const SimulatedRange& logged, const KeplerianEphemeris& e,
                   const RawGnssSubjects& subjects, Apart& apart) {
  const time::Nanoseconds before = satellites::usual_light_time(e.sqrt_a_sqrt_m * e.sqrt_a_sqrt_m);
  const satellites::Sight sight = subjects.sight({subjects.state(e, logged.gps + -before), before},
                                                 {logged.gps, 0.0, kReceiver_e_m, satellites::Vector3::Zero()});
  const double range_m = kLightSpeed_m_per_s * sight.light_time_s;
  const double delay_s = satellites::group_delay_s(broadcast::gnss_signal(row.system, row.rinex), e);
  const double pseudorange_m = range_m + kLightSpeed_m_per_s * (delay_s - sight.clock_s);
  const double rate_m_per_s =
      kLightSpeed_m_per_s * (sight.light_time_rate - sight.drift_s_per_s * (1.0 - sight.light_time_rate));
  const double off_m = std::max(std::abs(range_m - logged.range_m), std::abs(pseudorange_m - logged.pseudorange_m));
  ++apart.samples;
  apart.range_m = std::max(apart.range_m, off_m);
  apart.rate_m_per_s = std::max(apart.rate_m_per_s, std::abs(rate_m_per_s - logged.rate_m_per_s));
}

void add_row(const RangeRow& row, const std::vector<SimulatedRange>& logged, const Messages& messages,
             const RawGnssSubjects& subjects, Table& table) {
  constexpr double kRange_m = 0.5e-3, kRate_m_per_s = 1e-4;
  Apart apart;
  for (const SimulatedRange& range : logged) {
    // The simulator's geostationary satellites of BeiDou lack their 5 deg.
    if (range.satellite.system != row.system || is_beidou_geostationary(range.satellite)) continue;
    const KeplerianEphemeris* e = newest(messages, range.satellite, range.gps);
    if (e != nullptr) compare_range(row, range, *e, subjects, apart);
  }
  table.rows.push_back({{row.name, std::to_string(apart.samples), fmt::format("{:.3f}", 1000.0 * apart.range_m),
                         fmt::format("{:.1f}", 1000.0 * kRange_m), fmt::format("{:.1e}", apart.rate_m_per_s),
                         fmt::format("{:.0e}", kRate_m_per_s)},
                        apart.samples > 0 && apart.range_m <= kRange_m && apart.rate_m_per_s <= kRate_m_per_s});
}

/// 12 of "E1 12.csv".
std::uint8_t satellite_number(const stdfs::path& file) {
  const std::string stem = file.stem().string();
  const auto number = files::integer_from(std::string_view(stem).substr(stem.find(' ') + 1));
  if (number && *number >= 1 && *number <= 99) return static_cast<std::uint8_t>(*number);
  throw files::ReadError(file.string() + ": is named after no satellite; expected a number from 1 to 99 after a space");
}

/// All files of one signal, "E1 12.csv".
std::vector<SimulatedRange> read_skydel_signal(const std::string& folder, const RangeRow& row) {
  std::vector<SimulatedRange> all;
  const std::string begin = std::string(row.skydel) + " ";
  for (const auto& entry : stdfs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.substr(0, begin.size()) != begin) continue;
    const auto number = satellite_number(entry.path());
    const auto ranges = read_skydel(entry.path().string(), {row.system, number}, row.rinex);
    all.insert(all.end(), ranges.begin(), ranges.end());
  }
  return all;
}

}  // namespace

Table raw_gnss_ranges(const std::string& folder, const RawGnssSubjects& subjects) {
  Table table;
  table.title = "Pseudoranges against a commercial simulator without errors, largest difference";
  table.columns = {"", "samples", "range, mm", "limit", "rate, m/s", "limit"};
  const std::string simulators = folder + "/simulators/";
  const std::string skydel = simulators + "Skydel_static_duration-4h_rate-5min_sys-GERCQIS";
  if (stdfs::exists(skydel)) {
    const Messages messages = read_messages(skydel);
    for (const RangeRow& row : kSkydelRows) {
      add_row(row, read_skydel_signal(skydel + "/Iono-none_tropo-none/sat_data", row), messages, subjects, table);
    }
  } else {
    table.left_out.emplace_back("ranges of Skydel (its logs in simulators)");
  }
  table.judged = !table.rows.empty();
  table.notes.push_back(
      "Geometric ranges and pseudoranges, by the messages that it broadcast, of which the newest counts.");
  return table;
}

}  // namespace inslab::verify
