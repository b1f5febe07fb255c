#pragma once

#include "inslab/data/profiles/pulse_errors.hpp"
#include "inslab/data/profiles/recorded_fix_error.hpp"
#include "inslab/data/profiles/solution_rung.hpp"
#include "inslab/data/profiles/time_tag_errors.hpp"
#include "inslab/data/requests/profile_request.hpp"
#include "inslab/data/samples/gnss_fix.hpp"

namespace inslab {
inline namespace samples {

/// How many satellites a receiver uses, and their geometry.
enum class SatelliteModel : std::uint32_t { Stated, Gps, GpsGalileo };

template <>
struct EnumNames<SatelliteModel> {
  static constexpr std::string_view type = "SatelliteModel";
  static constexpr std::string_view prefix = "SATELLITES_";
  static constexpr std::array<std::string_view, 3> values{"stated", "gps", "gps_galileo"};
};

/// The errors of one kind of solution, north, east, down at the antenna: white noise, and first-order Gauss-Markov
/// processes whose sigma is the steady-state standard deviation. What a fix reports is the root of the sum of squares.
struct SolutionErrors {
  Vector3 position_sigma_ned_m = Vector3::Zero();
  Vector3 position_gm_sigma_ned_m = Vector3::Zero();
  Vector3 position_gm_correlation_time_s = Vector3::Zero();
  Vector3 velocity_sigma_ned_m_per_s = Vector3::Zero();
  Vector3 velocity_gm_sigma_ned_m_per_s = Vector3::Zero();
  Vector3 velocity_gm_correlation_time_s = Vector3::Zero();

  Vector3 position_total_sigma_ned_m() const { return root_sum_square(position_sigma_ned_m, position_gm_sigma_ned_m); }
  Vector3 velocity_total_sigma_ned_m_per_s() const {
    return root_sum_square(velocity_sigma_ned_m_per_s, velocity_gm_sigma_ned_m_per_s);
  }

  /// Listed by the structs that are a kind of solution.
  template <class Self, class Visitor>
  static void error_fields(Self& self, Visitor& visit) {
    visit(Field("position_sigma_ned_m", "white position noise: standard deviation north, east, down")
              .in(0.0, 1e4)
              .required(),
          self.position_sigma_ned_m);
    visit(Field("position_gm_sigma_ned_m", "Gauss-Markov position error: steady-state standard deviation").in(0.0, 1e4),
          self.position_gm_sigma_ned_m);
    visit(Field("position_gm_correlation_time_s", "its correlation time; above 0 where sigma is").in(0.0, 1e7),
          self.position_gm_correlation_time_s);
    visit(Field("velocity_sigma_ned_m_per_s", "white velocity noise: standard deviation north, east, down")
              .in(0.0, 1e3)
              .required(),
          self.velocity_sigma_ned_m_per_s);
    visit(Field("velocity_gm_sigma_ned_m_per_s", "Gauss-Markov velocity error: steady-state standard deviation")
              .in(0.0, 1e3),
          self.velocity_gm_sigma_ned_m_per_s);
    visit(Field("velocity_gm_correlation_time_s", "its correlation time; above 0 where sigma is").in(0.0, 1e7),
          self.velocity_gm_correlation_time_s);
  }

 private:
  static Vector3 root_sum_square(const Vector3& a, const Vector3& b) {
    return (a.cwiseAbs2() + b.cwiseAbs2()).cwiseSqrt();
  }
};

/// A solution worse than the profile's own, on the ladder that the receiver climbs after it lost its signals.
struct LesserSolution : SolutionRung, SolutionErrors {
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    SolutionRung::rung_fields(self, visit);
    SolutionErrors::error_fields(self, visit);
  }
};

/// How one GNSS receiver errs: topic inslab/profile/gnss_error and the files of config/profiles/gnss.
struct GnssErrorProfile : SolutionErrors {
  static constexpr ProfileKind kind = ProfileKind::GnssError;

  SensorAddress target{SensorKind::Gnss, 0};
  ProfileRequest request;
  std::string name;
  std::string source;
  FixType fix_type = FixType::Single;
  std::vector<LesserSolution> lesser_solutions;
  double latency_s = 0.0;
  SatelliteModel satellite_model = SatelliteModel::Stated;
  double elevation_mask_deg = 10.0;
  std::uint32_t satellites = 12;
  double hdop = 0.8;
  double vdop = 1.2;
  RecordedFixError recorded_error;
  TimeTagErrors time_tag;
  PulseErrors pps;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    profile_head_fields(self, visit);
    visit(Field("source", "where the figures come from").at_most(256), self.source);
    visit(Field("fix_type", "what the receiver claims at its best").required(), self.fix_type);
    SolutionErrors::error_fields(self, visit);
    visit(Field("lesser_solutions", "worse ones that come after an outage and at random, from the worst up").at_most(4),
          self.lesser_solutions);
    visit(Field("latency_s", "from validity to delivery").in(0.0, 10.0), self.latency_s);
    visit(Field("satellite_model", "where satellites and DOPs come from: stated below, or nominal orbits"),
          self.satellite_model);
    visit(Field("elevation_mask_deg", "nominal orbits: satellites below it are not used").in(0.0, 80.0),
          self.elevation_mask_deg);
    visit(Field("satellites", "stated: reported as used").in(0.0, 200.0), self.satellites);
    visit(Field("hdop", "stated").in(0.0, 99.0), self.hdop);
    visit(Field("vdop", "stated").in(0.0, 99.0), self.vdop);
    visit(Field("recorded_error", "errors of a real receiver, recorded, on top of the others; its outages too")
              .appended(),
          self.recorded_error);
    visit(Field("time_tag", "of the clock that tags the samples").appended(), self.time_tag);
    visit(Field("pps", "the pulse per second").appended(), self.pps);
  }
};

}  // namespace samples
}  // namespace inslab
