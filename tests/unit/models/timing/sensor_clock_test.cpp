#include "inslab/models/timing/sensor_clock.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::timing {
namespace sensor_clock_test {

constexpr std::int64_t kPeriodNs = 10000000;  // 100 Hz
const time::GpsTime kStart{2400, 345600000000000};

StreamHeader sample(std::uint64_t k) {
  StreamHeader header;
  header.sequence_number = k;
  header.sim_time_ns = static_cast<std::int64_t>(k) * kPeriodNs;
  const time::GpsTime valid = kStart + time::Nanoseconds(header.sim_time_ns);
  header.gps_week = valid.week;
  header.gps_time_of_week_ns = valid.time_of_week_ns;
  return header;
}

/// Tag less time of validity.
std::int64_t error_ns(const StreamHeader& header) {
  const time::GpsTime tag{header.gps_week, header.gps_time_of_week_ns};
  return (tag - kStart).count() - header.sim_time_ns;
}

SensorClock clock_of(const TimeTagErrors& errors, const char* sensor = "gnss0") { return {errors, 0.01, 7, sensor}; }

TEST(SensorClock, WithoutErrorsTagsTheTimeOfValidity) {
  SensorClock clock = clock_of({});
  EXPECT_TRUE(clock.is_off());
  EXPECT_EQ(error_ns(clock.tagged(sample(3), 3)), 0);
}

TEST(SensorClock, AnOffsetIsAddedToTheTagAndNotToSimTime) {
  TimeTagErrors errors;
  errors.offset_s = -0.0123;
  SensorClock clock = clock_of(errors);
  const StreamHeader tagged = clock.tagged(sample(5), 5);
  EXPECT_EQ(error_ns(tagged), -12300000);
  EXPECT_EQ(tagged.sim_time_ns, 5 * kPeriodNs);
  EXPECT_EQ(tagged.sequence_number, 5u);
}

TEST(SensorClock, ATagBeforeTheWeekBeganIsOfTheWeekBefore) {
  TimeTagErrors errors;
  errors.offset_s = -1.0;
  SensorClock clock = clock_of(errors);
  StreamHeader header;
  header.gps_week = 2400;
  header.gps_time_of_week_ns = 250000000;
  const StreamHeader tagged = clock.tagged(header, 1);
  EXPECT_EQ(tagged.gps_week, 2399u);
  EXPECT_EQ(tagged.gps_time_of_week_ns, (604800 - 1) * 1000000000LL + 250000000);
}

TEST(SensorClock, ADriftGrowsFromWhenItCameIntoUse) {
  // 20 ppm over 100 s: 2 ms. From a swap to 5 ppm at 100 s on 5 us a second.
  TimeTagErrors errors;
  errors.drift_ppm = 20.0;
  SensorClock clock = clock_of(errors);
  EXPECT_EQ(error_ns(clock.tagged(sample(10000), 10000)), 2000000);
  clock.retune(errors, Continuity::Keep, 10000, 10000 * kPeriodNs);
  EXPECT_EQ(error_ns(clock.tagged(sample(20000), 20000)), 4000000);
  errors.drift_ppm = 5.0;
  clock.retune(errors, Continuity::Keep, 20000, 20000 * kPeriodNs);
  EXPECT_EQ(error_ns(clock.tagged(sample(30000), 30000)), 500000);
}

TEST(SensorClock, StepsStay) {
  TimeTagErrors errors;
  errors.steps = {{1.0, 0.002}, {2.0, -0.005}};
  SensorClock clock = clock_of(errors);
  EXPECT_EQ(error_ns(clock.tagged(sample(99), 99)), 0);
  EXPECT_EQ(error_ns(clock.tagged(sample(100), 100)), 2000000);
  EXPECT_EQ(error_ns(clock.tagged(sample(200), 200)), -3000000);
}

TEST(SensorClock, TagsAreWholeCountsTheNearest) {
  TimeTagErrors errors;
  errors.quantization_s = 0.004;
  SensorClock clock = clock_of(errors);
  // 10 ms is 2.5 counts, of which a half goes up; 20 ms is 5 counts; 30 ms is 7.5.
  EXPECT_EQ(error_ns(clock.tagged(sample(1), 1)), 2000000);
  EXPECT_EQ(error_ns(clock.tagged(sample(2), 2)), 0);
  EXPECT_EQ(error_ns(clock.tagged(sample(3), 3)), 2000000);
  errors.offset_s = 0.0011;
  clock.use(errors);
  EXPECT_EQ(error_ns(clock.tagged(sample(2), 2)), 0);
  EXPECT_EQ(error_ns(clock.tagged(sample(1), 1)), 2000000);
}

TEST(SensorClock, WhiteJitterHasItsSigmaAndIsOfEachSampleAlone) {
  // The mean square of N = 20000 is sigma^2 within 4 sqrt(2/N) = 4 %; neighbours are uncorrelated within 4/sqrt(N).
  TimeTagErrors errors;
  errors.white_sigma_s = 1e-4;
  SensorClock clock = clock_of(errors);
  double square = 0.0, product = 0.0, last = 0.0;
  constexpr int kCount = 20000;
  for (std::uint64_t k = 1; k <= kCount; ++k) {
    const double error = static_cast<double>(error_ns(clock.tagged(sample(k), k))) / 1e5;
    square += error * error / kCount;
    product += error * last / kCount;
    last = error;
  }
  EXPECT_NEAR(square, 1.0, 0.04);
  EXPECT_NEAR(product, 0.0, 0.029);
  SensorClock again = clock_of(errors);
  EXPECT_EQ(static_cast<double>(error_ns(again.tagged(sample(kCount), kCount))) / 1e5, last);
}

TEST(SensorClock, GaussMarkovJitterHasItsSpreadAndCorrelation) {
  // T = 0.1 s is ten samples: covariance exp(-1) of the variance ten apart; of N = 20000 4 sqrt(2 * 10 / N) = 0.13.
  TimeTagErrors errors;
  errors.gm_sigma_s = 1e-4;
  errors.gm_correlation_time_s = 0.1;
  SensorClock clock = clock_of(errors);
  std::vector<double> jitter;
  for (std::uint64_t k = 1; k <= 20000; ++k) {
    jitter.push_back(static_cast<double>(error_ns(clock.tagged(sample(k), k))) / 1e5);
  }
  double variance = 0.0, covariance = 0.0;
  for (std::size_t k = 0; k + 10 < jitter.size(); ++k) {
    variance += jitter[k] * jitter[k] / static_cast<double>(jitter.size());
    covariance += jitter[k] * jitter[k + 10] / static_cast<double>(jitter.size());
  }
  EXPECT_NEAR(variance, 1.0, 0.13);
  EXPECT_NEAR(covariance, std::exp(-1.0), 0.13);
}

TEST(SensorClock, EverySensorHasItsOwnDraws) {
  TimeTagErrors errors;
  errors.white_sigma_s = 1e-4;
  SensorClock one = clock_of(errors), other = clock_of(errors, "imu0");
  EXPECT_NE(error_ns(one.tagged(sample(1), 1)), error_ns(other.tagged(sample(1), 1)));
}

TEST(SensorClock, ResetTakesTheJitterBackToZero) {
  TimeTagErrors errors;
  errors.gm_sigma_s = 1e-3;
  errors.gm_correlation_time_s = 1e6;
  SensorClock clock = clock_of(errors);
  clock.tagged(sample(1), 1);
  clock.retune(errors, Continuity::Reset, 1, kPeriodNs);
  // In one step the state grows to sigma sqrt(2 dt/T): 1.4e-4 of sigma, 140 ns; six of them.
  EXPECT_LT(std::abs(error_ns(clock.tagged(sample(2), 2))), 6 * 142);
}

}  // namespace sensor_clock_test
}  // namespace inslab::timing
