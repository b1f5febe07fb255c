#include <cmath>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/models/imu/phase.hpp"
#include "inslab/models/imu/vibration.hpp"

/// Second moments of a vibration within an interval.
namespace inslab::imu {
namespace {

double sinc(double frequency_hz, double dt_s) { return gain_s(frequency_hz, dt_s) / dt_s; }

}  // namespace

/// Two sinusoids Im(A z), Im(B w) have the mean product (Re(A conj(B) z conj(w)) - Re(A B z w)) / 2 over the interval,
/// each at its sum or difference of frequencies.
Matrix3 Vibration::moments(std::int64_t from_ns, std::int64_t to_ns) {
  Matrix3 moments = Matrix3::Zero();
  if (fades_.empty() && layers_[0].is_still()) return moments;
  struct Part {
    double weight;
    const Tone* tone;
    std::complex<double> middle;
  };
  const double dt_s = time::to_seconds(to_ns - from_ns);
  std::vector<Part> parts;
  Vector3 mean = Vector3::Zero();
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    const double w = weight(i, from_ns, 0.5 * dt_s).value;
    for (Tone& tone : layers_[i].linear) {
      parts.push_back({w, &tone, tone.middle({from_ns, to_ns})});
      mean += w * sinc(tone.frequency_hz, dt_s) * tone.amplitude.imag_times(parts.back().middle);
    }
    moments.diagonal() += w * w * layers_[i].random_within;
  }
  for (const Part& a : parts) {
    const Phasors& A = a.tone->amplitude;
    for (const Part& b : parts) {
      const Phasors& B = b.tone->amplitude;
      const std::complex<double> difference =
          sinc(a.tone->frequency_hz - b.tone->frequency_hz, dt_s) * a.middle * std::conj(b.middle);
      const std::complex<double> sum = sinc(a.tone->frequency_hz + b.tone->frequency_hz, dt_s) * a.middle * b.middle;
      // A conj(B) and A B of all pairs of axes, their real and imaginary parts.
      const Matrix3 rr = A.real * B.real.transpose(), ii = A.imag * B.imag.transpose();
      const Matrix3 ri = A.real * B.imag.transpose(), ir = A.imag * B.real.transpose();
      moments += 0.5 * a.weight * b.weight *
                 (difference.real() * (rr + ii) - difference.imag() * (ir - ri) - sum.real() * (rr - ii) +
                  sum.imag() * (ri + ir));
    }
  }
  return moments - mean * mean.transpose();
}

/// The variance that the intervals' means leave of a random vibration: the integral of S (1 - sinc^2(pi f dt)), by
/// Simpson's rule over the logarithm of f between corners.
Vector3 Vibration::variance_within(const Spectrum& spectrum) const {
  constexpr int kSteps = 400;  // even; of sinc^2's waves of 1/dt those above some 40 per corner average out
  Vector3 variance = Vector3::Zero();
  for (std::size_t i = 0; i + 1 < spectrum.corners(); ++i) {
    const double from_hz = spectrum.corner_hz(i), step = std::log(spectrum.corner_hz(i + 1) / from_hz) / kSteps;
    for (int n = 0; n <= kSteps; ++n) {
      const double frequency_hz = n == kSteps ? spectrum.corner_hz(i + 1) : from_hz * std::exp(step * n);
      const double weight = n == 0 || n == kSteps ? 1.0 : n % 2 == 1 ? 4.0 : 2.0;
      const double gain = sinc(frequency_hz, setup_.dt_s);
      for (int axis = 0; axis < 3; ++axis) {
        variance[axis] +=
            weight * step / 3.0 * frequency_hz * spectrum.density(axis, frequency_hz) * (1.0 - gain * gain);
      }
    }
  }
  return variance;
}

}  // namespace inslab::imu
