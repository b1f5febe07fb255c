#include "inslab/models/observables/tracking_noise.hpp"

#include <gmock/gmock.h>

namespace inslab::observables {
namespace tracking_noise_test {

TrackingNoise noise_of(GnssSystem system, const char* rinex, double cn0_db_hz) {
  const auto& signal = broadcast::gnss_signal(system, rinex);
  return tracking_noise(signal, signal.frequency_hz, cn0_db_hz, {});
}

// Worked out apart, by hand: c0 = 31623 and 1000.
TEST(TrackingNoise, OfTheCivilSignalAtTwoDensities) {
  const TrackingNoise strong = noise_of(GnssSystem::Gps, "1C", 45.0), weak = noise_of(GnssSystem::Gps, "1C", 30.0);
  EXPECT_NEAR(strong.code_m, 0.3688, 1e-4);
  EXPECT_NEAR(weak.code_m, 2.129, 1e-3);
  EXPECT_NEAR(strong.phase_m, 0.660e-3, 1e-6);
  EXPECT_NEAR(weak.phase_m, 3.756e-3, 1e-6);
  EXPECT_NEAR(strong.rate_m_per_s, 0.02411, 1e-5);
  EXPECT_NEAR(weak.rate_m_per_s, 0.1388, 1e-4);
}

// A tenth of the chip, a third of the variance, no squaring.
TEST(TrackingNoise, ChipRateSubcarrierAndPilot) {
  const TrackingNoise l1 = noise_of(GnssSystem::Gps, "1C", 40.0), l5 = noise_of(GnssSystem::Gps, "5Q", 40.0),
                      e1 = noise_of(GnssSystem::Galileo, "1C", 40.0);
  EXPECT_NEAR(l5.code_m, l1.code_m / 10.0, 1e-12);
  EXPECT_NEAR(e1.code_m, l1.code_m / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(e1.phase_m, l1.phase_m / std::sqrt(1.0 + 1.0 / 400.0), 1e-12);
}

}  // namespace tracking_noise_test
}  // namespace inslab::observables
