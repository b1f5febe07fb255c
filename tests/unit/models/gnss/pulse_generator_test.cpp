#include "inslab/models/gnss/pulse_generator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace inslab::gnss {
namespace pulse_generator_test {

constexpr std::int64_t kSecondNs = 1'000'000'000;
constexpr std::int64_t kPeriodNs = 5'000'000;
constexpr std::int64_t kFirstSecondNs = 700'000'000;  ///< sim time of the first whole second of GPS time

/// At a sim time of a run that began 0.3 s after a whole second.
TruthState truth_at(std::int64_t sim_time_ns) {
  TruthState truth;
  truth.header.sim_time_ns = sim_time_ns;
  truth.header.gps_week = 2446;
  truth.header.gps_time_of_week_ns = 36000 * kSecondNs + kSecondNs - kFirstSecondNs + sim_time_ns;
  truth.interval_ns = kPeriodNs;
  return truth;
}

/// A receiver with a fix.
PulseGenerator generator(const PulseErrors& errors) {
  PulseGenerator pulses(random::Stream(7, "gnss0/pps"));
  pulses.use(errors);
  pulses.note_epoch(1, true);
  return pulses;
}

PulseErrors on() {
  PulseErrors errors;
  errors.on = true;
  return errors;
}

/// The pulses of the first `seconds` whole seconds, from the truth samples at each of them and behind it.
std::vector<Pulse> pulses_of(PulseGenerator pulses, int seconds) {
  std::vector<Pulse> all;
  for (int n = 0; n < seconds; ++n) {
    for (const std::int64_t behind_ns : {std::int64_t{0}, kPeriodNs}) {
      const auto pulse = pulses.at(truth_at(kFirstSecondNs + n * kSecondNs + behind_ns), {});
      if (pulse) all.push_back(*pulse);
    }
  }
  return all;
}

TEST(PulseGenerator, IsOffUnlessToldOtherwise) { EXPECT_TRUE(pulses_of(generator({}), 10).empty()); }

TEST(PulseGenerator, GivesOnePulseAtEachWholeSecondAndNoneBetween) {
  PulseGenerator pulses = generator(on());
  int found = 0;
  for (std::int64_t t_ns = kPeriodNs; t_ns <= 5 * kSecondNs; t_ns += kPeriodNs) {
    const auto pulse = pulses.at(truth_at(t_ns), {});
    ASSERT_EQ(pulse.has_value(), t_ns % kSecondNs == kFirstSecondNs) << t_ns;
    if (!pulse) continue;
    EXPECT_EQ(pulse->sample.header.sim_time_ns, t_ns);
    EXPECT_EQ(pulse->sample.header.gps_time_of_week_ns, (36001 + found) * kSecondNs);
    EXPECT_EQ(pulse->sample.header.gps_week, 2446u);
    EXPECT_EQ(pulse->truth.header.sim_time_ns, t_ns);
    EXPECT_FALSE(pulse->sample.in_holdover);
    ++found;
  }
  EXPECT_EQ(found, 5);
}

TEST(PulseGenerator, FindsTheSecondBetweenTwoTruthSamples) {
  PulseGenerator pulses = generator(on());
  EXPECT_FALSE(pulses.at(truth_at(kFirstSecondNs - 1), {}));
  const auto pulse = pulses.at(truth_at(kFirstSecondNs + kPeriodNs - 1), {});
  ASSERT_TRUE(pulse);
  EXPECT_EQ(pulse->sample.header.sim_time_ns, kFirstSecondNs);
  EXPECT_EQ(pulse->sample.header.gps_time_of_week_ns, 36001 * kSecondNs);
}

TEST(PulseGenerator, ThatIsLateComesWhenItRisesAndOneThatIsEarlyAtItsSecond) {
  PulseErrors errors = on();
  errors.offset_ns = 250.0;
  PulseGenerator late = generator(errors);
  EXPECT_FALSE(late.at(truth_at(kFirstSecondNs), {}));
  const auto pulse = late.at(truth_at(kFirstSecondNs + kPeriodNs), {});
  ASSERT_TRUE(pulse);
  EXPECT_EQ(pulse->sample.header.sim_time_ns, kFirstSecondNs + 250);
  EXPECT_EQ(pulse->truth.header.sim_time_ns, kFirstSecondNs);
  EXPECT_EQ(pulse->sample.header.gps_time_of_week_ns, 36001 * kSecondNs) << "it marks the second all the same";
  EXPECT_EQ(pulse->truth.error_ns(), 250.0);
  errors.offset_ns = -250.0;
  PulseGenerator early = generator(errors);
  ASSERT_FALSE(early.at(truth_at(kFirstSecondNs - kPeriodNs), {}));
  EXPECT_EQ(early.at(truth_at(kFirstSecondNs), {})->sample.header.sim_time_ns, kFirstSecondNs - 250);
}

TEST(PulseGenerator, JitterIsWhiteWithItsSigma) {
  constexpr int kSeconds = 20000;
  PulseErrors errors = on();
  errors.offset_ns = 1000.0;
  errors.white_sigma_ns = 30.0;
  double sum = 0.0, squares = 0.0, products = 0.0, last = 0.0;
  const std::vector<Pulse> all = pulses_of(generator(errors), kSeconds);
  ASSERT_EQ(all.size(), static_cast<std::size_t>(kSeconds));
  for (const Pulse& pulse : all) {
    const auto error_ns = static_cast<double>(pulse.sample.header.sim_time_ns - pulse.truth.header.sim_time_ns);
    EXPECT_NEAR(error_ns, pulse.truth.error_ns(), 0.5);
    const double jitter_ns = error_ns - 1000.0;
    sum += jitter_ns, squares += jitter_ns * jitter_ns, products += jitter_ns * last;
    last = jitter_ns;
  }
  // Of N numbers: the mean to sigma/sqrt(N), the variance to sqrt(2/N) of itself, products to sigma^2/sqrt(N); the
  // rounding to whole nanoseconds adds 1/12.
  EXPECT_NEAR(sum / kSeconds, 0.0, 4.0 * 30.0 / std::sqrt(kSeconds));
  EXPECT_NEAR(squares / kSeconds, 900.0 + 1.0 / 12.0, 4.0 * 900.0 * std::sqrt(2.0 / kSeconds));
  EXPECT_NEAR(products / kSeconds, 0.0, 4.0 * 900.0 / std::sqrt(kSeconds));
}

TEST(PulseGenerator, TicksOfAnOscillatorMakeASawtoothThatTheReceiverKnows) {
  // 20 ns is 5e7 ticks a second; 1 ppb more is 0.05 tick, so the next tick comes 1 ns earlier each second, and after
  // ten of either sign another one is the nearest.
  PulseErrors errors = on();
  errors.quantization_ns = 20.0;
  errors.oscillator_drift_ppb = 1.0;
  const std::vector<Pulse> all = pulses_of(generator(errors), 400);
  double squares = 0.0;
  int jumps = 0;
  for (std::size_t n = 0; n < all.size(); ++n) {
    const double error_ns = all[n].truth.quantization_ns;
    EXPECT_LE(std::abs(error_ns), 10.0 + 1e-6);
    EXPECT_EQ(all[n].sample.quantization_error_ns, error_ns);
    squares += error_ns * error_ns / 400.0;
    if (n == 0) continue;
    const double step_ns = error_ns - all[n - 1].truth.quantization_ns;
    if (step_ns > 0.0) ++jumps;
    EXPECT_NEAR(step_ns, step_ns > 0.0 ? 19.0 : -1.0, 1e-4) << n;
  }
  EXPECT_NEAR(jumps, 20, 1);
  // Twenty values a nanosecond apart: between those of an even and an odd comb, (20^2 - 1)/12 and 1/4 more.
  EXPECT_NEAR(squares, 399.0 / 12.0, 0.27);
}

TEST(PulseGenerator, TicksFollowWhatIsMeant) {
  // 7 ns more of offset, with the same tick: the remainder is 7 ns less, or a tick more.
  PulseErrors errors = on();
  errors.quantization_ns = 20.0;
  const double before_ns = pulses_of(generator(errors), 1)[0].truth.quantization_ns;
  errors.offset_ns = 7.0;
  const double after_ns = pulses_of(generator(errors), 1)[0].truth.quantization_ns;
  EXPECT_NEAR(std::remainder(after_ns - before_ns + 7.0, 20.0), 0.0, 1e-9);
}

TEST(PulseGenerator, LeavesOutItsShareOfPulsesAndKeepsTheOthers) {
  constexpr int kSeconds = 10000;
  PulseErrors errors = on();
  errors.white_sigma_ns = 30.0;
  const std::vector<Pulse> all = pulses_of(generator(errors), kSeconds);
  errors.missing_probability = 0.3;
  const std::vector<Pulse> some = pulses_of(generator(errors), kSeconds);
  EXPECT_NEAR(static_cast<double>(some.size()), 0.7 * kSeconds, 4.0 * std::sqrt(0.21 * kSeconds));
  for (const Pulse& pulse : some) {
    const auto n = static_cast<std::size_t>(pulse.truth.header.sim_time_ns / kSecondNs);
    EXPECT_EQ(pulse.truth.jitter_ns, all[n].truth.jitter_ns);
  }
  errors.missing_probability = 1.0;
  EXPECT_TRUE(pulses_of(generator(errors), 100).empty());
}

TEST(PulseGenerator, WithoutAFixGoesOnForItsHoldoverAndDrifts) {
  PulseErrors errors = on();
  errors.holdover_s = 3.8;
  errors.holdover_drift_ppb = 40.0;
  PulseGenerator pulses(random::Stream(7, "gnss0/pps"));
  pulses.use(errors);
  // Epochs at whole seconds of sim time: fixes from 3 s to 8 s, and again at 15 s.
  std::vector<std::int64_t> marked;
  for (std::int64_t t_ns = kPeriodNs; t_ns <= 18 * kSecondNs; t_ns += kPeriodNs) {
    if (const auto pulse = pulses.at(truth_at(t_ns), {})) {
      marked.push_back(pulse->truth.header.sim_time_ns / kSecondNs);
      // From the last fix at 8 s to 9.7 s, 10.7 s, 11.7 s.
      const bool holds = marked.back() >= 9 && marked.back() <= 11;
      EXPECT_EQ(pulse->sample.in_holdover, holds);
      EXPECT_NEAR(pulse->truth.holdover_ns, holds ? 40.0 * (static_cast<double>(marked.back()) + 0.7 - 8.0) : 0.0,
                  1e-9);
    }
    if (t_ns % kSecondNs != 0) continue;
    const std::int64_t s = t_ns / kSecondNs;
    pulses.note_epoch(t_ns, (s >= 3 && s <= 8) || s >= 15);
  }
  EXPECT_EQ(marked, (std::vector<std::int64_t>{3, 4, 5, 6, 7, 8, 9, 10, 11, 15, 16, 17}));
}

}  // namespace pulse_generator_test
}  // namespace inslab::gnss
