// A vehicle that casts off so gently that it feels like rest must not be held by zero-velocity updates.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <functional>

#include "inslab/models/navigation/navigation_filter.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/geodesy.hpp"

namespace inslab::navigation {
namespace zero_velocity_test {

constexpr double kDt_s = 0.01;
constexpr std::int64_t kDt_ns = 10'000'000;
const nav::Gravity kGravity;

/// Lies at its berth, then gathers way to the north; its states are the truth of its own increments.
class CastingOff {
 public:
  /// Acceleration to the north, m/s^2, by time, s.
  using Acceleration = std::function<double(double)>;

  CastingOff(double rest_s, double acceleration_m_per_s2)
      : CastingOff([=](double t_s) { return t_s < rest_s ? 0.0 : acceleration_m_per_s2; }) {}
  explicit CastingOff(Acceleration acceleration_m_per_s2)
      : acceleration_m_per_s2_(std::move(acceleration_m_per_s2)),
        strapdown_({{0.98, 0.22, 36.0}, Vector3::Zero(), nav::Quaternion::Identity()}, kGravity, {true}) {}

  nav::NavState state() const { return strapdown_.state(); }
  double time_s() const { return static_cast<double>(k_) * kDt_s; }

  ImuSample next() {
    const nav::NavState now = strapdown_.state();
    const Matrix3 C_bn = nav::matrix_from_quaternion(now.q_nb).transpose();
    const Vector3 omega_ie = nav::omega_ie_n(now.position.latitude_rad);
    const Vector3 omega_en = nav::omega_en_n(now.position, now.v_n);
    const Vector3 a_n(acceleration_m_per_s2_(time_s()), 0.0, 0.0);
    ImuSample sample;
    sample.dtheta_b = kDt_s * (C_bn * (omega_ie + omega_en));
    sample.dv_b = kDt_s * (C_bn * (a_n + (2.0 * omega_ie + omega_en).cross(now.v_n) - kGravity.g_n(now.position)));
    sample.interval_ns = kDt_ns;
    sample.header.sequence_number = k_++;
    sample.header.sim_time_ns = static_cast<std::int64_t>(k_) * kDt_ns;
    strapdown_.advance({sample.dtheta_b, sample.dv_b, kDt_s});
    return sample;
  }

  bool is_fix_time() const { return k_ % 20 == 0; }
  GnssFix fix() const {
    const nav::NavState now = state();
    GnssFix fix;
    fix.header.sim_time_ns = static_cast<std::int64_t>(k_) * kDt_ns;
    fix.fix_type = FixType::Fixed;
    fix.latitude_rad = now.position.latitude_rad;
    fix.longitude_rad = now.position.longitude_rad;
    fix.height_m = now.position.height_m;
    fix.v_n = now.v_n;
    fix.position_sigma_ned_m.setConstant(0.03);
    fix.velocity_sigma_ned_m_per_s.setConstant(0.05);
    return fix;
  }

