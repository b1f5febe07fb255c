#include "inslab/models/navigation/navigation_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::navigation {
namespace navigation_filter_test {

constexpr double kDt_s = 0.005;
constexpr std::int64_t kDt_ns = 5'000'000;
const nav::Gravity kGravity;

/// A vehicle that circles, mechanized: its states are the truth of its own increments.
class Circling {
 public:
  explicit Circling(double speed_m_per_s = 10.0, double rate_rad_per_s = 0.1)
      : speed_(speed_m_per_s),
        rate_(rate_rad_per_s),
        strapdown_({{0.53, 2.0, 50.0}, {speed_m_per_s, 0.0, 0.0}, nav::Quaternion::Identity()}, kGravity, {true}) {}

  nav::NavState state() const { return strapdown_.state(); }
  std::int64_t time_ns() const { return static_cast<std::int64_t>(k_) * kDt_ns; }
  const Vector3& omega_ib_b() const { return omega_ib_b_; }

  ImuSample next() {
    const nav::NavState now = strapdown_.state();
    const Matrix3 C_bn = nav::matrix_from_quaternion(now.q_nb).transpose();
    const Vector3 omega_ie = nav::omega_ie_n(now.position.latitude_rad);
    const Vector3 omega_en = nav::omega_en_n(now.position, now.v_n);
    omega_ib_b_ = C_bn * (omega_ie + omega_en) + Vector3(0.0, 0.0, rate_);
    const Vector3 f_b = Vector3(0.0, speed_ * rate_, 0.0) +
                        C_bn * ((2.0 * omega_ie + omega_en).cross(now.v_n) - kGravity.g_n(now.position));
    ImuSample sample;
    sample.dtheta_b = kDt_s * omega_ib_b_;
    sample.dv_b = kDt_s * f_b;
    sample.interval_ns = kDt_ns;
    sample.header.sequence_number = k_++;
    sample.header.sim_time_ns = time_ns();
    strapdown_.advance({sample.dtheta_b, sample.dv_b, kDt_s});
    return sample;
  }

  GnssFix fix(const Vector3& arm_b_m = Vector3::Zero()) const {
    const nav::NavState now = state();
    const Matrix3 C_nb = nav::matrix_from_quaternion(now.q_nb);
    const nav::Geodetic antenna = nav::displaced(now.position, C_nb * arm_b_m);
    GnssFix fix;
    fix.header.sim_time_ns = time_ns();
    fix.fix_type = FixType::Fixed;
    fix.latitude_rad = antenna.latitude_rad;
    fix.longitude_rad = antenna.longitude_rad;
    fix.height_m = antenna.height_m;
    fix.v_n =
        now.v_n + C_nb * omega_ib_b_.cross(arm_b_m) - nav::omega_ie_n(now.position.latitude_rad).cross(C_nb * arm_b_m);
    fix.position_sigma_ned_m = Vector3::Constant(0.02);
    fix.velocity_sigma_ned_m_per_s = Vector3::Constant(0.03);
    return fix;
  }

