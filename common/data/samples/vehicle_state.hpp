#pragma once

#include "inslab/data/samples/stream_header.hpp"

/// A vehicle that is simulated elsewhere (idl/vehicle.idl).
namespace inslab {
inline namespace samples {

/// What the user's dynamics simulator says of the vehicle at one instant.
struct VehicleState {
  std::uint64_t sequence_number = 0;
  std::int64_t sim_time_ns = 0;
  double latitude_rad = 0.0;
  double longitude_rad = 0.0;
  double height_m = 0.0;
  Vector3 v_n = Vector3::Zero();             ///< m/s, NED, relative to the Earth
  Vector3 a_n = Vector3::Zero();             ///< m/s^2, time derivative of v_n, component by component
  Quaternion q_nv = Quaternion::Identity();  ///< v_n = C(q_nv) v_v
  Vector3 omega_nv_v = Vector3::Zero();      ///< rad/s

  /// Limits of what a simulator may send; the valid domain and the norm of q_nv are judged apart.
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("sequence_number"), self.sequence_number);
    visit(Field("sim_time_ns").in(-1e18, 1e18), self.sim_time_ns);
    visit(Field("latitude_rad").in(-1.58, 1.58), self.latitude_rad);
    visit(Field("longitude_rad").in(-7.0, 7.0), self.longitude_rad);
    visit(Field("height_m").in(-1e6, 1e6), self.height_m);
    visit(Field("v_n_m_per_s").in(-1e4, 1e4), self.v_n);
    visit(Field("a_n_m_per_s2").in(-1e4, 1e4), self.a_n);
    visit(Field("q_nv").in(-1.01, 1.01), self.q_nv);
    visit(Field("omega_nv_v_rad_per_s").in(-200.0, 200.0), self.omega_nv_v);
  }
};

/// A state that the truth was made from; `header` is that of the first truth sample that could depend on it.
struct UsedVehicleState {
  StreamHeader header;
  VehicleState state;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("header"), self.header);
    visit(Field("state"), self.state);
  }
};

/// How well the states came.
struct VehicleLink {
  RunId run_id;
  std::int64_t sim_time_ns = 0;
  std::uint64_t received = 0;
  std::uint64_t used = 0;
  std::uint64_t refused = 0;
  std::uint64_t not_newer = 0;
  std::uint64_t missing = 0;
  std::uint64_t late = 0;
  std::uint64_t returns = 0;
  std::uint64_t truth_samples_extrapolated = 0;
  double longest_extrapolation_s = 0.0;
  std::string last_refusal;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("run_id"), self.run_id);
    visit(Field("sim_time_ns"), self.sim_time_ns);
    visit(Field("received"), self.received);
    visit(Field("used"), self.used);
    visit(Field("refused"), self.refused);
    visit(Field("not_newer"), self.not_newer);
    visit(Field("missing"), self.missing);
    visit(Field("late"), self.late);
    visit(Field("returns"), self.returns);
    visit(Field("truth_samples_extrapolated"), self.truth_samples_extrapolated);
    visit(Field("longest_extrapolation_s"), self.longest_extrapolation_s);
    visit(Field("last_refusal").at_most(160), self.last_refusal);
  }
};

}  // namespace samples
}  // namespace inslab
