#include <algorithm>
#include <cmath>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/models/imu/phase.hpp"
#include "inslab/models/imu/vibration.hpp"

/// Vibration behind the low-pass filters of a sensor.
namespace inslab::imu {
namespace {

bool is_on(const LowPasses& filters) {
  return std::any_of(filters.begin(), filters.end(), [](const LowPass& filter) { return filter.order() != 0; });
}

/// `v` where an axis has a filter, 0 elsewhere.
Vector3 filtered_axes(const LowPasses& filters, const Vector3& v) {
  Vector3 out = v;
  for (int axis = 0; axis < 3; ++axis) {
    if (filters[static_cast<std::size_t>(axis)].order() == 0) out[axis] = 0.0;
  }
  return out;
}

}  // namespace

void Vibration::use(const Bandwidths& bandwidths) {
  if (bandwidths == bandwidths_) return;
  bandwidths_ = bandwidths;
  for (Layer& layer : layers_) pass(layer);
}

/// What delays and filters make of a layer's tones, and its random vibration behind the filters.
void Vibration::pass(Layer& layer) const {
  const auto respond = [](std::vector<Tone>& tones, const LowPasses& filters, std::int64_t delay_ns) {
    for (Tone& tone : tones) {
      tone.amplitude = tone.undelayed;
      if (delay_ns != 0) {
        const std::complex<double> late = phasor(turns(tone.frequency_hz, -2 * delay_ns));
        tone.amplitude = {tone.undelayed.real_times(late), tone.undelayed.imag_times(late)};
      }
      tone.passed = responded(tone.amplitude, filters, tone.frequency_hz);
    }
  };
  respond(layer.linear, bandwidths_.accel, bandwidths_.accel_delay_ns);
  respond(layer.angular, bandwidths_.gyro, bandwidths_.gyro_delay_ns);
  const auto drawn = [this](const auto& table, const char* triad, const LowPasses& filters) {
    std::optional<RandomVibration> random;
    if (table.empty() || !is_on(filters)) return random;
    random.emplace(Spectrum(table), setup_.dt_s, setup_.seed, setup_.sensor + "/vibration/" + triad, filters);
    return random;
  };
  layer.linear_random_passed = drawn(layer.profile.linear_random, "accel", bandwidths_.accel);
  layer.angular_random_passed = drawn(layer.profile.angular_random, "gyro", bandwidths_.gyro);
}

Vibration::Passed Vibration::passed(std::int64_t from_ns, std::int64_t to_ns) {
  Passed passed_here;
  if (fades_.empty() && layers_[0].is_still()) return passed_here;
  passed_here.gyro = passed(bandwidths_.gyro, gyro_steps_, &Layer::angular, from_ns, to_ns);
  passed_here.accel = passed(bandwidths_.accel, accel_steps_, &Layer::linear, from_ns, to_ns);
  if (!has_random_) return passed_here;
  const auto k = static_cast<std::uint64_t>(std::llround(time::to_seconds(from_ns) / setup_.dt_s));
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    Layer& layer = layers_[i];
    const double w = weight(i, from_ns, 0.5e-9 * static_cast<double>(to_ns - from_ns)).value;
    if (layer.linear_random_passed) {
      passed_here.random_felt.dv += w * filtered_axes(bandwidths_.accel, layer.linear_random->increment(k));
      passed_here.random_passed.dv += w * filtered_axes(bandwidths_.accel, layer.linear_random_passed->increment(k));
    }
    if (layer.angular_random_passed) {
      passed_here.random_felt.dtheta += w * filtered_axes(bandwidths_.gyro, layer.angular_random->increment(k));
      passed_here.random_passed.dtheta +=
          w * filtered_axes(bandwidths_.gyro, layer.angular_random_passed->increment(k));
    }
  }
  return passed_here;
}

std::vector<Vibration::Gate> Vibration::gates_of(std::size_t layer) const {
  std::vector<Gate> gates;
  if (layer > 0) gates.push_back({fades_[layer - 1], true});
  for (std::size_t j = layer; j < fades_.size(); ++j) gates.push_back({fades_[j], false});
  return gates;
}

/// A gate is 1/2 -+ 1/2 cos(2 pi g (t - start)), g = 1 / (2 length): half the tone and a quarter of each neighbour. One
/// that is over is 1 or 0.
void Vibration::expand(double frequency_hz, double from_turns, std::complex<double> factor, std::int64_t from_ns,
                       const Gate* gate, const Gate* end, std::vector<Line>& lines) {
  if (gate == end) {
    lines.push_back({frequency_hz, from_turns, factor});
    return;
  }
  if (from_ns >= gate->fade.start_ns + gate->fade.length_ns) {
    if (gate->rising) expand(frequency_hz, from_turns, factor, from_ns, gate + 1, end, lines);
    return;
  }
  const double g_hz = 0.5e9 / static_cast<double>(gate->fade.length_ns);
  const double g_turns = g_hz * 1e-9 * static_cast<double>(from_ns - gate->fade.start_ns);
  const double sign = gate->rising ? -0.25 : 0.25;
  expand(frequency_hz, from_turns, 0.5 * factor, from_ns, gate + 1, end, lines);
  expand(frequency_hz + g_hz, from_turns + g_turns, sign * factor, from_ns, gate + 1, end, lines);
  expand(frequency_hz - g_hz, from_turns - g_turns, sign * factor, from_ns, gate + 1, end, lines);
}

