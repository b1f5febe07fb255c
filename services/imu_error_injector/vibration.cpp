#include "services/imu_error_injector/vibration.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "samples/units.hpp"

namespace inslab::imu {
namespace {

constexpr std::size_t kMaxOverlappingFades = 2;

/// f * t less whole turns, t in units of half a nanosecond: the middle of an interval is always a whole number of them.
double turns(double frequency_hz, std::int64_t time_half_ns) {
  constexpr std::int64_t kHalfNsPerS = 2000000000;
  const auto [quotient, remainder] = std::lldiv(time_half_ns, kHalfNsPerS);
  const auto whole_s = static_cast<double>(quotient);
  const double rest_s = static_cast<double>(remainder) * 0.5e-9;
  const double product = frequency_hz * whole_s;
  const double rounding = std::fma(frequency_hz, whole_s, -product);  // exact
  return (product - std::floor(product)) + rounding + frequency_hz * rest_s;
}

/// Integral of cos(2 pi f t) over -dt/2..dt/2, s.
double gain_s(double frequency_hz, double dt_s) {
  const double x = units::kPi * frequency_hz * dt_s;
  return std::abs(x) < 1e-8 ? dt_s : dt_s * std::sin(x) / x;
}

/// exp(2 pi i turns)
std::complex<double> phasor(double turns) {
  const double angle = 2.0 * units::kPi * turns;
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace

Vibration::Vibration(const VibrationProfile& profile) : layers_{layer_of(profile)} {}

Vibration::Layer Vibration::layer_of(const VibrationProfile& profile) {
  const auto tone = [](const Vector3& amplitude, double frequency_hz, const Vector3& phase_deg) {
    const Vector3 phase_rad = phase_deg * units::kDeg;
    return Tone{frequency_hz, amplitude.cwiseProduct(phase_rad.array().cos().matrix()),
                amplitude.cwiseProduct(phase_rad.array().sin().matrix()), 0, 0.0};
  };
  Layer layer;
  for (const auto& s : profile.linear) layer.linear.push_back(tone(s.amplitude_m_per_s2, s.frequency_hz, s.phase_deg));
  for (const auto& s : profile.angular) {
    layer.angular.push_back(tone(s.amplitude_deg_per_s * units::kDegPerS, s.frequency_hz, s.phase_deg));
  }
  return layer;
}

void Vibration::swap(const VibrationProfile& profile, std::int64_t time_ns, double fade_s) {
  const auto length_ns = static_cast<std::int64_t>(std::llround(fade_s * 1e9));
  if (length_ns <= 0) {
    layers_.assign(1, layer_of(profile));
    fades_.clear();
    return;
  }
  if (fades_.size() == kMaxOverlappingFades) drop_layers_until(1);
  layers_.push_back(layer_of(profile));
  fades_.push_back({time_ns, length_ns});
}

void Vibration::drop_layers_until(std::size_t count) {
  layers_.erase(layers_.begin(), layers_.begin() + static_cast<std::ptrdiff_t>(count));
  fades_.erase(fades_.begin(), fades_.begin() + static_cast<std::ptrdiff_t>(count));
}

Increments Vibration::increments(std::int64_t from_ns, std::int64_t to_ns) {
  Increments sum;
  if (fades_.empty() && layers_[0].linear.empty() && layers_[0].angular.empty()) return sum;
  while (from_ns < to_ns) {
    std::int64_t until_ns = to_ns;
    for (std::size_t i = fades_.size(); i-- > 0;) {
      const std::int64_t end_ns = fades_[i].start_ns + fades_[i].length_ns;
      if (end_ns <= from_ns) {  // done, and with it every layer before the one that rose
        drop_layers_until(i + 1);
        break;
      }
      until_ns = std::min(until_ns, end_ns);
    }
    const Span span{from_ns, until_ns};
    std::vector<Gate> gates;
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      gates.clear();
      if (i > 0) gates.push_back({fades_[i - 1], true});
      for (std::size_t j = i; j < fades_.size(); ++j) gates.push_back({fades_[j], false});
      sum += {integral(layers_[i].angular, span, gates), integral(layers_[i].linear, span, gates)};
    }
    from_ns = until_ns;
  }
  return sum;
}

double Vibration::Tone::gain_over(std::int64_t interval_ns) {
  if (interval_ns != cached_interval_ns) {
    cached_interval_ns = interval_ns;
    cached_gain_s = gain_s(frequency_hz, static_cast<double>(interval_ns) * 1e-9);
  }
  return cached_gain_s;
}

Vector3 Vibration::integral(std::vector<Tone>& tones, const Span& span, const std::vector<Gate>& gates) {
  Vector3 sum = Vector3::Zero();
  for (Tone& tone : tones) {
    const double middle_turns = turns(tone.frequency_hz, span.from_ns + span.to_ns);
    const std::complex<double> z = gates.empty() ? tone.gain_over(span.to_ns - span.from_ns) * phasor(middle_turns)
                                                 : gated_integral(tone.frequency_hz, middle_turns, span, gates.data(),
                                                                  gates.data() + gates.size());
    sum += z.imag() * tone.sine + z.real() * tone.cosine;
  }
  return sum;
}

/// Integral over the span of the gates' product times exp(2 pi i (f (t - t_middle) + middle_turns)).
std::complex<double> Vibration::gated_integral(double frequency_hz, double middle_turns, const Span& span,
                                               const Gate* gate, const Gate* end) {
  if (gate == end) {
    return gain_s(frequency_hz, static_cast<double>(span.to_ns - span.from_ns) * 1e-9) * phasor(middle_turns);
  }
  // A gate is 1/2 -+ 1/2 cos(2 pi g (t - start)) with g = 1 / (2 length): half the tone and a quarter of each
  // neighbour.
  const double length_s = static_cast<double>(gate->fade.length_ns) * 1e-9;
  const double into_half_ns = static_cast<double>(span.from_ns + span.to_ns - 2 * gate->fade.start_ns);
  const double g_hz = 0.5 / length_s;
  const double g_turns = g_hz * into_half_ns * 0.5e-9;
  const double sign = gate->rising ? -0.25 : 0.25;
  return 0.5 * gated_integral(frequency_hz, middle_turns, span, gate + 1, end) +
         sign * (gated_integral(frequency_hz + g_hz, middle_turns + g_turns, span, gate + 1, end) +
                 gated_integral(frequency_hz - g_hz, middle_turns - g_turns, span, gate + 1, end));
}

}  // namespace inslab::imu
