#include "inslab/noise/allan/chosen_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "inslab/noise/allan/goodness.hpp"
#include "tests/unit/noise/allan/simulated_noise.hpp"

namespace inslab::allan {
namespace chosen_fit_test {

using ::testing::UnorderedElementsAre;

Record simulated(const NoiseModel& model, double dt_s, std::uint64_t seed, std::size_t count) {
  Record record(dt_s);
  test::SimulatedNoise noise(model, dt_s, seed);
  for (std::size_t k = 0; k < count; ++k) record.add(noise.next());
  return record;
}

/// White noise as a sensor's filter leaves it: of density N far above T. As with the ADIS16405 at 100 Hz: T = 5.5 ms.
NoiseModel filtered_white(double density, double time_s, double dt_s) {
  NoiseModel model;
  const double decay = std::exp(-dt_s / time_s);
  model.gm_sigma = density * std::sqrt((1.0 - decay) / (1.0 + decay) / dt_s);
  model.gm_correlation_time_s = time_s;
  return model;
}

void expect_white(const ChosenFit& chosen, double density) {
  const auto log = [&](const NoiseModel& model) { return chosen.likelihood.log(model); };
  const Interval interval = likelihood_interval(log, chosen.fit, Parameter::White, 0.99);
  EXPECT_TRUE(interval.contains(density)) << density << " is not in " << interval.low << " to " << interval.high;
  EXPECT_NEAR(chosen.fit.model.white / density, 1.0, 0.04);
}

TEST(ChosenFit, AProcessFasterThanAFewSamplesIsWhiteNoise) {
  const ChosenFit chosen = choose_fit(simulated(filtered_white(2.5, 0.0055, 0.01), 0.01, 1, 720'000), 0.0);
  EXPECT_THAT(chosen.fit.terms, UnorderedElementsAre(Term::White));
  EXPECT_NEAR(chosen.fast_process_s, 0.0055, 0.001);
  expect_white(chosen, 2.5);
  EXPECT_FALSE(goodness_of(chosen.likelihood, chosen.fit.model, 1).is_poor());
}

TEST(ChosenFit, ASlowBiasBesideItIsStillFound) {
  const double dt_s = 0.01;
  test::SimulatedNoise fast(filtered_white(2.5, 0.0055, dt_s), dt_s, 2);
  test::SimulatedNoise slow({0.0, 0.0, 0.0, 0.0, 1.5, 30.0}, dt_s, 3);
  Record record(dt_s);
  for (int k = 0; k < 720'000; ++k) record.add(fast.next() + slow.next());
  const ChosenFit chosen = choose_fit(record, 0.0);
  EXPECT_THAT(chosen.fit.terms, UnorderedElementsAre(Term::White, Term::GaussMarkov));
  expect_white(chosen, 2.5);
  EXPECT_NEAR(chosen.fit.model.gm_sigma, 1.5, 0.3);
}

TEST(ChosenFit, ARecordTooShortToLookPastItGivesItsDensity) {
  const ChosenFit chosen = choose_fit(simulated(filtered_white(2.5, 0.03, 0.01), 0.01, 4, 4'000), 0.0);
  EXPECT_THAT(chosen.fit.terms, UnorderedElementsAre(Term::White));
}

TEST(ChosenFit, AProcessOfManySamplesStaysOne) {
  const NoiseModel truth{0.1, 0.0, 0.0, 0.0, 0.3, 10.0};
  const ChosenFit chosen = choose_fit(simulated(truth, 0.1, 5, 4'000), 0.0);
  EXPECT_THAT(chosen.fit.terms, UnorderedElementsAre(Term::White, Term::GaussMarkov));
  EXPECT_EQ(chosen.fast_process_s, 0.0);
  EXPECT_EQ(chosen.finest_tau_s, 0.0);
}

}  // namespace chosen_fit_test
}  // namespace inslab::allan
