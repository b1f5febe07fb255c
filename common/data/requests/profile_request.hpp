#pragma once

#include "inslab/foundation/fields/field.hpp"

namespace inslab {
inline namespace samples {

enum class SensorKind : std::uint32_t { Imu, Gnss, Magnetometer, Barometer, Odometer, Heading, AirData };
enum class ProfileKind : std::uint32_t {
  ImuError,
  Vibration,
  Installation,
  GnssError,
  Fault,
  MagnetometerError,
  BarometerError,
  OdometerError,
  HeadingError,
  AirDataError,
};
enum class Continuity : std::uint32_t { Keep, Reset, Redraw };

template <>
struct EnumNames<SensorKind> {
  static constexpr std::string_view type = "SensorKind";
  static constexpr std::string_view prefix = "SENSOR_";
  static constexpr std::array<std::string_view, 7> values{"imu",      "gnss",    "magnetometer", "barometer",
                                                          "odometer", "heading", "air_data"};
};
template <>
struct EnumNames<ProfileKind> {
  static constexpr std::string_view type = "ProfileKind";
  static constexpr std::string_view prefix = "PROFILE_";
  static constexpr std::array<std::string_view, 10> values{
      "imu_error",          "vibration",       "installation",   "gnss_error",    "fault",
      "magnetometer_error", "barometer_error", "odometer_error", "heading_error", "air_data_error"};
};
template <>
struct EnumNames<Continuity> {
  static constexpr std::string_view type = "Continuity";
  static constexpr std::string_view prefix = "CONTINUITY_";
  static constexpr std::array<std::string_view, 3> values{"keep", "reset", "redraw"};
};

/// One sensor of a unit.
struct SensorAddress {
  SensorKind kind = SensorKind::Imu;
  std::uint32_t number = 0;

  friend bool operator==(const SensorAddress& a, const SensorAddress& b) {
    return a.kind == b.kind && a.number == b.number;
  }
};

/// What a request to swap a profile says besides the parameters, and what the journal adds to it.
struct ProfileRequest {
  std::uint64_t request_id = 0;   ///< chosen by the requester; comes back in the acks
  std::int64_t apply_at_ns = -1;  ///< sim time; negative: as soon as possible; settled by the journal
  Continuity continuity = Continuity::Keep;
  double fade_s = 0.0;                 ///< vibration only
  std::uint32_t journal_number = 0;    ///< set by the journal, counted from 1 across the kinds
  std::int64_t requested_at_ns = -1;   ///< set by the journal: what apply_at_ns was in the request
  bool requested_in_the_past = false;  ///< set by the journal

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("request_id", "chosen by the requester; comes back in the acknowledgements"), self.request_id);
    visit(Field("apply_at_ns", "sim time at which it takes effect; negative: as soon as possible"), self.apply_at_ns);
    visit(Field("continuity", "what happens to the states of the random processes"), self.continuity);
    visit(Field("fade_s", "vibration only: length of the smooth fade from the old profile to the new").in(0.0, 60.0),
          self.fade_s);
    visit(Field("journal_number", "0 in a request; set by the journal").wire_only(), self.journal_number);
    visit(Field("requested_at_ns", "set by the journal: what apply_at_ns was in the request").wire_only(),
          self.requested_at_ns);
    visit(Field("requested_in_the_past", "false in a request; set by the journal").wire_only(),
          self.requested_in_the_past);
  }
};

/// The fields that begin every profile: whom it is for, and the request. Wire only; a profile file has none of it.
template <class Self, class Visitor>
void profile_head_fields(Self& self, Visitor& visit) {
  visit(Field("target_kind", "imu, gnss, magnetometer, barometer, odometer, heading or air_data").key().wire_only(),
        self.target.kind);
  visit(Field("target_number", "the sensor's number").key().wire_only(), self.target.number);
  visit(Field("request").wire_only(), self.request);
  visit(Field("name", "a word for the log").at_most(64), self.name);
}

}  // namespace samples
}  // namespace inslab
