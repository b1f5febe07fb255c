#pragma once

#include <complex>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "inslab/data/profiles/vibration_profile.hpp"
#include "inslab/models/imu/increments.hpp"
#include "inslab/models/imu/low_pass.hpp"
#include "inslab/models/imu/random_vibration.hpp"

namespace inslab::imu {

/// Where the mount of an IMU is against its place in the vehicle, in the axes it has at rest (b without vibration), and
/// how it moves there. `turn` is the rotation vector of the moved axes.
struct MountState {
  Vector3 displacement_m = Vector3::Zero();
  Vector3 velocity_m_per_s = Vector3::Zero();
  Vector3 turn_rad = Vector3::Zero();
  Vector3 turn_rate_rad_per_s = Vector3::Zero();
};

/// Stage 2: vibration, sums of amplitude * sin(2 pi f t + phase) of specific force and angular rate along b, t since
/// the scenario's start, and random vibration with a given spectrum.
///
/// Domain `sensor`, thesis (3-33), (3-34): it is added to the IMU's output. Each interval is integrated in closed form,
/// (amplitude / pi f) sin(pi f dt) sin(2 pi f t_middle + phase), so a frequency above half the sample rate comes out as
/// its integral and not as an alias; so does random vibration (RandomVibration).
///
/// Domain `motion`: the mount moves against the vehicle; the sinusoids are the second derivative of its displacement
/// and the derivative of its rotation vector, whose means are 0. What the IMU feels of it is in MountMotion.
///
/// A swap may fade: the new profile's weight is (1 - cos(pi tau))/2 (continuous with its slope), the old one's the
/// rest. Products of cosines are sums of cosines, so fades of sinusoids are integrated in closed form, too; random
/// vibration takes the weight at the interval's middle; of a moving mount the weights are those of displacement and
/// turn. At most two fades overlap: a further swap ends the older at once.
///
/// Behind a sensor's bandwidth: passed() is the answer of the filters in continuous time to the sinusoids, fades
/// included, so that their amplitude and phase are exact at every frequency and aliases come through as they would;
/// random vibration has its spectrum shaped before it is drawn, from the same numbers.
class Vibration {
 public:
  /// The filters of both triads, all off at first, and how late each is: its sinusoids come with that phase. Fades and
  /// random vibration, which has no phase, are not put off.
  struct Bandwidths {
    LowPasses gyro;
    LowPasses accel;
    std::int64_t gyro_delay_ns = 0;
    std::int64_t accel_delay_ns = 0;
    bool operator==(const Bandwidths& other) const {
      return gyro == other.gyro && accel == other.accel && gyro_delay_ns == other.gyro_delay_ns &&
             accel_delay_ns == other.accel_delay_ns;
    }
  };
  /// What the filters make of an interval's vibration, domain `sensor`.
  struct Passed {
    Unsteady gyro;  ///< of sinusoids, about the mean
    Unsteady accel;
    Increments random_felt;    ///< on filtered axes, as in increments()
    Increments random_passed;  ///< the same behind the filters
  };

  /// What random vibration is drawn for: the IMU's interval, the scenario's seed, and the sensor, such as "imu0".
  struct Setup {
    double dt_s;
    std::uint64_t seed;
    std::string sensor;
  };

  Vibration(const VibrationProfile& profile, Setup setup);

  /// From `time_ns` on the vibration is `profile`, after a fade of `fade_s` (0: at once). The weights of what is fading
  /// already go on. Times of calls must not go back. Returns whether the mount jumps: it moves, and does not fade.
  bool swap(const VibrationProfile& profile, std::int64_t time_ns, double fade_s);

  /// The integrals over (from_ns, to_ns], to_ns > from_ns; for random vibration they are one interval.
  Increments increments(std::int64_t from_ns, std::int64_t to_ns);

  /// To be called before increments() of the same interval.
  Passed passed(std::int64_t from_ns, std::int64_t to_ns);
  /// Within the same interval the mean of the vibration's specific force less its mean over the interval, squared, and
  /// of products of two axes, (m/s^2)^2: of sinusoids of the domain `sensor` in closed form, of random vibration what
  /// is expected. Fades as in the middle of the interval. A moving mount is part of the motion and not in it.
  Matrix3 moments(std::int64_t from_ns, std::int64_t to_ns);

  /// Takes other filters and delays between two intervals.
  void use(const Bandwidths& bandwidths);

  /// Whether the mount moves, and its highest frequency.
  bool mount_moves() const { return fastest_motion_hz_ > 0.0; }
  double fastest_motion_hz() const { return fastest_motion_hz_; }

  /// The mount at `time_ns` + `offset_s`.
  MountState mount(std::int64_t time_ns, double offset_s) const;

  /// What is in use and fading (data/state/state_stream.hpp).
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    std::vector<VibrationProfile> profiles;
    for (const Layer& layer : self.layers_) profiles.push_back(layer.profile);
    visit(profiles, self.fades_);
    if constexpr (!std::is_const_v<Self>) self.use(profiles);
  }

 private:
  struct Span {
    std::int64_t from_ns;
    std::int64_t to_ns;

