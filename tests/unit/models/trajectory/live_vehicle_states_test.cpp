// Which states of a live vehicle are taken, which are counted and left aside, and when the run ends for want of them.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "inslab/data/wire/cdr.hpp"
#include "tests/unit/models/trajectory/live_vehicle.hpp"

namespace inslab::trajectory {
namespace live_vehicle_states_test {

using namespace live_vehicle;

TEST(LiveVehicleStates, AlwaysLateStatesAreCountedAndStillFollowed) {
  const scenario::Trajectory motion = drive();
  LiveVehicleModel model = model_of(followed(motion));
  const std::vector<TruthState> truth = follow(model, arrivals_of(states_of(motion, 10.0), 50 * kMillisecond_ns), 9.5);
  const std::vector<TruthState> vehicle = truth_of(motion, kTruthRate_hz, 10.0);
  EXPECT_EQ(model.link().late, model.link().used);
  EXPECT_EQ(model.link().missing, 0u);
  for (std::size_t k = 100; k < truth.size(); ++k) {
    // 35 ms ahead of the newest state with a jerk below 20 m/s^3, and what is being led back: at most as much for each
    // of the 17 times it is renewed before it is gone.
    ASSERT_LT(nav::ned_from(position(vehicle[k - 4]), position(truth[k])).norm(), 0.05) << k;
  }
}

TEST(LiveVehicleStates, EndsTheRunWhenStatesStayOutForTooLong) {
  const scenario::Trajectory motion = drive();
  LiveVehicleModel model = model_of(followed(motion));
  const auto arrivals = arrivals_of(states_of(motion, 2.0), kMillisecond_ns, 1.0, 2.0);
  try {
    follow(model, arrivals, 2.0);
    FAIL() << "went on without states";
  } catch (const std::runtime_error& error) {
    // The last state, of 0.99 s, stands for 1.01 s; half a second later it ends.
    EXPECT_STREQ(
        error.what(),
        "at 1.515000 s: no state of the vehicle since that of 0.990000 s; extrapolation_limit_ms is 500.000000");
  }
}

TEST(LiveVehicleStates, StatesNoNewerThanTheLastAreCountedAndChangeNothing) {
  const scenario::Trajectory motion = drive();
  const std::vector<VehicleState> states = states_of(motion, 3.0);
  LiveVehicleModel plain = model_of(followed(motion)), repeated = model_of(followed(motion));
  std::vector<Arrival> twice;
  for (const Arrival& arrival : arrivals_of(states, kMillisecond_ns)) {
    twice.push_back(arrival);
    twice.push_back({states[twice.size() / 4], arrival.at_ns});
  }
  const auto expected = follow(plain, arrivals_of(states, kMillisecond_ns), 2.5);
  const auto actual = follow(repeated, twice, 2.5);
  EXPECT_GT(repeated.link().not_newer, 200u);
  std::vector<std::uint8_t> a, b;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    wire::encode(expected[k], a);
    wire::encode(actual[k], b);
    ASSERT_EQ(a, b) << k;
  }
}

struct Spoiled {
  const char* name;
  void (*spoil)(VehicleState&);
  const char* reason;
};

class SpoiledState : public testing::TestWithParam<Spoiled> {};

TEST_P(SpoiledState, IsRefusedCountedAndChangesNothing) {
  const scenario::Trajectory motion = drive();
  const std::vector<VehicleState> states = states_of(motion, 2.0);
  LiveVehicleModel plain = model_of(followed(motion)), attacked = model_of(followed(motion));
  std::vector<Arrival> arrivals;
  for (const Arrival& arrival : arrivals_of(states, kMillisecond_ns)) {
    VehicleState spoiled = arrival.state;
    GetParam().spoil(spoiled);
    arrivals.push_back({spoiled, arrival.at_ns});
    arrivals.push_back(arrival);
  }
  const auto expected = follow(plain, arrivals_of(states, kMillisecond_ns), 1.5);
  const auto actual = follow(attacked, arrivals, 1.5);
  EXPECT_EQ(attacked.link().refused, attacked.link().used);
  EXPECT_NE(attacked.link().last_refusal.find(GetParam().reason), std::string::npos) << attacked.link().last_refusal;
  std::vector<std::uint8_t> a, b;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    wire::encode(expected[k], a);
    wire::encode(actual[k], b);
    ASSERT_EQ(a, b) << k;
  }
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Every, SpoiledState,
    testing::Values(
        Spoiled{"NanHeight", [](VehicleState& s) { s.height_m = kNan; }, "height_m is nan"},
        Spoiled{"InfiniteRate", [](VehicleState& s) { s.omega_nv_v.y() = 1.0 / 0.0; }, "omega_nv_v_rad_per_s"},
        Spoiled{"NanQuaternion", [](VehicleState& s) { s.q_nv.z() = kNan; }, "q_nv is nan"},
        Spoiled{"NoRotation", [](VehicleState& s) { s.q_nv.coeffs() *= 0.5; }, "q_nv has the norm 0.5"},
        Spoiled{"InSpace", [](VehicleState& s) { s.height_m = 2e5; }, "height is 200000 m"},
        Spoiled{"AtThePole", [](VehicleState& s) { s.latitude_rad = 1.5707; }, "latitude is"},
        Spoiled{"TooFast", [](VehicleState& s) { s.v_n.x() = 2e4; }, "v_n_m_per_s[0] is 20000"},
        Spoiled{"Elsewhere", [](VehicleState& s) { s.longitude_rad += 1e-5; }, "from where the last state leads"},
        Spoiled{"Future", [](VehicleState& s) { s.sim_time_ns += 1'200'000'000; }, "more than a second ahead"}),
    [](const auto& name) { return name.param.name; });

TEST(LiveVehicleStates, TheSameStatesAtTheSameSamplesGiveTheSameBits) {
  const scenario::Trajectory motion = drive();
  std::mt19937_64 generator(3);
  std::uniform_int_distribution<std::int64_t> jitter(0, 25 * kMillisecond_ns);
  std::bernoulli_distribution lost(0.2);
  std::vector<Arrival> arrivals;
  for (const VehicleState& state : states_of(motion, 4.0)) {
    if (!lost(generator)) arrivals.push_back({state, state.sim_time_ns + jitter(generator)});
  }
  std::stable_sort(arrivals.begin(), arrivals.end(), [](const auto& a, const auto& b) { return a.at_ns < b.at_ns; });
  LiveVehicleModel first = model_of(followed(motion)), second = model_of(followed(motion));
  const auto once = follow(first, arrivals, 3.5), again = follow(second, arrivals, 3.5);
  EXPECT_GT(first.link().returns, 10u);
  std::vector<std::uint8_t> a, b;
  for (std::size_t k = 0; k < once.size(); ++k) {
    wire::encode(once[k], a);
    wire::encode(again[k], b);
    ASSERT_EQ(a, b) << k;
  }
}

}  // namespace live_vehicle_states_test
}  // namespace inslab::trajectory
