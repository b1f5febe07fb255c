#include "inslab/formats/rinex/rinex_navigation.hpp"

#include <algorithm>

#include "inslab/formats/rinex/navigation_record.hpp"
#include "inslab/formats/rinex/rinex_lines.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/input_limits.hpp"
#include "inslab/foundation/files/text_lines.hpp"

namespace inslab::rinex {

namespace {

/// Walks the lines of one file.
class NavigationReader {
 public:
  explicit NavigationReader(const std::string& path) : lines_(path) { file_.path = path; }

  NavigationFile read() {
    read_header();
    while (next_line()) take_line();
    take_record();
    return std::move(file_);
  }

 private:
  bool next_line() { return lines_.next(line_); }

  [[noreturn]] void refuse(const std::string& why) const {
    throw files::ReadError(lines_.path() + ": line " + std::to_string(lines_.number()) + ": " + why);
  }

  void read_header() {
    if (!next_line() || label_of(line_) != "RINEX VERSION / TYPE") {
      refuse("is no header of RINEX; expected RINEX VERSION / TYPE in columns 61 to 80");
    }
    read_version();
    while (next_line()) {
      const std::string_view label = label_of(line_);
      if (label == "END OF HEADER") return;
      if (label == "ION ALPHA") take_ionosphere(GnssSystem::Gps, true, 2);
      if (label == "ION BETA") take_ionosphere(GnssSystem::Gps, false, 2);
      if (label == "IONOSPHERIC CORR") take_ionosphere_of_system();
    }
    refuse("ends in the header; expected END OF HEADER");
  }

  void read_version() {
    const auto version = fortran_number(field_at(line_, 0, 9));
    const std::string_view type = field_at(line_, 20, 1), system = field_at(line_, 40, 1);
    const bool is_old = version && *version >= 2.0 && *version < 3.0;
    if (!is_old && !(version && *version >= 3.0 && *version < 4.01)) {
      refuse("is version '" + std::string(field_at(line_, 0, 9)) +
             "' of RINEX; expected 2.10 to 2.11, 3.00 to 3.05 or 4.00");
    }
    if (type != "N" && !(is_old && type == "G")) {
      refuse("is of the type '" + std::string(type) + "'; expected N, a navigation file");
    }
    file_.version = *version;
    if (is_old) of_file_ = type == "G" || system == "R" ? GnssSystem::Glonass : GnssSystem::Gps;
  }

  /// GPSA, GPSB, BDSA, ... and four numbers; Galileo's three are of another model.
  void take_ionosphere_of_system() {
    const std::string_view name = field_at(line_, 0, 4);
    constexpr std::array<std::pair<std::string_view, GnssSystem>, 3> kNames{
        {{"GPS", GnssSystem::Gps}, {"BDS", GnssSystem::BeiDou}, {"QZS", GnssSystem::Qzss}}};
    for (const auto& [prefix, system] : kNames) {
      if (name.size() == 4 && name.substr(0, 3) == prefix) take_ionosphere(system, name.back() == 'A', 5);
    }
  }

  void take_ionosphere(GnssSystem system, bool is_alpha, std::size_t begin) {
    constexpr std::size_t kWidth = 12;
    BroadcastIonosphere& ionosphere = ionosphere_of(system);
    for (std::size_t i = 0; i < 4; ++i) {
      const std::string_view text = field_at(line_, begin + i * kWidth, kWidth);
      const auto number = fortran_number(text);
      if (!number) refuse("has '" + std::string(text) + "' for the ionosphere; expected four numbers of 12 columns");
      (is_alpha ? ionosphere.alpha : ionosphere.beta)[i] = *number;
    }
  }

  BroadcastIonosphere& ionosphere_of(GnssSystem system) {
    for (BroadcastIonosphere& known : file_.ionosphere) {
      if (known.system == system) return known;
    }
    return file_.ionosphere.emplace_back(BroadcastIonosphere{system, {}, {}});
  }

  bool is_version_4() const { return file_.version >= 4.0; }
  bool is_version_2() const { return file_.version < 3.0; }

  /// Whether a record begins here, and not a further line of one: those are indented.
  bool begins_record() const {
    const std::size_t names = is_version_2() ? 2 : 1;
    return !field_at(line_, 0, names).empty();
  }

