#include "inslab/referee/verify/smoothness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/time/rate.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/geodesy.hpp"

namespace inslab::verify {

namespace {

constexpr std::size_t kWindow = 6;

/// The sample at a joint after the ones before it, newest first.
using Window = std::array<TruthState, kWindow + 1>;

/// What the polynomial through `points` equidistant values says of the next one: sum of (-1)^(i+1) C(points, i) x_(-i).
template <class Value>
auto extrapolated(const Window& window, std::size_t points, Value value) {
  double weight = -1.0;
  auto sum = (0.0 * value(window[1])).eval();
  for (std::size_t i = 1; i <= points; ++i) {
    weight *= -static_cast<double>(points - i + 1) / static_cast<double>(i);
    sum += weight * value(window[i]);
  }
  return sum;
}

void add_joint(const Window& window, JointJumps& largest) {
  const TruthState& now = window[0];
  const auto add = [](double& sofar, double jump) { sofar = std::max(sofar, jump); };
  ++largest.joints;
  add(largest.position_m, extrapolated(window, 4, [&](const TruthState& t) {
                            return nav::ned_from(geodetic_of(now), geodetic_of(t));
                          }).norm());
  const auto five = [&](auto value) { return extrapolated(window, kWindow, value); };
  add(largest.velocity_m_per_s, (five([](const TruthState& t) { return t.v_n; }) - now.v_n).norm());
  // q and -q are the same attitude, and the published sign may change between two samples.
  const Eigen::Vector4d q = five([&](const TruthState& t) {
    return (t.q_nv.coeffs().dot(now.q_nv.coeffs()) < 0.0 ? -1.0 : 1.0) * t.q_nv.coeffs();
  });
  add(largest.attitude_deg, 2.0 * units::kDegPerRad * (now.q_nv.conjugate() * Quaternion(q)).vec().norm());
  add(largest.rate_deg_per_s,
      units::kDegPerRad * (five([](const TruthState& t) { return t.omega_iv_v; }) - now.omega_iv_v).norm());
  add(largest.specific_force_m_per_s2, (five([](const TruthState& t) { return t.f_v; }) - now.f_v).norm());
}

}  // namespace

JointJumps jumps_at_joints(const scenario::Trajectory& trajectory, double duration_s, const TruthOf& truth) {
  const time::Rate rate(200.0);
  const auto model = truth(trajectory, rate);
  const time::Nanoseconds end = std::min(time::from_seconds(duration_s), model->end());
  JointJumps largest;
  Window window;
  std::uint64_t sample = 0, first_of_segment = 0;
  time::Nanoseconds joint{0};
  for (std::size_t next = 1; next < trajectory.segments.size(); ++next) {
    joint += time::from_seconds(trajectory.segments[next - 1].duration_s);
    if (joint > end) break;
    for (; rate.at(sample) < joint; ++sample) {
      std::rotate(window.begin(), window.end() - 1, window.end());
      window[0] = model->advance();
    }
    if (rate.at(sample) != joint || sample - first_of_segment < kWindow) {
      throw std::invalid_argument("joint " + std::to_string(next) + ": no sample hits it, or it follows too soon");
    }
    first_of_segment = sample;
    add_joint(window, largest);
  }
  return largest;
}

}  // namespace inslab::verify
