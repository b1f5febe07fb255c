#include <gtest/gtest.h>

#include <map>

#include "tests/unit/models/navigation/circling.hpp"

namespace inslab::navigation {
namespace late_observations_test {

using namespace circling;

TEST(LateObservations, ALateFixGivesTheSameBitsAsOneInTime) {
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
TEST(LateObservations, FixesThatOvertakeEachOtherGiveTheSameBitsAsFixesInTime) {
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
TEST(LateObservations, ObservationsOfAllKindsThatComeLateGiveTheSameBitsAsInTime) {
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

TEST(LateObservations, AStandstillThatItsOwnVelocityContradictsIsRefused) {
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

TEST(LateObservations, AFixBetweenTwoSamplesIsTakenInAtItsOwnTime) {
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

TEST(LateObservations, FixesBeyondTheLatencyKeptAreCountedAndDropped) {
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

}  // namespace late_observations_test
}  // namespace inslab::navigation