 private:
  Acceleration acceleration_m_per_s2_;
  nav::Strapdown strapdown_;
  std::uint64_t k_ = 0;
};

/// What the filter errs by, at worst, of its position and of its velocity: squared, over its own covariance.
struct Worst {
  double position = 0.0;
  double velocity = 0.0;
  double north_m = 0.0;  ///< off at the end
  double north_sigma_m = 0.0;
};

Worst worst_of(const NavigationParameters& p, CastingOff truth, double seconds, double last_fix_s) {
  NavigationFilter filter(p, kGravity);
  filter.start(truth.state(), 0);
  Worst worst;
  while (truth.time_s() < seconds) {
    filter.add(truth.next());
    if (!truth.is_fix_time()) continue;
    if (truth.time_s() < last_fix_s) filter.add(truth.fix());
    InertialFilter now = *filter.filter();
    now.settle();
    const StateMatrix& P = now.covariance().matrix();
    const Vector3 dr = nav::ned_from(truth.state().position, now.state().position);
    const Vector3 dv = now.state().v_n - truth.state().v_n;
    const Matrix3 P_r = P.block<3, 3>(kPosition, kPosition), P_v = P.block<3, 3>(kVelocity, kVelocity);
    worst.position = std::max(worst.position, dr.dot(P_r.llt().solve(dr)));
    worst.velocity = std::max(worst.velocity, dv.dot(P_v.llt().solve(dv)));
    worst.north_m = dr.x();
    worst.north_sigma_m = std::sqrt(P_r(0, 0));
  }
  return worst;
}

/// The samples and fixes are perfect: what the filter errs by is what zero velocities do. 16.27 is chi-square's 0.999.
constexpr double kHonest = 16.27;

/// An automotive IMU, whose forces cannot tell such a way from its bias: the receiver alone can.
NavigationParameters coarse() {
  NavigationParameters p;
  p.gyro.arw_deg_per_sqrt_h.setConstant(3.0);
  p.gyro.bias_sigma_deg_per_h.setConstant(100.0);
  p.accel.vrw_m_per_s_per_sqrt_h.setConstant(0.12);
  p.accel.bias_sigma_mgal.setConstant(9807.0);
  return p;
}

/// A navigation grade's, which feels it without a receiver.
NavigationParameters fine() {
  NavigationParameters p;
  p.gyro.arw_deg_per_sqrt_h.setConstant(0.002);
  p.gyro.bias_sigma_deg_per_h.setConstant(0.005);
  p.accel.vrw_m_per_s_per_sqrt_h.setConstant(0.0008);
  p.accel.bias_sigma_mgal.setConstant(5.0);
  p.initial.attitude_sigma_ned_deg = Vector3(0.001, 0.001, 0.1);
  return p;
}

TEST(ZeroVelocity, ASlowCastOffIsNotHeldWhereTheReceiverSeesIt) {
  for (const NavigationParameters& p : {coarse(), NavigationParameters{}, fine()}) {
    for (const double acceleration_m_per_s2 : {0.0005, 0.003, 0.01}) {
      const Worst worst = worst_of(p, CastingOff(120.0, acceleration_m_per_s2), 300.0, 1e9);
      EXPECT_LT(worst.velocity, kHonest) << acceleration_m_per_s2 << " m/s^2";
      EXPECT_LT(worst.position, kHonest) << acceleration_m_per_s2 << " m/s^2";
    }
  }
}

// No window of a second shows 0.005 m/s^2, which is a quarter of sigma_m_per_s in it; the gain over many does.
TEST(ZeroVelocity, ASlowCastOffIsNotHeldInAnOutageWhereTheForcesShowIt) {
  for (const double acceleration_m_per_s2 : {0.005, 0.02}) {
    const Worst worst = worst_of(fine(), CastingOff(60.0, acceleration_m_per_s2), 180.0, 50.0);
    // 36 m and 144 m have gone by.
    EXPECT_LT(std::abs(worst.north_m), 3.0 * worst.north_sigma_m) << acceleration_m_per_s2 << " m/s^2";
    EXPECT_LT(std::abs(worst.north_m), 5.0) << acceleration_m_per_s2 << " m/s^2";
  }
}

// Its velocity walks so much that each zero velocity takes most of a second's gain away again: its own velocity never
// says more than sigma_m_per_s can, and the sum of the gains does. (0.003 m/s^2 are held: half a minute of them is no
// more than four sigma_m_per_s.)
TEST(ZeroVelocity, TheGainOfHalfAMinuteShowsWhatNoWindowShows) {
  NavigationParameters p = fine();
  for (const double vrw_m_per_s_per_sqrt_h : {0.07, 0.2}) {
    p.accel.vrw_m_per_s_per_sqrt_h.setConstant(vrw_m_per_s_per_sqrt_h);
    for (const double acceleration_m_per_s2 : {0.004, 0.005, 0.006, 0.008, 0.01}) {
      const Worst worst = worst_of(p, CastingOff(60.0, acceleration_m_per_s2), 180.0, 50.0);
      EXPECT_LT(std::abs(worst.north_m), 3.0 * worst.north_sigma_m) << acceleration_m_per_s2 << " m/s^2";
      EXPECT_LT(std::abs(worst.north_m), 12.0) << acceleration_m_per_s2 << " m/s^2, way 29 m and more";
    }
  }
}

// The speed is 0.0633 t^2: what the first second gains is three sigma_m_per_s at most, and the IMU's own noise and
// biases make far less.
TEST(ZeroVelocity, APullAwayIsNotHeldInItsFirstSecond) {
  for (const NavigationParameters& p : {NavigationParameters{}, fine()}) {
    for (const double begins_s : {60.0, 60.2, 60.4, 60.6, 60.8, 60.9}) {
      const auto gently = [=](double t_s) { return t_s < begins_s ? 0.0 : 0.1267 * (t_s - begins_s); };
      const Worst worst = worst_of(p, CastingOff(gently), 75.0, 50.0);
      EXPECT_LT(worst.velocity, kHonest) << "from " << begins_s << " s on";
      EXPECT_LT(worst.position, kHonest) << "from " << begins_s << " s on";
      EXPECT_LT(std::abs(worst.north_m), 0.1) << "from " << begins_s << " s on";
    }
  }
}

// A sway gains more in a second than the IMU's noise, too, and does so in every one: its zero velocities come less
// often.
TEST(ZeroVelocity, ASwayDoesNotKeepThemAway) {
  constexpr double kOmega = 2.5, kSway_m_per_s = 0.01;
  const auto sigma_m = [](bool use) {
    NavigationParameters p;
    p.zero_velocity.use = use;
    const auto sways = [](double t_s) { return kSway_m_per_s * kOmega * std::cos(kOmega * t_s); };
    return worst_of(p, CastingOff(sways), 180.0, 50.0).north_sigma_m;
  };
  EXPECT_LT(10.0 * sigma_m(true), sigma_m(false));
}

// Rest that is rest: the updates are taken, or an IMU of 100 deg/h would not stay within 3 m in a minute's outage.
TEST(ZeroVelocity, RestIsStillBelievedIn) {
  const auto sigma_m = [](bool use) {
    NavigationParameters p = coarse();
    p.zero_velocity.use = use;
    const Worst worst = worst_of(p, CastingOff(1e9, 0.0), 180.0, 120.0);
    return worst.north_sigma_m;
  };
  EXPECT_LT(10.0 * sigma_m(true), sigma_m(false));
}

}  // namespace zero_velocity_test
}  // namespace inslab::navigation