Vibration::Phasors Vibration::responded(const Phasors& amplitude, const LowPasses& filters, double frequency_hz) {
  Phasors out;
  for (int axis = 0; axis < 3; ++axis) {
    const std::complex<double> h = filters[static_cast<std::size_t>(axis)].response(frequency_hz);
    const std::complex<double> z = std::complex<double>(amplitude.real[axis], amplitude.imag[axis]) * h;
    out.real[axis] = z.real();
    out.imag[axis] = z.imag();
  }
  return out;
}

void Vibration::Answers::add(const Phasors& amplitude, const Phasors& out, const Passage& passage) {
  felt += amplitude.imag_times(passage.whole_s);
  y_from += out.imag_times(passage.from);
  slope_from += passage.omega_rad_per_s * out.real_times(passage.from);
  y_to += out.imag_times(passage.to);
  slope_to += passage.omega_rad_per_s * out.real_times(passage.to);
  integral += out.imag_times(passage.whole_s);
}

Vibration::Answers Vibration::answers(const LowPasses& filters, std::vector<Tone> Layer::*tones, const Span& span) {
  const double dt_s = time::to_seconds(span.length_ns());
  Answers sum;
  std::vector<Line> lines;
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    const std::vector<Gate> gates = gates_of(i);
    for (Tone& tone : layers_[i].*tones) {
      if (gates.empty()) {
        const auto& [gain, half] = tone.over(span);
        const std::complex<double>& middle = tone.middle(span);
        sum.add(tone.amplitude, tone.passed,
                {2.0 * units::kPi * tone.frequency_hz, middle * std::conj(half), middle * half, gain * middle});
        continue;
      }
      lines.clear();
      expand(tone.frequency_hz, turns(tone.frequency_hz, 2 * span.from_ns), 1.0, span.from_ns, gates.data(),
             gates.data() + gates.size(), lines);
      for (const Line& line : lines) {
        const double turns_over = line.frequency_hz * dt_s;
        sum.add(tone.amplitude, responded(tone.amplitude, filters, line.frequency_hz),
                {2.0 * units::kPi * line.frequency_hz, line.factor * phasor(line.from_turns),
                 line.factor * phasor(line.from_turns + turns_over),
                 line.factor * gain_s(line.frequency_hz, dt_s) * phasor(line.from_turns + 0.5 * turns_over)});
      }
    }
  }
  return sum;
}

/// Over each span between ends of fades the tones are sums of lines, each of which the filter answers with H times
/// itself and what decays from the span's start.
Unsteady Vibration::passed(const LowPasses& filters, Steps& steps, std::vector<Tone> Layer::*tones,
                           std::int64_t from_ns, std::int64_t to_ns) {
  Unsteady unsteady;
  if (!is_on(filters)) return unsteady;
  std::array<LowPass::State, 3> states;
  Vector3 felt = Vector3::Zero();
  for (std::int64_t a_ns = from_ns, b_ns = to_ns; a_ns < to_ns; a_ns = b_ns) {
    b_ns = to_ns;
    for (const Fade& fade : fades_) {
      const std::int64_t end_ns = fade.start_ns + fade.length_ns;
      if (end_ns > a_ns) b_ns = std::min(b_ns, end_ns);
    }
    const double dt_s = time::to_seconds(b_ns - a_ns);
    const Answers sum = answers(filters, tones, {a_ns, b_ns});
    felt += sum.felt;
    for (int axis = 0; axis < 3; ++axis) {
      const auto n = static_cast<std::size_t>(axis);
      if (filters[n].order() == 0) continue;
      const bool has_slope = filters[n].order() == 2;
      if (a_ns == from_ns) {
        unsteady.start_y[axis] = sum.y_from[axis];
        unsteady.start_slope[axis] = has_slope ? sum.slope_from[axis] : 0.0;
      }
      // About what follows the lines the filter decays.
      const LowPass::State left = steps.spans[n].decayed(
          filters[n], {states[n].y - sum.y_from[axis], states[n].slope - sum.slope_from[axis], states[n].integral},
          dt_s);
      states[n] = {left.y + sum.y_to[axis], has_slope ? left.slope + sum.slope_to[axis] : 0.0,
                   left.integral + sum.integral[axis]};
    }
  }
  const double dt_s = time::to_seconds(to_ns - from_ns);
  for (int axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<std::size_t>(axis);
    const LowPass& filter = filters[n];
    if (filter.order() == 0) continue;
    // Bandwidth takes the mean for that of an interval of mean length, and TriadLimits stretches what it makes of it.
    const double mean = felt[axis] / dt_s;
    const LowPass::State left = steps.intervals[n].decayed(filter, {-mean, 0.0, mean * setup_.dt_s}, setup_.dt_s);
    const LowPass::State& state = states[n];
    const double stretch = dt_s / setup_.dt_s;
    unsteady.add(axis, {state.y - mean - left.y, state.slope - left.slope, state.integral - stretch * left.integral});
    unsteady.start_y[axis] -= mean;
  }
  return unsteady;
}

}  // namespace inslab::imu