 private:
  double speed_;
  double rate_;
  nav::Strapdown strapdown_;
  std::uint64_t k_ = 0;
  Vector3 omega_ib_b_ = Vector3::Zero();
};

nav::Geodetic place_of(const NavSolution& solution) {
  return {solution.latitude_rad, solution.longitude_rad, solution.height_m};
}
double error_m(const NavSolution& solution, const Circling& truth) {
  return nav::ned_from(truth.state().position, place_of(solution)).norm();
}

NavigationFilter begun(const Circling& truth, const NavigationParameters& p = {}) {
  NavigationFilter filter(p, kGravity);
  filter.start(truth.state(), truth.time_ns());
  return filter;
}

NavSolution run(NavigationFilter& filter, Circling& truth, double seconds, double shift_m);

bool is_fix_time(const Circling& truth) { return truth.time_ns() % 200'000'000 == 0; }

TEST(NavigationFilter, FollowsAVehicleWithAnAntennaOnALeverArm) {
  NavigationParameters p;
  p.lever_arm_b_m = Vector3(1.6, -0.3, -1.0);
  Circling truth;
  NavigationFilter filter = begun(truth, p);
  std::optional<NavSolution> solution;
  for (int k = 0; k < 6000; ++k) {
    solution = filter.add(truth.next());
    if (is_fix_time(truth)) filter.add(truth.fix(p.lever_arm_b_m));
  }
  // No errors anywhere: what is left is rounding and the second order of one rate a sample in the antenna's velocity.
  EXPECT_LT(error_m(*solution, truth), 1e-4);
  EXPECT_EQ(solution->mode, NavMode::Navigating);
  EXPECT_EQ(solution->imu_sequence, 5999U);
}

TEST(NavigationFilter, ALateFixGivesTheSameBitsAsOneInTime) {
  Circling truth;
  NavigationFilter in_time = begun(truth), late = begun(truth);
  std::optional<GnssFix> on_its_way;
  std::optional<NavSolution> a, b;
  for (int k = 0; k < 2000; ++k) {
    const ImuSample sample = truth.next();
    a = in_time.add(sample);
    b = late.add(sample);
    if (is_fix_time(truth)) {
      GnssFix fix = truth.fix();
      fix.height_m += 0.03 * std::sin(k);
      in_time.add(fix);
      on_its_way = fix;
    }
    if (on_its_way && truth.time_ns() - on_its_way->header.sim_time_ns >= 115'000'000) {
      late.add(*on_its_way);
      on_its_way.reset();
    }
  }
  // The last fix in time is at 10 s, which the late one has not heard of; the solution of 10 s itself is before both.
  EXPECT_EQ(a->height_m, b->height_m);
  EXPECT_EQ(a->v_n, b->v_n);
  EXPECT_EQ(a->position_sigma_ned_m, b->position_sigma_ned_m);
  EXPECT_EQ(late.counts().fixes_too_old, 0U);
}

// Fix i comes after 0.1 s plus 0.15 s times (0, 3, 1, 4, 2 ...), so later ones overtake earlier ones.
TEST(NavigationFilter, FixesThatOvertakeEachOtherGiveTheSameBitsAsFixesInTime) {
  Circling truth;
  NavigationFilter in_time = begun(truth), shuffled = begun(truth);
  std::multimap<std::int64_t, GnssFix> on_their_way;
  std::optional<NavSolution> a, b;
  std::int64_t count = 0;
  for (int k = 0; k < 2200; ++k) {
    const ImuSample sample = truth.next();
    a = in_time.add(sample);
    b = shuffled.add(sample);
    if (is_fix_time(truth) && truth.time_ns() <= 10'000'000'000) {
      GnssFix fix = truth.fix();
      fix.height_m += 0.03 * std::sin(k);
      in_time.add(fix);
      on_their_way.emplace(truth.time_ns() + 100'000'000 + 150'000'000 * (3 * count++ % 5), fix);
    }
    while (!on_their_way.empty() && on_their_way.begin()->first <= truth.time_ns()) {
      shuffled.add(on_their_way.begin()->second);
      on_their_way.erase(on_their_way.begin());
    }
  }
  // All 50 are there 0.7 s after the last at the latest, and a second has passed since.
  EXPECT_EQ(a->latitude_rad, b->latitude_rad);
  EXPECT_EQ(a->height_m, b->height_m);
  EXPECT_EQ(a->v_n, b->v_n);
  EXPECT_EQ(a->q_n_body.coeffs(), b->q_n_body.coeffs());
  EXPECT_EQ(a->position_sigma_ned_m, b->position_sigma_ned_m);
  EXPECT_EQ(a->attitude_sigma_rad, b->attitude_sigma_rad);
  EXPECT_EQ(shuffled.counts().fixes_too_old, 0U);
  EXPECT_EQ(shuffled.take_results().size(), 50U);
}

// An odometer says late, and not in order, that the wheels stand still, now and then between two samples; fixes are
// late otherwise.
TEST(NavigationFilter, ObservationsOfAllKindsThatComeLateGiveTheSameBitsAsInTime) {
  NavigationParameters p;
  p.zero_velocity.use = false;
  Circling truth(0.0, 0.0);
  NavigationFilter in_time = begun(truth, p), late = begun(truth, p), without = begun(truth, p);
  std::multimap<std::int64_t, Observation> on_their_way;
  std::optional<NavSolution> a, b, c;
  std::int64_t count = 0;
  for (int k = 0; k < 2400; ++k) {
    ImuSample sample = truth.next();
    sample.dv_b += kDt_s * Vector3(2e-3, 0.0, 0.0);
    a = in_time.add(sample);
    b = late.add(sample);
    c = without.add(sample);
    if (truth.time_ns() > 10'000'000'000) {
      // Whatever is still on its way comes.
    } else if (k % 30 == 7) {
      Standstill standstill;
      standstill.header.sim_time_ns = truth.time_ns() - (k % 2) * 1'700'000;
      in_time.add(standstill);
      on_their_way.emplace(truth.time_ns() + 110'000'000 + 150'000'000 * (3 * count++ % 5), standstill);
    } else if (k % 200 == 50) {
      in_time.add(truth.fix());
      without.add(truth.fix());
      on_their_way.emplace(truth.time_ns() + 120'000'000, truth.fix());
    }
    while (!on_their_way.empty() && on_their_way.begin()->first <= truth.time_ns()) {
      late.add(on_their_way.begin()->second);
      on_their_way.erase(on_their_way.begin());
    }
  }
  EXPECT_EQ(a->latitude_rad, b->latitude_rad);
  EXPECT_EQ(a->height_m, b->height_m);
  EXPECT_EQ(a->v_n, b->v_n);
  EXPECT_EQ(a->q_n_body.coeffs(), b->q_n_body.coeffs());
  EXPECT_EQ(a->velocity_sigma_ned_m_per_s, b->velocity_sigma_ned_m_per_s);
  EXPECT_EQ(a->attitude_sigma_rad, b->attitude_sigma_rad);
  EXPECT_LT(b->velocity_sigma_ned_m_per_s.x(), 0.9 * c->velocity_sigma_ned_m_per_s.x()) << "they say something";
  std::map<std::string_view, int> accepted;
  for (const UpdateResult& result : late.take_results()) {
    for (const MeasurementResult& m : result.measurements) accepted[m.name] += m.accepted ? 1 : 0;
  }
  EXPECT_EQ(accepted["zero_velocity"], 67);
  EXPECT_EQ(accepted["gnss_position"], 10);
  EXPECT_EQ(accepted["gnss_velocity"], 10);
}

TEST(NavigationFilter, AStandstillThatItsOwnVelocityContradictsIsRefused) {
  Circling truth;
  NavigationFilter filter = begun(truth);
  const NavSolution before = run(filter, truth, 2.0, 0.0);
  filter.take_results();
  Standstill wrong;
  wrong.header.sim_time_ns = truth.time_ns() - 50'000'000;
  filter.add(wrong);
  const std::vector<UpdateResult> results = filter.take_results();
  ASSERT_EQ(results.size(), 1U);
  EXPECT_FALSE(results.front().of("zero_velocity")->accepted);
  EXPECT_EQ(results.front().of("gnss_position"), nullptr);
  EXPECT_NEAR(filter.add(truth.next())->v_n.norm(), before.v_n.norm(), 0.01);
}

TEST(NavigationFilter, AFixBetweenTwoSamplesIsTakenInAtItsOwnTime) {
  Circling truth(20.0, 0.0);
  NavigationFilter filter = begun(truth);
  filter.add(truth.next());
  GnssFix fix = truth.fix();
  const double half_s = 0.5 * kDt_s;
  fix.header.sim_time_ns += kDt_ns / 2;
  const nav::Geodetic there = nav::displaced(truth.state().position, half_s * truth.state().v_n);
  fix.latitude_rad = there.latitude_rad;
  fix.longitude_rad = there.longitude_rad;
  filter.add(fix);
  const auto solution = filter.add(truth.next());
  EXPECT_LT(error_m(*solution, truth), 1e-6);
  const std::vector<UpdateResult> results = filter.take_results();
  ASSERT_EQ(results.size(), 1U);
  EXPECT_EQ(results.front().time_ns, kDt_ns + kDt_ns / 2);
  EXPECT_LT(results.front().of("gnss_position")->nis, 1e-8);
}

TEST(NavigationFilter, FixesBeyondTheLatencyKeptAreCountedAndDropped) {
  NavigationParameters p;
  p.max_latency_s = 0.1;
  Circling truth;
  NavigationFilter filter = begun(truth, p);
  for (int k = 0; k < 100; ++k) filter.add(truth.next());
  GnssFix old = truth.fix();
  old.header.sim_time_ns -= 300'000'000;
  filter.add(old);
  EXPECT_EQ(filter.counts().fixes_too_old, 1U);
  EXPECT_TRUE(filter.take_results().empty());
}

/// Runs for `seconds` with fixes at 5 Hz, each shifted by `shift_m` to the north.
NavSolution run(NavigationFilter& filter, Circling& truth, double seconds, double shift_m) {
  std::optional<NavSolution> solution;
  for (int k = 0; k < static_cast<int>(std::lround(seconds / kDt_s)); ++k) {
    solution = filter.add(truth.next());
    if (!is_fix_time(truth)) continue;
    GnssFix fix = truth.fix();
    const nav::Geodetic shifted =
        nav::displaced({fix.latitude_rad, fix.longitude_rad, fix.height_m}, {shift_m, 0.0, 0.0});
    fix.latitude_rad = shifted.latitude_rad;
    fix.longitude_rad = shifted.longitude_rad;
    filter.add(fix);
  }
  return *solution;
}

TEST(NavigationFilter, RefusesASpoofedPositionAndGoesOn) {
  Circling truth;
  NavigationFilter filter = begun(truth);
  run(filter, truth, 20.0, 0.0);
  filter.take_results();
  const NavSolution solution = run(filter, truth, 2.0, 50.0);
  for (const UpdateResult& result : filter.take_results()) EXPECT_FALSE(result.of("gnss_position")->accepted);
  EXPECT_LT(error_m(solution, truth), 0.05);
}

TEST(NavigationFilter, BelievesTheReceiverAfterManyRefusalsInARow) {
  Circling truth;
  NavigationFilter filter = begun(truth);
  run(filter, truth, 20.0, 0.0);
  filter.take_results();
  const NavSolution solution = run(filter, truth, 10.0, 50.0);
  std::size_t recovered = 0, refused_before = 0;
  for (const UpdateResult& result : filter.take_results()) {
    recovered += result.recovered ? 1 : 0;
    refused_before += recovered == 0 ? 1 : 0;
  }
  EXPECT_EQ(refused_before, InnovationTest{}.rejections_before_recovery);
  EXPECT_EQ(recovered, 1U);
  EXPECT_NEAR(error_m(solution, truth), 50.0, 0.5);
}

TEST(NavigationFilter, CoastsWithoutFixesAndItsSigmaGrows) {
  Circling truth;
  NavigationFilter filter = begun(truth);
  const NavSolution before = run(filter, truth, 20.0, 0.0);
  std::optional<NavSolution> after;
  for (int k = 0; k < 2000; ++k) after = filter.add(truth.next());
  EXPECT_EQ(after->mode, NavMode::Coasting);
  EXPECT_GT(after->position_sigma_ned_m.x(), 3.0 * before.position_sigma_ned_m.x());
}

TEST(NavigationFilter, SurvivesRatesThatAreNotThereAndOwnsUpToIt) {
  Circling truth, twin;
  NavigationFilter filter = begun(truth), undisturbed = begun(twin);
  run(filter, truth, 10.0, 0.0);
  run(undisturbed, twin, 10.0, 0.0);
  std::optional<NavSolution> solution, reference;
  for (int k = 0; k < 100; ++k) {
    ImuSample sample = truth.next();
    sample.gyro_valid = false;
    sample.dtheta_b.setZero();
    if (k % 2 == 0) sample.dv_b.x() = std::numeric_limits<double>::quiet_NaN();
    solution = filter.add(sample);
    reference = undisturbed.add(twin.next());
  }
  // The rate is constant: holding it over costs nothing, but the filter cannot know: 2 deg/s for 0.5 s is 1 deg.
  EXPECT_LT(error_m(*solution, truth), 0.01);
  EXPECT_NEAR(solution->attitude_sigma_rad.x(), 1.0 * units::kDeg, 0.1 * units::kDeg);
  EXPECT_LT(reference->attitude_sigma_rad.x(), 0.2 * units::kDeg);
  EXPECT_EQ(filter.counts().imu_not_valid, 100U);
}

TEST(NavigationFilter, BridgesMissingSamplesAndBeginsAnewAfterALongGap) {
  Circling truth;
  NavigationFilter filter = begun(truth);
  run(filter, truth, 10.0, 0.0);
  for (int k = 0; k < 50; ++k) truth.next();
  const auto bridged = filter.add(truth.next());
  EXPECT_LT(error_m(*bridged, truth), 0.05);
  EXPECT_EQ(filter.counts().imu_gaps, 1U);
  for (int k = 0; k < 400; ++k) truth.next();
  EXPECT_EQ(filter.add(truth.next())->mode, NavMode::Aligning);
  EXPECT_EQ(filter.counts().restarts, 1U);
}

TEST(NavigationFilter, SamplesOutOfOrderAreCountedAndChangeNothing) {
  Circling truth;
  NavigationFilter filter = begun(truth);
  const ImuSample first = truth.next();
  filter.add(first);
  EXPECT_FALSE(filter.add(first).has_value());
  EXPECT_EQ(filter.counts().imu_out_of_order, 1U);
}

TEST(NavigationFilter, FixesWithoutASolutionOrANumberAreCountedAndChangeNothing) {
  Circling truth;
  NavigationFilter filter = begun(truth);
  filter.add(truth.next());
  GnssFix none = truth.fix(), not_finite = truth.fix(), sure = truth.fix();
  none.fix_type = FixType::None;
  not_finite.height_m = std::numeric_limits<double>::quiet_NaN();
  sure.position_sigma_ned_m.setZero();
  for (const GnssFix& fix : {none, not_finite, sure}) filter.add(fix);
  EXPECT_EQ(filter.counts().fixes_not_used, 3U);
  EXPECT_TRUE(filter.take_results().empty());
}

TEST(NavigationFilter, AlignsAtRestAndThenNavigates) {
  NavigationParameters p;
  p.initial.alignment_s = 10.0;
  Circling still(0.0, 0.0);
  NavigationFilter filter(p, kGravity);
  std::optional<NavSolution> solution;
  for (int k = 0; k < 1999; ++k) {
    solution = filter.add(still.next());
    if (is_fix_time(still)) filter.add(still.fix());
  }
  EXPECT_EQ(solution->mode, NavMode::Aligning);
  solution = filter.add(still.next());
  EXPECT_EQ(solution->mode, NavMode::Navigating);
  EXPECT_LT(nav::angle_between(solution->q_n_body, still.state().q_nb), 1e-9);
}

/// What the filter says after `seconds`; fixes come 0.1 s late.
NavSolution in_motion(NavigationFilter& filter, Circling& truth, const Vector3& arm_b_m, double seconds) {
  std::map<std::int64_t, GnssFix> on_its_way;
  std::optional<NavSolution> solution;
  for (int k = 0; k < static_cast<int>(seconds / kDt_s); ++k) {
    const ImuSample sample = truth.next();
    if (is_fix_time(truth)) on_its_way.emplace(truth.time_ns() + 100'000'000, truth.fix(arm_b_m));
    solution = filter.add(sample);
    while (!on_its_way.empty() && on_its_way.begin()->first <= truth.time_ns()) {
      filter.add(on_its_way.begin()->second);
      on_its_way.erase(on_its_way.begin());
    }
    if (solution->mode == NavMode::Navigating) break;
  }
  return *solution;
}

TEST(NavigationFilter, BeginsInMotionByTheChangeOfTheVelocity) {
  NavigationParameters p;
  p.lever_arm_b_m = Vector3(1.6, -0.3, -1.0);
  p.gyro.bias_sigma_deg_per_h.setConstant(20.0);
  Circling truth;
  NavigationFilter filter(p, kGravity);
  const NavSolution solution = in_motion(filter, truth, p.lever_arm_b_m, 30.0);
  ASSERT_EQ(solution.mode, NavMode::Navigating) << filter.motion_refusal();
  // The samples are perfect: what is left is the trapezoid between fixes and one rate a sample at the antenna.
  EXPECT_LT(nav::angle_between(solution.q_n_body, truth.state().q_nb), 0.1 * units::kDeg);
  EXPECT_LT((solution.v_n - truth.state().v_n).norm(), 0.02);
  // The fix is up to 0.3 s old, and 10 m/s turn by 0.1 rad/s: 0.01 m beside the mean of both velocities.
  EXPECT_LT(error_m(solution, truth), 0.05);
  EXPECT_GE(solution.attitude_sigma_rad.z(), 0.9 * units::kDeg) << "at least what the parameters say";
}

TEST(NavigationFilter, DoesNotBeginInAStraightCruise) {
  NavigationFilter filter({}, kGravity);
  Circling truth(10.0, 0.0);
  EXPECT_EQ(in_motion(filter, truth, Vector3::Zero(), 100.0).mode, NavMode::Aligning);
  EXPECT_NE(filter.motion_refusal().find("velocity changed by"), std::string::npos) << filter.motion_refusal();
}

TEST(NavigationFilter, DoesNotLevelItselfInASteadyTurn) {
  // 4 m/s at 0.1 rad/s press sideways with 0.4 m/s^2, as steadily as a tilt of 2 deg would.
  NavigationParameters p;
  p.initial.attitude = InitialAttitude::Levelled;
  p.initial.alignment_s = 2.0;
  Circling turning(4.0, 0.1);
  NavigationFilter filter(p, kGravity);
  std::optional<NavSolution> solution;
  for (int k = 0; k < 2000; ++k) {
    solution = filter.add(turning.next());
    if (is_fix_time(turning)) filter.add(turning.fix());
  }
  EXPECT_EQ(solution->mode, NavMode::Aligning);
  EXPECT_NE(filter.alignment_refusal().find("the receiver says that it moves"), std::string::npos);
}

// A ship that rolls by 0.6 deg in 9 s: the mean force levels the mean attitude, not the one at the end.
TEST(NavigationFilter, LevelsASwayingVehicleNoSurerThanItSways) {
  constexpr double kSway_rad = 0.6 * units::kDeg, kOmega_rad_per_s = 2.0 * units::kPi / 9.0;
  const nav::Geodetic place{0.98, 0.22, 36.0};
  for (const double alignment_s : {20.0, 22.0, 25.0}) {
    NavigationParameters p;
    p.initial.attitude = InitialAttitude::Levelled;
    p.initial.alignment_s = alignment_s;
    NavigationFilter filter(p, kGravity);
    GnssFix fix;
    fix.fix_type = FixType::Fixed;
    fix.latitude_rad = place.latitude_rad;
    fix.longitude_rad = place.longitude_rad;
    fix.height_m = place.height_m;
    fix.position_sigma_ned_m.setConstant(0.02);
    filter.add(fix);
    double roll_rad = 0.0;
    for (int k = 0; filter.filter() == nullptr && k < 10000; ++k) {
      const double t_s = (k + 1) * kDt_s;
      const double rolled_rad = kSway_rad * std::sin(kOmega_rad_per_s * t_s) - roll_rad;
      const Matrix3 C_bn = nav::matrix_from_rpy({roll_rad + 0.5 * rolled_rad, 0.0, 0.0}).transpose();
      roll_rad += rolled_rad;
      ImuSample sample;
      sample.dtheta_b = kDt_s * C_bn * nav::omega_ie_n(place.latitude_rad) + Vector3(rolled_rad, 0.0, 0.0);
      sample.dv_b = -kDt_s * C_bn * kGravity.g_n(place);
      sample.interval_ns = kDt_ns;
      sample.header.sim_time_ns = (k + 1) * kDt_ns;
      filter.add(sample);
    }
    ASSERT_NE(filter.filter(), nullptr) << filter.alignment_refusal();
    const Matrix3 C_nb = nav::matrix_from_quaternion(filter.filter()->state().q_nb);
    const double sigma_rad = std::sqrt(filter.filter()->covariance().matrix()(kAttitude, kAttitude));
    EXPECT_LT(std::abs(nav::rpy_from_matrix(C_nb).roll_rad - roll_rad), 2.0 * sigma_rad) << alignment_s;
    EXPECT_LT(sigma_rad, 3.0 * kSway_rad);
  }
}

TEST(NavigationFilter, RestHoldsTheVelocityThroughAnOutage) {
  // An unmodelled accelerometer error of 100 mGal: 30 s free would be 0.03 m/s and 0.45 m.
  const auto drift_m = [](bool use) {
    NavigationParameters p;
    p.zero_velocity.use = use;
    Circling still(0.0, 0.0);
    NavigationFilter filter = begun(still, p);
    std::optional<NavSolution> solution;
    for (int k = 0; k < 6000; ++k) {
      ImuSample sample = still.next();
      sample.dv_b.x() += 1e-3 * kDt_s;
      solution = filter.add(sample);
    }
    return error_m(*solution, still);
  };
  EXPECT_NEAR(drift_m(false), 0.45, 0.01);
  EXPECT_LT(drift_m(true), 0.15);
}

}  // namespace navigation_filter_test
}  // namespace inslab::navigation
