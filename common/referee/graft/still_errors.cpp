#include "inslab/referee/graft/still_errors.hpp"

#include "inslab/nav/attitude.hpp"
#include "inslab/nav/gravity.hpp"
#include "inslab/nav/strapdown.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::graft {
namespace {

using nav::Vector3;

nav::StaticMeans means_of(const RecordedErrors& measured) {
  nav::StaticMeans means;
  Vector3 force_squares = Vector3::Zero();
  const double dt_s = measured.rate.period_s();
  const auto force = [dt_s](const RecordedErrors::Increments& i) -> Vector3 {
    return Vector3(i[3], i[4], i[5]) / dt_s;
  };
  const Vector3 first = force(measured.intervals.front());
  for (const RecordedErrors::Increments& i : measured.intervals) {
    means.omega_ib_b += Vector3(i[0], i[1], i[2]) / dt_s;
    const Vector3 off = force(i) - first;
    means.f_b += off;
    force_squares += off.cwiseAbs2();
  }
  const auto count = static_cast<double>(measured.intervals.size());
  means.omega_ib_b /= count;
  means.f_b /= count;
  means.f_spread_b = (force_squares / count - means.f_b.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
  means.f_b += first;
  return means;
}

}  // namespace

std::variant<StillErrors, std::string> still_errors(const RecordedErrors& measured, const StillSite& site) {
  const Vector3 g_n = nav::Gravity(nav::GravityModel::Normal).g_n(site.position);
  const nav::StaticMeans means = means_of(measured);
  const auto aligned = site.feels_the_earth_turn
                           ? nav::coarse_alignment(means, site.position.latitude_rad, g_n.norm(), site.limits)
                           : nav::levelled(means, 0.0, g_n.norm(), site.limits);
  if (const auto* refusal = std::get_if<std::string>(&aligned)) return *refusal;
  StillErrors still;
  still.C_nb = std::get<nav::Matrix3>(aligned);
  const double latitude_rad = site.position.latitude_rad;
  const Vector3 omega_ie_n =
      nav::wgs84::omega_e_rad_per_s * Vector3(std::cos(latitude_rad), 0.0, -std::sin(latitude_rad));
  const Vector3 omega_b = still.C_nb.transpose() * omega_ie_n;
  const Vector3 f_b = -(still.C_nb.transpose() * g_n);
  still.errors.rate = measured.rate;
  still.errors.intervals.reserve(measured.intervals.size());
  for (std::size_t k = 0; k < measured.intervals.size(); ++k) {
    const double dt_s = time::to_seconds(measured.rate.at(k + 1) - measured.rate.at(k));
    RecordedErrors::Increments errors = measured.intervals[k];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      errors[axis] -= omega_b[static_cast<Eigen::Index>(axis)] * dt_s;
      errors[axis + 3] -= f_b[static_cast<Eigen::Index>(axis)] * dt_s;
    }
    still.errors.intervals.push_back(errors);
  }
  return still;
}

}  // namespace inslab::graft
