#pragma once

#include "inslab/data/profiles/time_tag_errors.hpp"
#include "inslab/data/requests/profile_request.hpp"

namespace inslab {
inline namespace samples {

/// A corner of the field that currents on board make at the sensor.
struct CurrentField {
  double at_s = 0.0;
  Vector3 B_b_nt = Vector3::Zero();

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("at_s", "sim time").in(0.0, 1e9).required(), self.at_s);
    visit(Field("B_b_nt", "along the sensor's axes").in(-1e6, 1e6).required(), self.B_b_nt);
  }
};

/// Iron that stands somewhere and is magnetic as a ball is: a bridge, a parked car, a mooring.
struct MagneticBody {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double height_m = 0.0;
  double radius_m = 1.0;
  Vector3 moment_ned_a_m2 = Vector3::Zero();

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("latitude_deg", "of its centre").in(-90.0, 90.0).required(), self.latitude_deg);
    visit(Field("longitude_deg", "of its centre").in(-180.0, 180.0).required(), self.longitude_deg);
    visit(Field("height_m", "of its centre, above the ellipsoid").in(-1000.0, 1e5).required(), self.height_m);
    visit(Field("radius_m", "inside it the field is that of its middle").in(0.01, 1000.0), self.radius_m);
    visit(Field("moment_ned_a_m2", "its magnetic moment, A m^2").in(-1e8, 1e8).required(), self.moment_ned_a_m2);
  }
};

/// How one magnetometer errs: topic inslab/profile/magnetometer_error and the files of config/profiles/magnetometer.
struct MagnetometerErrorProfile {
  static constexpr ProfileKind kind = ProfileKind::MagnetometerError;

  SensorAddress target{SensorKind::Magnetometer, 0};
  ProfileRequest request;
  std::string name;
  std::string source;
  Vector3 hard_iron_nt = Vector3::Zero();
  Vector9 soft_iron = Vector9::Zero();
  std::vector<CurrentField> currents;
  std::vector<MagneticBody> bodies;
  Vector3 white_sigma_nt = Vector3::Zero();
  Vector3 gm_sigma_nt = Vector3::Zero();
  Vector3 gm_correlation_time_s = Vector3::Zero();
  Vector3 full_scale_nt = Vector3::Zero();
  Vector3 quantization_nt = Vector3::Zero();
  TimeTagErrors time_tag;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    profile_head_fields(self, visit);
    visit(Field("source", "where the figures come from").at_most(256), self.source);
    visit(Field("hard_iron_nt", "field of what is magnetic on board, along the sensor's axes").in(-1e6, 1e6),
          self.hard_iron_nt);
    visit(
        Field("soft_iron",
              "row by row, added to the identity: what the vehicle's iron, scale factors and axes that are not square "
              "do to the field")
            .in(-1.0, 1.0),
        self.soft_iron);
    visit(Field("currents", "field of currents on board: straight lines between these corners").at_most(64),
          self.currents);
    visit(Field("bodies", "iron beside the way").at_most(16), self.bodies);
    visit(Field("white_sigma_nt", "white noise: standard deviation of one sample").in(0.0, 1e5).required(),
          self.white_sigma_nt);
    visit(Field("gm_sigma_nt", "Gauss-Markov error: steady-state standard deviation").in(0.0, 1e5), self.gm_sigma_nt);
    visit(Field("gm_correlation_time_s", "its correlation time; above 0 where sigma is").in(0.0, 1e7),
          self.gm_correlation_time_s);
    visit(Field("full_scale_nt", "largest field an axis puts out; 0: no limit").in(0.0, 1e7), self.full_scale_nt);
    visit(Field("quantization_nt", "field of one count; 0: none").in(0.0, 1e5), self.quantization_nt);
    visit(Field("time_tag", "of the clock that tags the samples").appended(), self.time_tag);
  }
};

}  // namespace samples
}  // namespace inslab
