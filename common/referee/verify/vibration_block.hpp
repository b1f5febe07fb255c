#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "inslab/data/profiles/vibration_profile.hpp"
#include "inslab/referee/verify/subjects.hpp"
#include "inslab/referee/verify/table.hpp"

/// That vibration is right: increments of sinusoids at any frequency, coning and sculling in the two-sample
/// mechanization, and the spectrum of random vibration. The vehicle rests at latitude 30 deg; the IMU runs at 200 Hz.
namespace inslab::verify {

/// One sinusoid of specific force at the IMU's 200 Hz.
struct SinusoidResult {
  double frequency_hz = 0.0;
  double worst_m_per_s = 0.0;    ///< largest difference of an increment from the difference of the antiderivative
  double largest_m_per_s = 0.0;  ///< largest increment
  double sampled_m_per_s = 0.0;  ///< amplitude times interval: what an instantaneous sample can show
};
SinusoidResult verify_sinusoid(double frequency_hz, const Subjects& subjects = {});

/// Coning: half angle `theta_rad` about x and y, 90 deg apart; sculling: `theta_rad` about x and `a_m_per_s2` along y,
/// in phase.
struct TwoAxisMotion {
  double frequency_hz = 0.0;
  double theta_rad = 0.0;
  double a_m_per_s2 = 0.0;  ///< 0: coning
};

/// Drift of the two-sample mechanization with the interval dt, x = 2 pi f dt, less than the motion's own:
///
///   coning     theta^2 / dt       [ (x - sin x)/2 - sin^2(x/2) sin(x)/3 ]    rad/s
///   sculling   theta a / (2 pi f dt) [ the same ]                            m/s^2
///
/// the exact non-commutativity of an interval less what the two-sample terms give of it; the equivalence of coning and
/// sculling is Roscoe's (AIAA J. Guidance 24, 2001). To first order in theta^2.
double two_sample_residual(const TwoAxisMotion& motion, double dt_s);

/// What the motion's rates and forces, measured on a vehicle at rest, pretend: theta^2 pi f rad/s, theta a/2 m/s^2 (and
/// g theta^2/4 of gravity seen by an IMU that seems tilted).
double pretended_drift(const TwoAxisMotion& motion);

/// Drift of the mechanized IMU from its published true pose, about or along z, over `duration_s`.
double measured_drift(const TwoAxisMotion& motion, VibrationDomain domain, double duration_s,
                      const Subjects& subjects = {});

/// The density of one band, measured over what the table makes of interval means there, with its chi-square limits.
struct BandResult {
  int axis = 0;
  double low_hz = 0.0;
  double high_hz = 0.0;
  double expected = 0.0;  ///< (m/s^2)^2/Hz, mean over the band
  double ratio = 0.0;     ///< measured over expected
  double degrees_of_freedom = 0.0;
  double lower = 0.0;  ///< of the ratio: 99.9 %
  double upper = 0.0;
};
/// The records of all seeds are taken together.
std::vector<BandResult> verify_random(const std::vector<LinearRandomPoint>& table,
                                      const std::vector<std::uint64_t>& seeds, double duration_s,
                                      const Subjects& subjects = {});

/// The whole block. `full`: seeds 1 to 20 of random vibration instead of the first.
std::vector<Table> vibration_tables(bool full, const Subjects& subjects = {});

}  // namespace inslab::verify
