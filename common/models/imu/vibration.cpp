#include "inslab/models/imu/vibration.hpp"

#include <algorithm>
#include <cmath>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/models/imu/phase.hpp"

namespace inslab::imu {
namespace {

constexpr std::size_t kMaxOverlappingFades = 2;

/// The part of a raised cosine's length that has passed at `time_ns` + `offset_s`, and 1 over the length, 1/s.
struct Progress {
  double tau;
  double per_s;
};
Progress progress(std::int64_t start_ns, std::int64_t length_ns, std::int64_t time_ns, double offset_s) {
  const double per_s = 1e9 / static_cast<double>(length_ns);
  return {(time::to_seconds(time_ns - start_ns) + offset_s) * per_s, per_s};
}

}  // namespace

Vibration::Vibration(const VibrationProfile& profile, Setup setup) : setup_(std::move(setup)) {
  layers_.push_back(layer_of(profile));
  note_motion();
}

Vibration::Layer Vibration::layer_of(const VibrationProfile& profile) const {
  const auto tone_of = [](const Vector3& amplitude, double frequency_hz, const Vector3& phase_deg) {
    const Vector3 phase_rad = phase_deg * units::kDeg;
    Tone tone;
    tone.frequency_hz = frequency_hz;
    tone.undelayed = {amplitude.cwiseProduct(phase_rad.array().cos().matrix()),
                      amplitude.cwiseProduct(phase_rad.array().sin().matrix())};
    tone.amplitude = tone.undelayed;
    return tone;
  };
  const bool moves = profile.domain == VibrationDomain::Motion;
  Layer layer;
  layer.profile = profile;
  auto& linear = moves ? layer.mount_linear : layer.linear;
  auto& angular = moves ? layer.mount_angular : layer.angular;
  for (const auto& s : profile.linear) linear.push_back(tone_of(s.amplitude_m_per_s2, s.frequency_hz, s.phase_deg));
  for (const auto& s : profile.angular) {
    angular.push_back(tone_of(s.amplitude_deg_per_s * units::kDegPerS, s.frequency_hz, s.phase_deg));
  }
  const auto random = [this](const auto& table, const char* triad) -> std::optional<RandomVibration> {
    if (table.empty()) return std::nullopt;
    return RandomVibration(Spectrum(table), setup_.dt_s, setup_.seed, setup_.sensor + "/vibration/" + triad);
  };
  layer.linear_random = random(profile.linear_random, "accel");
  layer.angular_random = random(profile.angular_random, "gyro");
  if (layer.linear_random) layer.random_within = variance_within(Spectrum(profile.linear_random));
  pass(layer);
  return layer;
}

bool Vibration::Layer::is_still() const {
  return linear.empty() && angular.empty() && !linear_random && !angular_random && !mount_moves();
}

bool Vibration::swap(const VibrationProfile& profile, std::int64_t time_ns, double fade_s) {
  const auto length_ns = static_cast<std::int64_t>(std::llround(fade_s * 1e9));
  const bool moved = mount_moves();
  bool jumps = false;
  if (length_ns <= 0) {
    layers_.clear();
    fades_.clear();
    jumps = moved;
  } else {
    if (fades_.size() == kMaxOverlappingFades) {
      jumps = std::any_of(layers_.begin(), layers_.end(), [](const Layer& layer) { return layer.mount_moves(); });
      drop_layers_until(1);
    }
    fades_.push_back({time_ns, length_ns});
  }
  layers_.push_back(layer_of(profile));
  note_motion();
  return jumps || (length_ns <= 0 && mount_moves());
}

void Vibration::use(const std::vector<VibrationProfile>& profiles) {
  layers_.clear();
  for (const VibrationProfile& profile : profiles) layers_.push_back(layer_of(profile));
  note_motion();
}

void Vibration::drop_layers_until(std::size_t count) {
  layers_.erase(layers_.begin(), layers_.begin() + static_cast<std::ptrdiff_t>(count));
  fades_.erase(fades_.begin(), fades_.begin() + static_cast<std::ptrdiff_t>(count));
  note_motion();
}

void Vibration::note_motion() {
  fastest_motion_hz_ = 0.0;
  has_random_ = false;
  for (const Layer& layer : layers_) {
    for (const auto* tones : {&layer.mount_linear, &layer.mount_angular}) {
      for (const Tone& tone : *tones) fastest_motion_hz_ = std::max(fastest_motion_hz_, tone.frequency_hz);
    }
    has_random_ = has_random_ || layer.linear_random || layer.angular_random;
  }
}

Increments Vibration::increments(std::int64_t from_ns, std::int64_t to_ns) {
  Increments sum;
  if (fades_.empty() && layers_[0].is_still()) return sum;
  if (has_random_) sum = random_increments(from_ns, to_ns);
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

Increments Vibration::random_increments(std::int64_t from_ns, std::int64_t to_ns) {
  const std::int64_t dt_ns = to_ns - from_ns;
  const auto k = static_cast<std::uint64_t>(std::llround(time::to_seconds(from_ns) / setup_.dt_s));
  Increments sum;
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    const double w = weight(i, from_ns, 0.5e-9 * static_cast<double>(dt_ns)).value;
    if (layers_[i].linear_random) sum.dv += w * layers_[i].linear_random->increment(k);
    if (layers_[i].angular_random) sum.dtheta += w * layers_[i].angular_random->increment(k);
  }
  return sum;
}

Vibration::Weight Vibration::weight(std::size_t layer, std::int64_t time_ns, double offset_s) const {
  Weight product{1.0, 0.0};
  for (std::size_t j = layer == 0 ? 0 : layer - 1; j < fades_.size(); ++j) {
    const auto [tau, per_s] = progress(fades_[j].start_ns, fades_[j].length_ns, time_ns, offset_s);
    const bool rising = j + 1 == layer;
    double value = rising ? 1.0 : 0.0;
    double slope = 0.0;
    if (tau < 1.0) {
      const double angle = units::kPi * std::max(tau, 0.0);
      const double sign = rising ? -0.5 : 0.5;
      value = 0.5 + sign * std::cos(angle);
      slope = -sign * units::kPi * per_s * std::sin(angle);
    }
    product = {product.value * value, product.slope * value + product.value * slope};
  }
  return product;
}

MountState Vibration::mount(std::int64_t time_ns, double offset_s) const {
  if (fades_.empty()) return layers_[0].mount(time_ns, offset_s);
  MountState sum;
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    if (!layers_[i].mount_moves()) continue;
    const auto [w, slope] = weight(i, time_ns, offset_s);
    const MountState state = layers_[i].mount(time_ns, offset_s);
    sum.displacement_m += w * state.displacement_m;
    sum.velocity_m_per_s += w * state.velocity_m_per_s + slope * state.displacement_m;
    sum.turn_rad += w * state.turn_rad;
    sum.turn_rate_rad_per_s += w * state.turn_rate_rad_per_s + slope * state.turn_rad;
  }
  return sum;
}