  void take_line() {
    if (files::trimmed(line_).empty()) return;
    if (is_version_4() && line_.front() == '>') {
      take_record();
      heading_ = std::string(line_);
      return;
    }
    const bool is_first_of_four = is_version_4() && record_.texts.empty() && !heading_.empty();
    if (!is_version_4() && begins_record()) take_record();
    if (record_.texts.empty()) {
      if (!is_first_of_four && !begins_record()) refuse("stands before the first record; expected a satellite");
      record_.path = file_.path;
      record_.line = lines_.number();
    }
    constexpr std::size_t kMostLines = 16;
    if (record_.texts.size() >= kMostLines) refuse("goes on with a record of 16 lines; expected the next satellite");
    record_.texts.emplace_back(line_);
  }

  /// What has been gathered is a whole record.
  void take_record() {
    if (record_.texts.empty()) return;
    RecordLines record = std::move(record_);
    record_ = {};
    if (is_version_2()) {
      record.indent = record.calendar_begin = 3;
    }
    if (file_.keplerian.size() + file_.glonass.size() >= files::kMaxRowsInMemory) refuse("has too many records");
    if (is_version_4()) {
      take_version_4(record);
    } else {
      const std::string_view name = is_version_2() ? std::string_view(record.texts.front()).substr(0, 2)
                                                   : std::string_view(record.texts.front()).substr(0, 3);
      take_ephemeris(record, is_version_2() ? " " + std::string(name) : std::string(name), std::nullopt);
    }
  }

  /// "> EPH G01 LNAV" and the lines below it.
  void take_version_4(const RecordLines& record) {
    std::vector<std::string_view> words;
    files::split(heading_, ' ', words);
    if (words.size() < 4) record.refuse(0, "follows '" + heading_ + "'; expected > EPH, a satellite and a message");
    const std::string_view kind = words[1], message = words[3];
    if (kind == "ION" && message == "LNAV") {
      if (const auto satellite = satellite_from(words[2])) {
        const BroadcastIonosphere ionosphere = ionosphere_from(record, satellite->system);
        ionosphere_of(satellite->system) = ionosphere;
        return;
      }
    }
    const auto keplerian = enum_named<KeplerianMessage>(message);
    if (kind == "EPH" && (keplerian || message == "FDMA")) {
      take_ephemeris(record, std::string(words[2]), keplerian);
    } else {
      ++file_.other_records;
    }
  }

  /// Whether there is no semi-major axis, or the state is the middle of the Earth.
  static bool is_empty(const RecordLines& record, GnssSystem system) {
    constexpr std::array<int, 3> kPosition{3, 7, 11};
    constexpr int kRootOfAxis = 10;
    const auto is_zero = [&](int place) { return record.at(place) == 0.0; };
    return system == GnssSystem::Glonass ? std::all_of(kPosition.begin(), kPosition.end(), is_zero)
                                         : is_zero(kRootOfAxis);
  }

  void take_ephemeris(const RecordLines& record, const std::string& name, std::optional<KeplerianMessage> message) {
    constexpr std::string_view kNotSimulated = "SI";  // SBAS, NavIC
    const auto satellite = satellite_from(name, of_file_);
    if (!satellite && kNotSimulated.find(name.front()) == std::string_view::npos) {
      record.refuse(0, "begins with '" + name + "'; expected a satellite such as G01");
    }
    if (!satellite) {
      ++file_.other_records;
    } else if (is_empty(record, satellite->system)) {
      ++file_.empty_records;
    } else if (satellite->system == GnssSystem::Glonass) {
      file_.glonass.push_back({glonass_from(record, *satellite), record.line});
    } else {
      file_.keplerian.push_back({keplerian_from(record, *satellite, message), record.line});
    }
  }

  files::TextLines lines_;
  std::string_view line_;
  NavigationFile file_;
  std::optional<GnssSystem> of_file_;  ///< of a file of RINEX 2, whose records name numbers alone
  std::string heading_;                ///< of RINEX 4, above a record
  RecordLines record_;
};

}  // namespace

NavigationFile read_navigation(const std::string& path) { return NavigationReader(path).read(); }

}  // namespace inslab::rinex
