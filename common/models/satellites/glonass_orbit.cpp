#include "inslab/models/satellites/glonass_orbit.hpp"

#include <cmath>

#include "inslab/models/satellites/turning_gravity.hpp"

namespace inslab::satellites {

namespace {

constexpr OrbitConstants kPz90 = orbit_constants(GnssSystem::Glonass);
constexpr std::int64_t kNode_ns = 30 * time::kNsPerSecond;

}  // namespace

GlonassOrbit::GlonassOrbit(const GlonassEphemeris& ephemeris) : ephemeris_(ephemeris) {
  for (auto& nodes : nodes_) nodes.push_back({ephemeris.r_e_m, ephemeris.v_e_m_per_s});
}

Vector3 GlonassOrbit::acceleration(const Node& node) const {
  return turning_gravity(node.r_e_m, node.v_e_m_per_s, kPz90) + ephemeris_.lunisolar_e_m_per_s2;
}

GlonassOrbit::Node GlonassOrbit::step(const Node& from, double dt_s) const {
  const auto moved = [&](const Node& slope, double h_s) {
    return Node{from.r_e_m + h_s * slope.r_e_m, from.v_e_m_per_s + h_s * slope.v_e_m_per_s};
  };
  const auto slope_at = [&](const Node& node) { return Node{node.v_e_m_per_s, acceleration(node)}; };
  const Node k1 = slope_at(from), k2 = slope_at(moved(k1, 0.5 * dt_s)), k3 = slope_at(moved(k2, 0.5 * dt_s)),
             k4 = slope_at(moved(k3, dt_s));
  return {
      from.r_e_m + dt_s / 6.0 * (k1.r_e_m + 2.0 * k2.r_e_m + 2.0 * k3.r_e_m + k4.r_e_m),
      from.v_e_m_per_s + dt_s / 6.0 * (k1.v_e_m_per_s + 2.0 * k2.v_e_m_per_s + 2.0 * k3.v_e_m_per_s + k4.v_e_m_per_s)};
}

SatelliteState GlonassOrbit::at(const time::GpsTime& gps) {
  const std::int64_t since_tb_ns = (gps - ephemeris_.tb).count();
  const bool is_after = since_tb_ns >= 0;
  auto& nodes = nodes_[is_after ? 1 : 0];
  const auto index = static_cast<std::size_t>(std::abs(since_tb_ns) / kNode_ns);
  const double whole_step_s = time::to_seconds(is_after ? kNode_ns : -kNode_ns);
  while (nodes.size() <= index) nodes.push_back(step(nodes.back(), whole_step_s));
  const Node now = step(nodes[index], time::to_seconds(since_tb_ns % kNode_ns));

  SatelliteState state;
  state.r_e_m = now.r_e_m;
  state.v_e_m_per_s = now.v_e_m_per_s;
  state.a_e_m_per_s2 = acceleration(now);
  state.clock_s = -ephemeris_.tau_s + ephemeris_.gamma * time::to_seconds(since_tb_ns);
  state.drift_s_per_s = ephemeris_.gamma;
  return state;
}

}  // namespace inslab::satellites
