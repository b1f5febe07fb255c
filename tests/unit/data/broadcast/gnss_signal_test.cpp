#include "inslab/data/broadcast/gnss_signal.hpp"

#include <gmock/gmock.h>

#include <set>

namespace inslab::broadcast {
namespace gnss_signal_test {

using ::testing::DoubleEq;
using ::testing::DoubleNear;

double frequency_hz(GnssSystem system, std::string_view rinex) { return gnss_signal(system, rinex).frequency_hz; }

// Multiples of 10.23 MHz, as the ICDs give them.
TEST(GnssSignals, CarriersAreMultiplesOfOneFrequency) {
  constexpr double kBase_hz = 10.23e6;
  EXPECT_THAT(frequency_hz(GnssSystem::Gps, "1C"), DoubleEq(154.0 * kBase_hz));
  EXPECT_THAT(frequency_hz(GnssSystem::Gps, "2L"), DoubleEq(120.0 * kBase_hz));
  EXPECT_THAT(frequency_hz(GnssSystem::Gps, "5Q"), DoubleEq(115.0 * kBase_hz));
  EXPECT_THAT(frequency_hz(GnssSystem::Galileo, "7Q"), DoubleEq(118.0 * kBase_hz));
  EXPECT_THAT(frequency_hz(GnssSystem::BeiDou, "2I"), DoubleNear(152.6 * kBase_hz, 1e-3));
  EXPECT_THAT(frequency_hz(GnssSystem::BeiDou, "6I"), DoubleEq(124.0 * kBase_hz));
}

TEST(GnssSignals, ChannelsOfGlonass) {
  EXPECT_EQ(carrier_hz(gnss_signal(GnssSystem::Glonass, "1C"), -7), 1598.0625e6);
  EXPECT_EQ(carrier_hz(gnss_signal(GnssSystem::Glonass, "2C"), 6), 1248.625e6);
  EXPECT_EQ(carrier_hz(gnss_signal(GnssSystem::Gps, "1C"), 3), 1575.42e6);
}

TEST(GnssSignals, NumbersAreUniqueInASystem) {
  std::set<std::pair<GnssSystem, int>> msm, ubx;
  for (const GnssSignal& signal : gnss_signals()) {
    EXPECT_TRUE(msm.insert({signal.system, signal.msm}).second) << signal.rinex;
    EXPECT_TRUE(ubx.insert({signal.system, signal.ubx}).second) << signal.rinex;
    EXPECT_TRUE(signal.msm >= 2 && signal.msm <= 31) << signal.rinex;
  }
}

TEST(GnssSignals, AnUnknownOneIsNamed) {
  try {
    gnss_signal(GnssSystem::BeiDou, "1C");
    FAIL();
  } catch (const std::out_of_range& error) {
    EXPECT_STREQ(error.what(), "no signal 1C of beidou");
  }
}

/// The delay of the pair that the ionosphere has no part in.
DelayRule free_of_ionosphere(GnssSystem system, std::string_view first, std::string_view second) {
  const GnssSignal &a = gnss_signal(system, first), &b = gnss_signal(system, second);
  const double ratio = a.frequency_hz / b.frequency_hz, gamma = ratio * ratio;
  return {(gamma * a.delay.first - b.delay.first) / (gamma - 1.0),
          (gamma * a.delay.second - b.delay.second) / (gamma - 1.0)};
}

// A system's clock is right for its own pair of signals: whatever the delays, its ionosphere-free pseudorange has none.
TEST(GroupDelays, NoneIsLeftInTheClocksOwnPair) {
  const std::array<std::tuple<GnssSystem, std::string_view, std::string_view>, 4> pairs{
      {{GnssSystem::Gps, "1C", "2L"},
       {GnssSystem::Qzss, "1C", "2L"},
       {GnssSystem::Gps, "1C", "5Q"},
       {GnssSystem::Galileo, "1C", "7Q"}}};
  for (const auto& [system, first, second] : pairs) {
    const DelayRule left = free_of_ionosphere(system, first, second);
    EXPECT_NEAR(left.first, 0.0, 1e-14) << first << second;
    EXPECT_NEAR(left.second, 0.0, 1e-14) << first << second;
  }
}

// The pair E1, E5a has the clock of F/NAV, which is behind that of I/NAV by BGD(E1,E5b) - BGD(E1,E5a).
TEST(GroupDelays, OtherPairOfGalileoHasTheOtherMessagesClock) {
  const DelayRule left = free_of_ionosphere(GnssSystem::Galileo, "1C", "5Q");
  EXPECT_NEAR(left.first, -1.0, 1e-14);
  EXPECT_NEAR(left.second, 1.0, 1e-14);
}

TEST(GroupDelays, BeiDouReckonsFromB3I) {
  EXPECT_EQ(gnss_signal(GnssSystem::BeiDou, "6I").delay.first, 0.0);
  EXPECT_EQ(gnss_signal(GnssSystem::BeiDou, "6I").delay.second, 0.0);
  EXPECT_EQ(gnss_signal(GnssSystem::BeiDou, "2I").delay.first, 1.0);
  EXPECT_EQ(gnss_signal(GnssSystem::BeiDou, "7I").delay.second, 1.0);
}

}  // namespace gnss_signal_test
}  // namespace inslab::broadcast
