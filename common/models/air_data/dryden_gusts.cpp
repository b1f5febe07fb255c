#include "inslab/models/air_data/dryden_gusts.hpp"

#include <algorithm>
#include <cmath>

#include "inslab/models/air_data/turbulence_scales.hpp"

namespace inslab::air_data {
namespace {

constexpr double kRootOf3 = 1.7320508075688772;

/// 1 - e^-x (1 + x + x^2/2), which for small x is x^3/6 and lost in the difference: e^-x times the rest of the
/// exponential's series.
double tail_of_exponential(double x) {
  constexpr double kDifferenceIsExact = 2.0;  // it loses one digit
  if (x > kDifferenceIsExact) return 1.0 - std::exp(-x) * (1.0 + x + 0.5 * x * x);
  double term = x * x * x / 6.0, sum = term;
  for (int n = 4; term > 1e-17 * sum; ++n) {
    term *= x / n;
    sum += term;
  }
  return std::exp(-x) * sum;
}

}  // namespace

void LongitudinalGust::advance(std::uint64_t k, double way) {
  x_ = std::exp(-way) * x_ + std::sqrt(-std::expm1(-2.0 * way)) * numbers_.at(k);
}

double TransverseGust::value() const { return z_ + kRootOf3 * dz_; }

void TransverseGust::advance(std::uint64_t k, double way) {
  if (!(way > 0.0)) return;
  const double decay = std::exp(-way);
  // The noise's covariance, and its lower triangular root.
  const double q_zz = 0.25 * tail_of_exponential(2.0 * way);
  const double q_zd = 0.5 * way * way * decay * decay;
  const double q_dd = 0.25 * (-std::expm1(-2.0 * way) + 2.0 * way * (1.0 - way) * decay * decay);
  const double root_z = std::sqrt(q_zz);
  const double root_zd = root_z > 0.0 ? q_zd / root_z : 0.0;
  const double root_d = std::sqrt(std::max(0.0, q_dd - root_zd * root_zd));
  const double w1 = numbers_.at(2 * k), w2 = numbers_.at(2 * k + 1);
  const double z = decay * ((1.0 + way) * z_ + way * dz_);
  dz_ = decay * (-way * z_ + (1.0 - way) * dz_) + root_zd * w1 + root_d * w2;
  z_ = z + root_z * w1;
}

Vector3 DrydenGusts::advance(std::uint64_t k, const WindField& wind, double height_above_ground_m, double way_m) {
  if (wind.turbulence == Turbulence::None || wind.turbulence_scale == 0.0) return Vector3::Zero();
  const TurbulenceScales scales = turbulence_scales(wind.turbulence, height_above_ground_m);
  u_.advance(k, way_m / scales.length_m.x());
  v_.advance(k, way_m / scales.length_m.y());
  w_.advance(k, way_m / scales.length_m.z());
  return wind.turbulence_scale * scales.sigma_m_per_s.cwiseProduct(Vector3(u_.value(), v_.value(), w_.value()));
}

}  // namespace inslab::air_data
