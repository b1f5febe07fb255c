#include "inslab/noise/allan/fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "inslab/foundation/units/units.hpp"
#include "inslab/noise/random/flicker.hpp"
#include "tests/unit/noise/allan/simulated_noise.hpp"

namespace inslab::allan {
namespace fit_test {

Likelihood simulated(const NoiseModel& model, double dt_s, std::uint64_t seed, std::size_t count) {
  Record record(dt_s);
  test::SimulatedNoise noise(model, dt_s, seed);
  for (std::size_t k = 0; k < count; ++k) record.add(noise.next());
  return Likelihood(record);
}

LogLikelihood log_of(const Likelihood& record) {
  return [&record](const NoiseModel& model) { return record.log(model); };
}

void expect_in_interval(const Likelihood& record, const Fit& fit, Parameter parameter, double truth) {
  const Interval interval = likelihood_interval(log_of(record), fit, parameter, 0.99);
  EXPECT_TRUE(interval.contains(truth)) << truth << " is not in " << interval.low << " to " << interval.high;
  EXPECT_TRUE(interval.contains(value_of(fit.model, parameter)));
}

TEST(Fit, FindsWhiteNoiseAndBiasWithinTheirIntervals) {
  const NoiseModel truth{0.02, 0.0, 0.0, 0.0, 0.5, 20.0};
  const Likelihood record = simulated(truth, 0.05, 1, 100'000);
  const Fit found = fit(record, {Term::White, Term::GaussMarkov});
  for (const Parameter parameter : {Parameter::White, Parameter::GmSigma, Parameter::GmCorrelationTime}) {
    expect_in_interval(record, found, parameter, value_of(truth, parameter));
  }
}

TEST(Fit, FindsQuantizationAndWalkBesideWhiteNoise) {
  const NoiseModel truth{0.1, 0.05, 0.0, 0.02, 0.0, 0.0};
  const Likelihood record = simulated(truth, 0.1, 2, 60'000);
  const Fit found = fit(record, {Term::White, Term::Quantization, Term::RandomWalk});
  for (const Parameter parameter : {Parameter::White, Parameter::Quantization, Parameter::RandomWalk}) {
    expect_in_interval(record, found, parameter, value_of(truth, parameter));
  }
}

TEST(Fit, FindsTheFlickerOfTheSensorModelBesideWhiteNoise) {
  // Of 16 intervals at 99 % more than 2 miss the truth with a chance of 5e-4.
  const double dt_s = 0.2;
  const NoiseModel truth{0.1, 0.0, 0.05, 0.0, 0.0, 0.0};
  const double limit = 0.5 * chi_square_quantile(0.99, 1.0);
  int missed = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    random::Flicker flicker(truth.flicker, dt_s, random::Stream(seed, "flicker"));
    random::WhiteNoise white(truth.white, dt_s, random::Stream(seed, "white"));
    Record data(dt_s);
    for (std::uint64_t k = 0; k < 50'000; ++k) {
      data.add(white.increment(k) + flicker.value() * dt_s);
      flicker.advance(k);
    }
    const Likelihood record(data);
    const Fit found = fit(record, {Term::White, Term::Flicker});
    for (const Parameter parameter : {Parameter::White, Parameter::Flicker}) {
      if (drop_at(log_of(record), found, parameter, value_of(truth, parameter)) > limit) ++missed;
    }
  }
  EXPECT_LE(missed, 2);
}

/// Exact flicker: processes an octave apart, from a 64th of a sample to days, each one's integral over the sample taken
/// and not a value held.
class ExactFlicker {
 public:
  ExactFlicker(double instability, double dt_s, std::uint64_t seed) : random_(seed) {
    const double sigma = instability * std::sqrt(std::log(2.0) / units::kPi);
    for (double time_s = dt_s / 64.0; time_s < 3e5; time_s *= 2.0) {
      const double p = std::exp(-dt_s / time_s);
      Process process{p, time_s * (1.0 - p), sigma * std::sqrt(1.0 - p * p), 0.0, 0.0, sigma * normal_(random_)};
      // Of the noise that comes in during a sample: variance of the end value, of the integral, and both together.
      const double both = sigma * sigma * time_s * (1.0 - p) * (1.0 - p);
      const double integral = sigma * sigma * time_s * (2.0 * dt_s - time_s * (1.0 - p) * (3.0 - p));
      process.integral_by_drive = both / process.drive;
      process.integral_alone = std::sqrt(std::max(integral - std::pow(process.integral_by_drive, 2), 0.0));
      processes_.push_back(process);
    }
  }
  double increment() {
    double sum = 0.0;
    for (Process& process : processes_) {
      const double a = normal_(random_), b = normal_(random_);
      sum += process.x * process.integral_of_x + process.integral_by_drive * a + process.integral_alone * b;
      process.x = process.decay * process.x + process.drive * a;
    }
    return sum;
  }

 private:
  struct Process {
    double decay, integral_of_x, drive, integral_by_drive, integral_alone, x;
  };
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::vector<Process> processes_;
};

/// 10 deg/h and 0.05 deg/sqrt(h): flicker is above the white noise from 0.2 s on. A model that ends at 0.16 Hz finds
/// 14.3 and 0.058.
TEST(Fit, FindsExactFlickerWhereItIsFast) {
  const double dt_s = 0.02, flicker = 10.0, white = 0.05 * 60.0;  // deg/h, deg/h sqrt(s)
  const double limit = 0.5 * chi_square_quantile(0.99, 1.0);
  int missed = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    ExactFlicker exact(flicker, dt_s, seed);
    random::WhiteNoise noise(white, dt_s, random::Stream(seed, "white"));
    Record data(dt_s);
    for (std::uint64_t k = 0; k < 60'000; ++k) data.add(noise.increment(k) + exact.increment());
    const Likelihood record(data);
    const Fit found = fit(record, {Term::White, Term::Flicker});
    EXPECT_NEAR(found.model.flicker, flicker, 0.06 * flicker) << seed;
    EXPECT_NEAR(found.model.white, white, 0.03 * white) << seed;
    missed += drop_at(log_of(record), found, Parameter::Flicker, flicker) > limit ? 1 : 0;
    missed += drop_at(log_of(record), found, Parameter::White, white) > limit ? 1 : 0;
  }
  EXPECT_LE(missed, 1);
}

TEST(Fit, SelectsTheTermsThatAreThere) {
  using ::testing::UnorderedElementsAre;
  EXPECT_THAT(select(simulated({0.1, 0.0, 0.0, 0.0, 0.0, 0.0}, 0.1, 3, 4'000)).terms,
              UnorderedElementsAre(Term::White));
  EXPECT_THAT(select(simulated({0.1, 0.0, 0.0, 0.05, 0.0, 0.0}, 0.1, 4, 4'000)).terms,
              UnorderedElementsAre(Term::White, Term::RandomWalk));
  EXPECT_THAT(select(simulated({0.1, 0.0, 0.0, 0.0, 0.3, 10.0}, 0.1, 5, 4'000)).terms,
              UnorderedElementsAre(Term::White, Term::GaussMarkov));
}

TEST(Select, EndsWhereTheLikelihoodIsNoNumber) {
  // As in a log with spoiled bytes: no choice is better than another, which must not be taken for better for ever.
  Record record(0.1);
  for (int k = 0; k < 4000; ++k) record.add(k % 7 == 0 ? 1e300 : -1e280);
  select(Likelihood(record));
}

TEST(Fit, IntervalsHoldTheTruthEvenAtElevenCorrelationTimes) {
  // 60 records as long as the thesis's 45 h at T = 14400 s; of 120 intervals at 99 % more than 6 miss the truth with a
  // chance of 1e-4.
  const NoiseModel truth{0.0, 0.0, 0.0, 0.0, 1.0, 14400.0};
  const double limit = 0.5 * chi_square_quantile(0.99, 1.0);
  int missed = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Likelihood record = simulated(truth, 60.0, seed, 2700);
    const Fit found = fit(record, {Term::GaussMarkov});
    for (const Parameter parameter : {Parameter::GmSigma, Parameter::GmCorrelationTime}) {
      if (drop_at(log_of(record), found, parameter, value_of(truth, parameter)) > limit) ++missed;
    }
  }
  EXPECT_LE(missed, 6);
}

TEST(Fit, AnEndThatTheRecordDoesNotBoundIsInfinite) {
  // One correlation time: a walk explains the record as well.
  const Likelihood record = simulated({0.0, 0.0, 0.0, 0.0, 1.0, 1000.0}, 1.0, 1, 1000);
  const Fit found = fit(record, {Term::GaussMarkov});
  EXPECT_TRUE(std::isinf(likelihood_interval(log_of(record), found, Parameter::GmCorrelationTime, 0.99).high));
}

}  // namespace fit_test
}  // namespace inslab::allan
