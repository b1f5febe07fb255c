#pragma once

#include "samples/gnss_fix.hpp"
#include "samples/profile_request.hpp"

namespace inslab {
inline namespace samples {

/// How one GNSS receiver errs: topic inslab/profile/gnss_error and the files of config/profiles/gnss.
struct GnssErrorProfile {
  static constexpr ProfileKind kind = ProfileKind::GnssError;

  SensorAddress target{SensorKind::Gnss, 0};
  ProfileRequest request;
  std::string name;
  std::string source;
  FixType fix_type = FixType::Single;
  Vector3 position_sigma_ned_m = Vector3::Zero();
  Vector3 velocity_sigma_ned_m_per_s = Vector3::Zero();
  double latency_s = 0.0;
  std::uint32_t satellites = 12;
  double hdop = 0.8;
  double vdop = 1.2;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    profile_head_fields(self, visit);
    visit(Field("source", "where the figures come from").at_most(256), self.source);
    visit(Field("fix_type", "what the receiver claims").required(), self.fix_type);
    visit(Field("position_sigma_ned_m", "white position noise: standard deviation north, east, down")
              .in(0.0, 1e4)
              .required(),
          self.position_sigma_ned_m);
    visit(Field("velocity_sigma_ned_m_per_s", "white velocity noise: standard deviation north, east, down")
              .in(0.0, 1e3)
              .required(),
          self.velocity_sigma_ned_m_per_s);
    visit(Field("latency_s", "from validity to delivery").in(0.0, 10.0), self.latency_s);
    visit(Field("satellites", "reported as used").in(0.0, 200.0), self.satellites);
    visit(Field("hdop", "reported").in(0.0, 99.0), self.hdop);
    visit(Field("vdop", "reported").in(0.0, 99.0), self.vdop);
  }
};

}  // namespace samples
}  // namespace inslab
