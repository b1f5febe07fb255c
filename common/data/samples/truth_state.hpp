#pragma once

#include "inslab/data/samples/stream_header.hpp"

namespace inslab {
inline namespace samples {

/// The vehicle's true state at an instant, with the exact integrals of the interval that ends there (idl/truth.idl).
struct TruthState {
  StreamHeader header;
  double latitude_rad = 0.0;
  double longitude_rad = 0.0;
  double height_m = 0.0;                     ///< above the WGS-84 ellipsoid
  Vector3 v_n = Vector3::Zero();             ///< m/s, NED, relative to the Earth
  Quaternion q_nv = Quaternion::Identity();  ///< v_n = C(q_nv) v_v
  Vector3 omega_iv_v = Vector3::Zero();      ///< rad/s at the instant; at a jump, after it
  Vector3 f_v = Vector3::Zero();             ///< m/s^2 at the instant; at a jump, after it
  Vector3 dtheta_v = Vector3::Zero();        ///< rad, integral of omega_iv_v over the interval
  Vector3 dv_v = Vector3::Zero();            ///< m/s, integral of f_v over the interval, in the moving v axes
  std::int64_t interval_ns = 0;              ///< 0 for sample 0
  std::uint32_t segment_index = 0;
  bool rate_jump = false;               ///< the angular rate jumps at the end of this interval
  std::uint32_t journal_in_effect = 0;  ///< journal entries whose time lies before this sample's

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("header"), self.header);
    visit(Field("latitude_rad"), self.latitude_rad);
    visit(Field("longitude_rad"), self.longitude_rad);
    visit(Field("height_m"), self.height_m);
    visit(Field("v_n_m_per_s"), self.v_n);
    visit(Field("q_nv"), self.q_nv);
    visit(Field("omega_iv_v_rad_per_s"), self.omega_iv_v);
    visit(Field("f_v_m_per_s2"), self.f_v);
    visit(Field("dtheta_v_rad"), self.dtheta_v);
    visit(Field("dv_v_m_per_s"), self.dv_v);
    visit(Field("interval_ns"), self.interval_ns);
    visit(Field("segment_index"), self.segment_index);
    visit(Field("rate_jump"), self.rate_jump);
    visit(Field("journal_in_effect"), self.journal_in_effect);
  }
};

}  // namespace samples
}  // namespace inslab