    std::int64_t length_ns() const { return to_ns - from_ns; }
    std::int64_t twice_middle_ns() const { return from_ns + to_ns; }
  };
  /// One complex number an axis, as two vectors: std::complex looks for infinities in every product.
  struct Phasors {
    Vector3 real = Vector3::Zero();
    Vector3 imag = Vector3::Zero();

    Vector3 real_times(const std::complex<double>& z) const { return z.real() * real - z.imag() * imag; }
    Vector3 imag_times(const std::complex<double>& z) const { return z.imag() * real + z.real() * imag; }
  };
  struct Tone {
    /// What of an interval depends on its length alone, which seldom changes.
    struct Stretch {
      double gain_s = 0.0;        ///< dt sinc(pi f dt)
      std::complex<double> half;  ///< exp(pi i f dt)
    };
    const Stretch& over(const Span& span);
    /// exp(2 pi i f t) at a span's middle, which is asked for twice.
    const std::complex<double>& middle(const Span& span);

    double frequency_hz = 0.0;
    Phasors undelayed;  ///< amplitude times exp(i phase), SI
    Phasors amplitude;  ///< the same as late as the triad
    Phasors passed;     ///< the same times H(f)
    std::int64_t cached_length_ns = 0;
    Stretch cached;
    std::int64_t cached_twice_middle_ns = std::numeric_limits<std::int64_t>::min();
    std::complex<double> cached_middle;
  };
  struct Layer {
    VibrationProfile profile;
    std::vector<Tone> linear;
    std::vector<Tone> angular;
    std::vector<Tone> mount_linear;
    std::vector<Tone> mount_angular;
    std::optional<RandomVibration> linear_random;
    std::optional<RandomVibration> angular_random;
    Vector3 random_within = Vector3::Zero();              ///< (m/s^2)^2, variance_within() of the linear one
    std::optional<RandomVibration> linear_random_passed;  ///< where the triad has a filter
    std::optional<RandomVibration> angular_random_passed;

    bool is_still() const;
    bool mount_moves() const { return !mount_linear.empty() || !mount_angular.empty(); }
    MountState mount(std::int64_t time_ns, double offset_s) const;
  };
  /// Layer i + 1 rises and all layers before it fall with fade i.
  struct Fade {
    std::int64_t start_ns = 0;
    std::int64_t length_ns = 0;

    template <class Self, class Visitor>
    static void state(Self& self, Visitor& visit) {
      visit(self.start_ns, self.length_ns);
    }
  };
  struct Gate {
    Fade fade;
    bool rising;
  };
  /// A tone of amplitude 1 at a span's start and end, and its integral over it.
  struct Passage {
    double omega_rad_per_s;
    std::complex<double> from, to, whole_s;
  };
  /// One line of a faded tone: factor * exp(2 pi i (from_turns + f (t - from))).
  struct Line {
    double frequency_hz = 0.0;
    double from_turns;
    std::complex<double> factor;
  };
  /// Product of a layer's gates at an instant, and its derivative, 1/s.
  struct Weight {
    double value;
    double slope;
  };

  Layer layer_of(const VibrationProfile& profile) const;
  static std::complex<double> gated_integral(double frequency_hz, double middle_turns, const Span& span,
                                             const Gate* gate, const Gate* end);
  static Vector3 integral(std::vector<Tone>& tones, const Span& span, const std::vector<Gate>& gates);
  static void expand(double frequency_hz, double from_turns, std::complex<double> factor, std::int64_t from_ns,
                     const Gate* gate, const Gate* end, std::vector<Line>& lines);
  /// The filters' steps over spans without an end of a fade, and over an interval of mean length.
  struct Steps {
    TriadLowPassSteps spans, intervals;
  };
  /// Sums over the tones of a triad: what it feels of a span, and what the filters' answers are at its ends and in
  /// between, but for what decays. Axes without a filter mean nothing.
  struct Answers {
    Vector3 felt = Vector3::Zero();
    Vector3 y_from = Vector3::Zero(), slope_from = Vector3::Zero();
    Vector3 y_to = Vector3::Zero(), slope_to = Vector3::Zero();
    Vector3 integral = Vector3::Zero();

    void add(const Phasors& amplitude, const Phasors& out, const Passage& passage);
  };
  static Phasors responded(const Phasors& amplitude, const LowPasses& filters, double frequency_hz);
  Unsteady passed(const LowPasses& filters, Steps& steps, std::vector<Tone> Layer::*tones, std::int64_t from_ns,
                  std::int64_t to_ns);
  Answers answers(const LowPasses& filters, std::vector<Tone> Layer::*tones, const Span& span);
  std::vector<Gate> gates_of(std::size_t layer) const;
  void pass(Layer& layer) const;
  Vector3 variance_within(const Spectrum& spectrum) const;
  Increments random_increments(std::int64_t from_ns, std::int64_t to_ns);
  Weight weight(std::size_t layer, std::int64_t time_ns, double offset_s) const;
  void use(const std::vector<VibrationProfile>& profiles);
  void drop_layers_until(std::size_t count);
  void note_motion();

  Setup setup_;
  Bandwidths bandwidths_;
  Steps gyro_steps_, accel_steps_;
  std::vector<Layer> layers_;
  std::vector<Fade> fades_;
  double fastest_motion_hz_ = 0.0;  ///< 0: no mount moves
  bool has_random_ = false;
};

}  // namespace inslab::imu
