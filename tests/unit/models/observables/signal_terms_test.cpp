#include "inslab/models/observables/signal_terms.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "inslab/models/observables/stream_names.hpp"
#include "inslab/models/satellites/kepler_orbit.hpp"
#include "inslab/models/satellites/light_time.hpp"
#include "inslab/models/satellites/nominal_constellation.hpp"
#include "inslab/nav/geodesy.hpp"

namespace inslab::observables {
namespace signal_terms_test {

constexpr double kC = 299792458.0;
constexpr double kL1_hz = 1575.42e6;

SignalTerms some_terms() {
  SignalTerms s;
  s.light_time_s = 0.08;
  s.light_time_rate = 2e-6;
  s.receiver_clock_s = 3e-4;
  s.satellite_clock_s = -1e-4;
  s.group_delay_s = 5e-9;
  s.hardware_bias_s = 7e-9;
  s.ionosphere_m = 11.0;
  s.troposphere_m = 2.5;
  return s;
}

TEST(SignalTerms, PseudorangeIsTheSumOfAll) {
  SignalTerms s = some_terms();
  s.code_multipath_m = 0.3;
  s.code_noise_m = -0.1;
  EXPECT_NEAR(observed(s, kL1_hz).pseudorange_m, kC * (0.08 + 4e-4 + 12e-9) + 11.0 + 2.5 + 0.2, 1e-7);
}

// Code minus phase is twice the ionosphere and the code's own delays.
TEST(SignalTerms, IonosphereHastensThePhase) {
  SignalTerms s = some_terms();
  s.ambiguity_cycles = 17.0;
  s.is_half_cycle_unresolved = true;
  s.phase_multipath_m = 0.004;
  s.phase_noise_m = -0.001;
  const Observed o = observed(s, kL1_hz);
  const double lambda_m = kC / kL1_hz;
  EXPECT_NEAR(o.pseudorange_m - lambda_m * (o.phase_cycles - 17.5), 22.0 + kC * 12e-9 - 0.003, 1e-7);
}

TEST(SignalTerms, AmbiguityBringsThePhaseToTheCode) {
  SignalTerms s = some_terms();
  s.ambiguity_cycles = first_ambiguity(s, kL1_hz, 0.0);
  const double lambda_m = kC / kL1_hz;
  const Observed o = observed(s, kL1_hz);
  EXPECT_EQ(s.ambiguity_cycles, std::round(s.ambiguity_cycles));
  EXPECT_LE(std::abs(lambda_m * o.phase_cycles - o.pseudorange_m), 0.5 * lambda_m + 1e-7);
  s.ambiguity_cycles = first_ambiguity(s, kL1_hz, 2000.3);
  EXPECT_NEAR(lambda_m * observed(s, kL1_hz).phase_cycles - o.pseudorange_m, 2000.0 * lambda_m, 0.5 * lambda_m + 1e-7);
}

TEST(SignalTerms, DopplerIsPositiveWhenComingNearer) {
  SignalTerms s;
  s.light_time_rate = -300.0 / kC;
  EXPECT_NEAR(observed(s, kL1_hz).doppler_hz, 300.0 / kC * kL1_hz, 1e-9);
  s.ionosphere_rate_m_per_s = 0.01;
  s.troposphere_rate_m_per_s = 0.004;
  EXPECT_NEAR(observed(s, kL1_hz).doppler_hz, 300.006 / kC * kL1_hz, 1e-9);
}

// The ratio of the frequencies of sender and receiver is the product of clocks and geometry, here written out. Of a
// satellite's usual drift, 5e-12, the product with the rate is nothing; of one that runs away by 1e-6 it is 5 mHz.
TEST(SignalTerms, DopplerHoldsTheProductsOfTheRates) {
  SignalTerms s;
  s.light_time_rate = 3e-6;
  s.receiver_drift = 2e-6;
  s.satellite_drift = 1e-6;
  const long double ratio = (1.0L + 1e-6L) * (1.0L - 3e-6L) / (1.0L + 2e-6L);
  EXPECT_NEAR(observed(s, kL1_hz).doppler_hz, static_cast<double>(-1575.42e6L * (1.0L - ratio)), 1e-9);
}

/// A turn of 250 m/s about a point on the ground with 0.05 rad/s, in e.
satellites::AntennaState turning_antenna(const time::GpsTime& gps, double rest_s, double t_s) {
  constexpr double kRate = 0.05, kRadius_m = 5000.0;
  const nav::Geodetic middle{0.6, 1.9, 3000.0};
  const nav::Matrix3 C_en = nav::C_en(middle.latitude_rad, middle.longitude_rad);
  const double a = kRate * t_s;
  const nav::Vector3 arm_n(kRadius_m * std::cos(a), kRadius_m * std::sin(a), 0.0);
  const nav::Vector3 v_n(-kRate * arm_n.y(), kRate * arm_n.x(), 0.0);
  return {gps, rest_s, nav::ecef_from_geodetic(middle) + C_en * arm_n, C_en * v_n};
}

// The receiver's clock is 0.7 ms ahead and gains 1 ppm. The states are those of the light time itself, so that no
// acceleration has a part in it: that of gravity is not quite that of drawn numbers. A tenth of a second apart five
// points err by v w^4 h^4 / 30 = 5e-9 m/s of the turn, 3e-8 Hz; a rounding of 1e-8 m of the range gives up to
// 18 / (12 h) times as much, 8e-7 Hz.
TEST(SignalTerms, DopplerIsMinusTheDerivativeOfThePhaseByTheReceiversClock) {
  const time::GpsTime begin{2401, 123'456'000'000'000};
  constexpr double kClock_s = 7e-4, kDrift = 1e-6;
  double most_hz = 0.0;
  for (const auto& e : satellites::nominal_constellation(1, begin).keplerian) {
    time::Nanoseconds before = satellites::usual_light_time(e.sqrt_a_sqrt_m * e.sqrt_a_sqrt_m);
    // At a tag the true time is t = T - x, with x = x0 + d t.
    const auto at_tag = [&](double tag_s) {
      const double t_s = (tag_s - kClock_s) / (1.0 + kDrift);
      const auto whole = time::Nanoseconds(std::llround(t_s * 1e9));
      const double rest_s = t_s - time::to_seconds(whole);
      const auto antenna = turning_antenna(begin + whole, rest_s, t_s);
      const auto seen = satellites::sight({satellites::kepler_state(e, antenna.gps + -before), before}, antenna);
      SignalTerms s;
      s.light_time_s = seen.light_time_s;
      s.light_time_rate = seen.light_time_rate;
      s.receiver_clock_s = kClock_s + kDrift * t_s;
      s.receiver_drift = kDrift;
      s.satellite_clock_s = seen.clock_s;
      s.satellite_drift = seen.drift_s_per_s;
      return s;
    };
    before = time::Nanoseconds(std::llround(at_tag(0.0).light_time_s * 1e9));
    const auto phase = [&](double tag_s) { return observed(at_tag(tag_s), kL1_hz).phase_cycles; };
    constexpr double kStep_s = 0.1;
    const double derivative =
        (8.0 * (phase(kStep_s) - phase(-kStep_s)) - (phase(2.0 * kStep_s) - phase(-2.0 * kStep_s))) / (12.0 * kStep_s);
    most_hz = std::max(most_hz, std::abs(observed(at_tag(0.0), kL1_hz).doppler_hz + derivative));
  }
  EXPECT_LT(most_hz, 1e-5);
}

TEST(StreamNames, SaySkyReceiverSatelliteSignalAndTerm) {
  const SatelliteId satellite{GnssSystem::Gps, 7};
  EXPECT_EQ(sky_stream(satellite, "clock"), "sky/G07/clock");
  EXPECT_EQ(receiver_stream(0, "clock"), "gnss0/clock");
  EXPECT_EQ(signal_stream(12, satellite, "1C", "dll"), "gnss12/G07/1C/dll");
}

}  // namespace signal_terms_test
}  // namespace inslab::observables
