#pragma once

#include <vector>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/gnss/gnss_model.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/geodesy.hpp"

/// A receiver under test, and vehicles to put it on.
namespace inslab::gnss::test {

inline constexpr std::int64_t kTruthNs = 5000000;

/// A vehicle that turns about a fixed axis of v at `rate_v` (relative to e) while its reference point rests in e.
inline TruthState spinning(std::int64_t time_ns, const Vector3& rate_v, const Quaternion& q_nv_at_start) {
  TruthState truth;
  truth.header.sim_time_ns = time_ns;
  truth.interval_ns = kTruthNs;
  truth.latitude_rad = 0.53;
  truth.longitude_rad = 1.996;
  truth.height_m = 20.0;
  const double t = time::to_seconds(time_ns);
  truth.q_nv = nav::canonical(q_nv_at_start * nav::quaternion_from_rotation_vector(rate_v * t));
  truth.omega_iv_v = rate_v + truth.q_nv.conjugate() * nav::omega_ie_n(truth.latitude_rad);
  return truth;
}

/// A vehicle at rest, level, pointing north.
inline TruthState at_rest(std::int64_t time_ns) { return spinning(time_ns, Vector3::Zero(), Quaternion::Identity()); }

/// A perfect receiver on a truth of 200 Hz.
inline GnssModel::Setup setup(double gnss_hz = 5.0) {
  GnssModel::Setup s{42, 0, time::Rate(gnss_hz), {}, {}, {}, {}};
  s.installation.target.kind = SensorKind::Gnss;
  return s;
}

/// The fixes at rest.
inline std::vector<GnssFix> run(GnssModel model, double duration_s) {
  std::vector<GnssFix> fixes;
  const auto samples = static_cast<std::int64_t>(duration_s * 200.0);
  for (std::int64_t k = 0; k <= samples; ++k) {
    if (auto fix = model.observe(at_rest(k * kTruthNs))) fixes.push_back(*fix);
  }
  return fixes;
}

/// Of a fix whose antenna is at the vehicle's reference point.
inline Vector3 position_error_ned(const GnssFix& fix, const TruthState& truth) {
  return nav::ned_from(geodetic_of(truth), geodetic_of(fix));
}

}  // namespace inslab::gnss::test
