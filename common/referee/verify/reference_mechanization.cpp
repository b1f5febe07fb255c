#include <Eigen/Geometry>

#include "inslab/referee/verify/mechanization.hpp"
#include "inslab/referee/verify/reference_earth.hpp"

namespace inslab::verify {

namespace {

namespace earth = reference_earth;

RealMatrix cross_matrix(const RealVector& a) {
  RealMatrix S;
  S << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return S;
}

/// Rodrigues' formula; below 1e-4 rad the series, whose next terms are below 1e-19 there.
RealMatrix rotation(const RealVector& phi) {
  const RealMatrix S = cross_matrix(phi);
  const Real x2 = phi.squaredNorm(), x = std::sqrt(x2);
  const Real first = x < 1e-4L ? 1 - x2 / 6 + x2 * x2 / 120 : std::sin(x) / x;
  const Real second = x < 1e-4L ? (1 - x2 / 12 + x2 * x2 / 360) / 2 : (1 - std::cos(x)) / x2;
  return RealMatrix::Identity() + first * S + second * S * S;
}

struct Interval {
  RealVector dtheta = RealVector::Zero();
  RealVector dv = RealVector::Zero();
  Real dt = 0;  ///< s; 0: there was none
};

Interval interval_of(const nav::ImuIncrements& imu) {
  return {imu.dtheta_b.cast<Real>(), imu.dv_b.cast<Real>(), static_cast<Real>(imu.dt_s)};
}

/// Rates of the Earth and of n at a place, rad/s: (2-25)..(2-28).
struct Rates {
  Rates(Real latitude, Real height, const RealVector& v) {
    const Real s = std::sin(latitude), c = std::cos(latitude);
    ie = RealVector(earth::kOmega_rad_per_s * c, 0, -earth::kOmega_rad_per_s * s);
    const Real east = v.y() / (earth::transverse_m(s) + height);
    en = RealVector(east, -v.x() / (earth::meridian_m(s) + height), -east * s / c);
  }
  RealVector ie, en;
};

class ReferenceMechanization final : public Mechanization {
 public:
  ReferenceMechanization(const nav::NavState& start, bool full_rotation_term,
                         const std::optional<nav::ImuIncrements>& before)
      : full_rotation_term_(full_rotation_term),
        latitude_(start.position.latitude_rad),
        longitude_(start.position.longitude_rad),
        height_(start.position.height_m),
        v_(start.v_n.cast<Real>()),
        C_nb_(start.q_nb.cast<Real>().normalized().toRotationMatrix()) {
    if (!before) return;
    before_ = interval_of(*before);
    dv_n_before_ =
        C_nb_ * before_.dv + RealVector(0, 0, earth::gravity_m_per_s2(std::sin(latitude_), height_)) * before_.dt;
  }

  void advance(const nav::ImuIncrements& imu) override {
    const Interval now = interval_of(imu);
    const Real dt = now.dt;
    const Real share = before_.dt > 0 ? dt * dt / (6 * before_.dt * (before_.dt + dt)) : 0;

    // (2-30), (2-34)..(2-41): the interval's middle, from its start and from the interval before.
    const Real s = std::sin(latitude_);
    const Real middle_latitude = latitude_ + dt / 2 * v_.x() / (earth::meridian_m(s) + height_);
    const Real middle_height = height_ - dt / 2 * v_.z();
    const RealVector middle_v = before_.dt > 0 ? RealVector(v_ + dt / 2 / before_.dt * dv_n_before_) : v_;
    const Rates middle(middle_latitude, middle_height, middle_v);
    const RealVector gravity(0, 0, earth::gravity_m_per_s2(std::sin(middle_latitude), middle_height));

    // (2-29), (2-31)..(2-33)
    RealVector dv_b =
        now.dv + now.dtheta.cross(now.dv) / 2 + share * (before_.dtheta.cross(now.dv) + before_.dv.cross(now.dtheta));
    if (full_rotation_term_) dv_b += now.dtheta.cross(now.dtheta.cross(now.dv)) / 6;
    const RealMatrix half_turned = RealMatrix::Identity() - dt / 2 * cross_matrix(middle.ie + middle.en);
    const RealVector dv_n = half_turned * (C_nb_ * dv_b) + dt * (gravity - (2 * middle.ie + middle.en).cross(middle_v));

    // Position by the mean velocity, radii at the middle; then attitude with the rate of n there.
    const RealVector v = v_ + dv_n / 2;
    const Real height = height_ - dt / 2 * v.z();
    const Real north = dt * v.x() / (earth::meridian_m(std::sin(middle_latitude)) + height);
    const Real half_way = latitude_ + north / 2;
    longitude_ += dt * v.y() / ((earth::transverse_m(std::sin(middle_latitude)) + height) * std::cos(half_way));
    latitude_ += north;
    height_ -= dt * v.z();
    const Rates turning(half_way, height, v);
    C_nb_ = rotation(-dt * (turning.ie + turning.en)) * C_nb_ *
            rotation(now.dtheta + share * before_.dtheta.cross(now.dtheta));

    v_ += dv_n;
    dv_n_before_ = dv_n;
    before_ = now;
  }

  void hold_vertical(double height_m, double v_d_m_per_s) override {
    height_ = height_m;
    dv_n_before_.z() += v_d_m_per_s - v_.z();
    v_.z() = v_d_m_per_s;
  }

  nav::NavState state() const override {
    nav::NavState state;
    state.position = {static_cast<double>(latitude_), static_cast<double>(longitude_), static_cast<double>(height_)};
    state.v_n = v_.cast<double>();
    const Eigen::Quaternion<Real> q(C_nb_);
    state.q_nb = q.normalized().cast<double>();
    return state;
  }

 private:
  bool full_rotation_term_;
  Real latitude_, longitude_, height_;  ///< rad, rad, m
  RealVector v_;                        ///< m/s, in n
  RealMatrix C_nb_;
  Interval before_;
  RealVector dv_n_before_ = RealVector::Zero();
};

}  // namespace

std::unique_ptr<Mechanization> reference_mechanization(const nav::NavState& start, const nav::Gravity& /*gravity*/,
                                                       const nav::Strapdown::Options& options,
                                                       const std::optional<nav::ImuIncrements>& before) {
  return std::make_unique<ReferenceMechanization>(start, options.full_rotation_term, before);
}

}  // namespace inslab::verify
