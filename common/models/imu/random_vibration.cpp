#include "inslab/models/imu/random_vibration.hpp"

#include <algorithm>
#include <complex>
#include <unsupported/Eigen/FFT>

#include "inslab/models/imu/phase.hpp"
#include "inslab/noise/random/lanes.hpp"

namespace inslab::imu {
namespace {

constexpr std::size_t kFewestTaps = 256;
constexpr std::size_t kMostTaps = 1024;
constexpr double kStepsBelowTable = 8.0;
constexpr std::size_t kAhead = 256;  // numbers drawn at a time

std::size_t taps_for(const Spectrum& spectrum, double dt_s, const LowPass& filter) {
  double lowest_hz = spectrum.lowest_hz();
  if (filter.order() != 0) lowest_hz = std::min(lowest_hz, filter.s() / (2.0 * units::kPi));
  std::size_t taps = kFewestTaps;
  while (taps < kMostTaps && static_cast<double>(taps) * dt_s * lowest_hz < kStepsBelowTable) taps *= 2;
  return taps;
}

/// S_d of the class comment, from the one-sided density of the spectrum.
double folded_density(const Spectrum& spectrum, int axis, double frequency_hz, double dt_s, const LowPass& filter) {
  const double rate_hz = 1.0 / dt_s;
  double sum = 0.0;
  for (double m = 0.0; m * rate_hz - frequency_hz <= spectrum.highest_hz(); m += 1.0) {
    for (const double side : {1.0, -1.0}) {
      if (m == 0.0 && side < 0.0) continue;
      const double image_hz = std::abs(frequency_hz + side * m * rate_hz);
      const double gain = gain_s(image_hz, dt_s);
      const double passed = filter.order() == 0 ? 1.0 : std::norm(filter.response(image_hz));
      sum += 0.5 * spectrum.density(axis, image_hz) * gain * gain * passed;
    }
  }
  return sum;
}

/// h[0..n-1], centred on n/2.
std::vector<double> filter_for(const Spectrum& spectrum, int axis, double dt_s, const LowPass& low_pass) {
  const std::size_t n = taps_for(spectrum, dt_s, low_pass);
  std::vector<std::complex<double>> response(n);
  for (std::size_t i = 0; i <= n / 2; ++i) {
    const double frequency_hz = static_cast<double>(i) / (static_cast<double>(n) * dt_s);
    const double amplitude = std::sqrt(folded_density(spectrum, axis, frequency_hz, dt_s, low_pass) / dt_s);
    response[i] = amplitude;
    if (i > 0) response[n - i] = amplitude;
  }
  std::vector<std::complex<double>> taps;
  Eigen::FFT<double> fft;
  fft.inv(taps, response);
  std::vector<double> filter(n);
  for (std::size_t j = 0; j < n; ++j) {
    const double hann = 0.5 - 0.5 * std::cos(2.0 * units::kPi * static_cast<double>(j) / static_cast<double>(n));
    filter[j] = hann * taps[(j + n / 2) % n].real();
  }
  return filter;
}

/// Sum of a[i] b[i] over n, a multiple of 8; four sums side by side, added up in a fixed order.
double product_sum(const double* a, const double* b, std::size_t n) {
  using random::Doubles;
  Doubles s0{}, s1{}, s2{}, s3{};
  for (std::size_t i = 0; i < n; i += 8) {
    s0 += Doubles{a[i], a[i + 1]} * Doubles{b[i], b[i + 1]};
    s1 += Doubles{a[i + 2], a[i + 3]} * Doubles{b[i + 2], b[i + 3]};
    s2 += Doubles{a[i + 4], a[i + 5]} * Doubles{b[i + 4], b[i + 5]};
    s3 += Doubles{a[i + 6], a[i + 7]} * Doubles{b[i + 6], b[i + 7]};
  }
  const Doubles sum = (s0 + s1) + (s2 + s3);
  return sum[0] + sum[1];
}

}  // namespace

RandomVibration::RandomVibration(const Spectrum& spectrum, double dt_s, std::uint64_t seed, const std::string& root,
                                 const LowPasses& filters)
    : dt_s_(dt_s) {
  static constexpr const char* kNames[] = {".x/random", ".y/random", ".z/random"};
  for (int axis = 0; axis < 3; ++axis) {
    const LowPass& low_pass = filters[static_cast<std::size_t>(axis)];
    axes_.push_back({filter_for(spectrum, axis, dt_s, low_pass), random::Stream(seed, root + kNames[axis]), {}, 0});
  }
}

Vector3 RandomVibration::increment(std::uint64_t k) {
  if (last_k_ != k) {
    last_ = {axes_[0].increment(k), axes_[1].increment(k), axes_[2].increment(k)};
    last_k_ = k;
  }
  return last_;
}

double RandomVibration::Axis::increment(std::uint64_t k) {
  const std::size_t n = filter.size();
  if (k < first || k + n > first + noise.size()) {
    constexpr std::uint64_t kGroup = random::Stream::kGroup;
    const std::uint64_t begin = k / kGroup * kGroup;
    const std::uint64_t end = begin + n + kAhead;  // a multiple of the group, as n and kAhead are
    std::vector<double> drawn;
    drawn.reserve(n + kAhead);
    if (begin >= first && begin < first + noise.size()) {
      drawn.assign(noise.begin() + static_cast<std::ptrdiff_t>(begin - first), noise.end());
    }
    while (begin + drawn.size() < end) {
      const random::Stream::Group group = stream.normal_group((begin + drawn.size()) / kGroup);
      drawn.insert(drawn.end(), group.begin(), group.end());
    }
    noise = std::move(drawn);
    first = begin;
  }
  return product_sum(filter.data(), noise.data() + (k - first), n);
}

double RandomVibration::realised_density(int axis, double frequency_hz) const {
  const std::vector<double>& filter = axes_[static_cast<std::size_t>(axis)].filter;
  std::complex<double> response = 0.0;
  for (std::size_t j = 0; j < filter.size(); ++j) {
    response += filter[j] * phasor(frequency_hz * dt_s_ * static_cast<double>(j));
  }
  return 2.0 * std::norm(response) / dt_s_;  // of y/dt: 2 |H|^2 dt / dt^2
}

}  // namespace inslab::imu
