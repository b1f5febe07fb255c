#pragma once

#include "inslab/data/samples/stream_header.hpp"
#include "inslab/foundation/units/units.hpp"

namespace inslab {
inline namespace samples {

enum class FixType : std::uint32_t { None, Single, Differential, Float, Fixed };

template <>
struct EnumNames<FixType> {
  static constexpr std::string_view type = "FixType";
  static constexpr std::string_view prefix = "FIX_";
  static constexpr std::array<std::string_view, 5> values{"none", "single", "differential", "float", "fixed"};
};

/// Which journal entry each part of a fix was made under; 0 is what the scenario began with.
struct GnssRevisions {
  std::uint32_t gnss_error = 0;
  std::uint32_t installation = 0;
  std::uint32_t fault = 0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("gnss_error"), self.gnss_error);
    visit(Field("installation"), self.installation);
    visit(Field("fault"), self.fault);
  }
};

/// Position and velocity of the antenna phase centre as a receiver reports them (idl/gnss.idl).
struct GnssFix {
  StreamHeader header;  ///< sim_time_ns is the time of validity
  std::uint32_t sensor_number = 0;
  std::int64_t available_sim_time_ns = 0;
  FixType fix_type = FixType::None;
  double latitude_rad = 0.0;
  double longitude_rad = 0.0;
  double height_m = 0.0;
  Vector3 v_n = Vector3::Zero();  ///< m/s
  Vector3 position_sigma_ned_m = Vector3::Zero();
  Vector3 velocity_sigma_ned_m_per_s = Vector3::Zero();
  std::uint32_t satellites_used = 0;
  double hdop = 0.0;
  double vdop = 0.0;
  double pdop = 0.0;
  GnssRevisions revisions;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    constexpr double kQuarterTurn = 0.5 * units::kPi;
    visit(Field("header"), self.header);
    visit(Field("sensor_number"), self.sensor_number);
    visit(Field("available_sim_time_ns"), self.available_sim_time_ns);
    visit(Field("fix_type"), self.fix_type);
    visit(Field("latitude_rad").measured(-kQuarterTurn, kQuarterTurn), self.latitude_rad);
    visit(Field("longitude_rad").measured(-2.0 * kQuarterTurn, 2.0 * kQuarterTurn), self.longitude_rad);
    visit(Field("height_m").measured(-1000.0, 20000.0), self.height_m);
    visit(Field("v_n_m_per_s").measured(-600.0, 600.0), self.v_n);
    visit(Field("position_sigma_ned_m"), self.position_sigma_ned_m);
    visit(Field("velocity_sigma_ned_m_per_s"), self.velocity_sigma_ned_m_per_s);
    visit(Field("satellites_used"), self.satellites_used);
    visit(Field("hdop"), self.hdop);
    visit(Field("vdop"), self.vdop);
    visit(Field("pdop"), self.pdop);
    visit(Field("revisions"), self.revisions);
  }
};

}  // namespace samples
}  // namespace inslab