MountState Vibration::Layer::mount(std::int64_t time_ns, double offset_s) const {
  const auto phase = [&](const Tone& tone) {
    return phasor(turns(tone.frequency_hz, 2 * time_ns) + tone.frequency_hz * offset_s);
  };
  // The sinusoid is the imaginary part of amplitude times phasor; its integral without a mean is less its real part
  // over omega.
  MountState state;
  for (const Tone& tone : mount_linear) {
    const std::complex<double> z = phase(tone);
    const double omega = 2.0 * units::kPi * tone.frequency_hz;
    state.displacement_m -= tone.amplitude.imag_times(z) / (omega * omega);
    state.velocity_m_per_s -= tone.amplitude.real_times(z) / omega;
  }
  for (const Tone& tone : mount_angular) {
    const std::complex<double> z = phase(tone);
    state.turn_rad -= tone.amplitude.real_times(z) / (2.0 * units::kPi * tone.frequency_hz);
    state.turn_rate_rad_per_s += tone.amplitude.imag_times(z);
  }
  return state;
}

const Vibration::Tone::Stretch& Vibration::Tone::over(const Span& span) {
  if (span.length_ns() != cached_length_ns) {
    cached_length_ns = span.length_ns();
    const double dt_s = time::to_seconds(cached_length_ns);
    cached = {gain_s(frequency_hz, dt_s), phasor(0.5 * frequency_hz * dt_s)};
  }
  return cached;
}

const std::complex<double>& Vibration::Tone::middle(const Span& span) {
  if (span.twice_middle_ns() != cached_twice_middle_ns) {
    cached_twice_middle_ns = span.twice_middle_ns();
    cached_middle = phasor(turns(frequency_hz, cached_twice_middle_ns));
  }
  return cached_middle;
}

Vector3 Vibration::integral(std::vector<Tone>& tones, const Span& span, const std::vector<Gate>& gates) {
  Vector3 sum = Vector3::Zero();
  for (Tone& tone : tones) {
    const std::complex<double> z =
        gates.empty() ? tone.over(span).gain_s * tone.middle(span)
                      : gated_integral(tone.frequency_hz, turns(tone.frequency_hz, span.twice_middle_ns()), span,
                                       gates.data(), gates.data() + gates.size());
    sum += tone.amplitude.imag_times(z);
  }
  return sum;
}

/// Integral over the span of the gates' product times exp(2 pi i (f (t - t_middle) + middle_turns)).
std::complex<double> Vibration::gated_integral(double frequency_hz, double middle_turns, const Span& span,
                                               const Gate* gate, const Gate* end) {
  if (gate == end) {
    return gain_s(frequency_hz, time::to_seconds(span.to_ns - span.from_ns)) * phasor(middle_turns);
  }
  // A gate is 1/2 -+ 1/2 cos(2 pi g (t - start)) with g = 1 / (2 length): half the tone and a quarter of each
  // neighbour.
  const double length_s = time::to_seconds(gate->fade.length_ns);
  const double into_half_ns = static_cast<double>(span.from_ns + span.to_ns - 2 * gate->fade.start_ns);
  const double g_hz = 0.5 / length_s;
  const double g_turns = g_hz * into_half_ns * 0.5e-9;
  const double sign = gate->rising ? -0.25 : 0.25;
  return 0.5 * gated_integral(frequency_hz, middle_turns, span, gate + 1, end) +
         sign * (gated_integral(frequency_hz + g_hz, middle_turns + g_turns, span, gate + 1, end) +
                 gated_integral(frequency_hz - g_hz, middle_turns - g_turns, span, gate + 1, end));
}

}  // namespace inslab::imu
