#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <tuple>

#include "inslab/data/profiles/fault_profile.hpp"
#include "inslab/data/samples/measured.hpp"
#include "inslab/foundation/time/rate.hpp"
#include "inslab/models/faults/fault_account.hpp"
#include "inslab/noise/random/stream.hpp"

namespace inslab::faults {

/// The faults that a sensor of any kind may have (CommonFaults), behind its model: they act on finished samples of the
/// sensor's first stream, by the fields that are declared as measured. In this order:
///
///   channels          sign, then jump + ramp (t - t0) + white noise; t0 is when the fault comes on
///   out of range      most + (most - least), what such a sensor can show being least to most
///   garbage           uniform over least to most
///   not a number      NaN
///   stuck             the values of the last sample put out before
///   frozen time tag   its GPS week and time of week
///   off, rate         nothing comes out; of a sensor whose samples say whether they are valid, samples that are not
///
/// then what follows from the measured fields. Delay comes after them, in sim::Sensor. Draws depend on (seed, sensor,
/// channel, k) alone, k being the instant of the sensor's rate: no other noise is disturbed, and an end of the faults
/// leaves no trace but in the numbers of samples behind those left out.
template <class Sample>
class SampleFaults {
 public:
  /// `sensor` is the root of the stream names, such as "gnss0".
  SampleFaults(std::uint64_t seed, std::string sensor, const time::Rate& rate)
      : seed_(seed), sensor_(std::move(sensor)), rate_(rate) {}

  /// Takes other faults from the next sample on.
  void use(const FaultProfile& profile) {
    faults_ = profile.common;
    begun_ns_ = std::max<std::int64_t>(0, profile.request.apply_at_ns);
  }

  /// How much later than now samples come out at `sim_time_ns`.
  double delay_s(std::int64_t sim_time_ns) const { return are_on(sim_time_ns) ? faults_.delay_s : 0.0; }

  /// Whether they let nothing out at `sim_time_ns`.
  bool silence(std::int64_t sim_time_ns) const { return faults_.off && are_on(sim_time_ns); }

  /// What becomes of a sample, and beside it of the other streams of its sensor; false: it is left out.
  template <class... Beside>
  bool pass(Sample& sample, Beside&... beside) {
    sample.header.sequence_number -= left_out_;
    ((beside.header.sequence_number -= left_out_), ...);
    const Fate fate = are_on(sample.header.sim_time_ns) ? faulty(sample, beside...) : Fate::Shown;
    if (fate == Fate::Shown) last_ = sample;
    if (fate == Fate::LeftOut) ++left_out_;
    return fate != Fate::LeftOut;
  }

  /// What goes on from sample to sample (data/state/state_stream.hpp), and the faults in use.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.faults_, self.begun_ns_, self.left_out_, self.last_);
  }

 private:
  enum class Fate { Shown, NotValid, LeftOut };

  bool are_on(std::int64_t sim_time_ns) const {
    if (faults_.are_none()) return false;
    if (faults_.intermittent_period_s == 0.0) return true;
    const std::int64_t period_ns = time::from_seconds(faults_.intermittent_period_s).count();
    const std::int64_t on_ns = time::from_seconds(faults_.intermittent_period_s * faults_.intermittent_duty).count();
    return (sim_time_ns - begun_ns_) % period_ns < on_ns;
  }

  template <class... Beside>
  Fate faulty(Sample& sample, Beside&... beside) {
    const Sample before = sample;
    active_ = 0;
    k_ = rate_.index(time::Nanoseconds(sample.header.sim_time_ns));
    for (const ChannelFault& channel : faults_.channels) act(channel, sample);
    if (faults_.out_of_range) act(ActiveFault::OutOfRange, sample);
    if (faults_.garbage) act(ActiveFault::Garbage, sample);
    if (faults_.not_a_number) act(ActiveFault::NotANumber, sample);
    if (faults_.stuck && last_) stick(sample);
    samples::settle(sample, before);
    keep_not_valid(sample, before);
    if (faults_.frozen_time_tag && last_) {
      note(ActiveFault::FrozenTimeTag);
      sample.header.gps_week = last_->header.gps_week;
      sample.header.gps_time_of_week_ns = last_->header.gps_time_of_week_ns;
    }
    if (faults_.delay_s > 0.0) note(ActiveFault::Delay);
    Fate fate = Fate::Shown;
    if (faults_.off || k_ % faults_.rate_divisor != 0) {
      note(faults_.off ? ActiveFault::Off : ActiveFault::Rate);
      fate = made_not_valid(sample) ? Fate::NotValid : Fate::LeftOut;
    }
    (enter(beside, before, sample, active_), ...);
    return fate;
  }

  void note(ActiveFault fault) { active_ |= bit_of(fault); }

  random::Stream stream(std::string_view what, const Field& field) const {
    return {seed_, sensor_ + "/fault/" + std::string(what) + "/" + std::string(field.name)};
  }

  /// Calls `use(number, axis)` with each number of a measured field.
  template <class Use>
  static void for_each_number(double& value, const Use& use) {
    use(value, 0);
  }
  template <class Use>
  static void for_each_number(Vector3& value, const Use& use) {
    for (int axis = 0; axis < 3; ++axis) use(value[axis], axis);
  }

  void act(const ChannelFault& fault, Sample& sample) {
    note(ActiveFault::Channel);
    const double elapsed_s = time::to_seconds(sample.header.sim_time_ns - begun_ns_);
    samples::for_each_measured(sample, [&](const Field& field, auto& value) {
      if (field.name != fault.channel) return;
      const random::Stream noise = stream("noise", field);
      for_each_number(value, [&](double& number, int axis) {
        if (fault.sign_flip) number = -number;
        number += fault.jump[axis] + fault.ramp_per_s[axis] * elapsed_s;
        if (fault.noise_sigma[axis] > 0.0) number += fault.noise_sigma[axis] * noise.normal(3 * k_ + axis);
      });
    });
  }

  void act(ActiveFault fault, Sample& sample) {
    note(fault);
    samples::for_each_measured(sample, [&](const Field& field, auto& value) {
      const double range = field.most_shown - field.least_shown;
      const random::Stream draws = stream("garbage", field);
      for_each_number(value, [&](double& number, int axis) {
        if (fault == ActiveFault::OutOfRange) number = field.most_shown + range;
        if (fault == ActiveFault::Garbage) number = field.least_shown + range * draws.uniform(3 * k_ + axis);
        if (fault == ActiveFault::NotANumber) number = std::numeric_limits<double>::quiet_NaN();
      });
    });
  }

  void stick(Sample& sample) {
    note(ActiveFault::Stuck);
    std::vector<double> held;
    samples::for_each_measured(*last_, [&held](const Field&, auto& value) {
      for_each_number(value, [&held](double& number, int) { held.push_back(number); });
    });
    auto next = held.begin();
    samples::for_each_measured(sample, [&next](const Field&, auto& value) {
      for_each_number(value, [&next](double& number, int) { number = *next++; });
    });
  }

  std::uint64_t seed_;
  std::string sensor_;
  time::Rate rate_;
  CommonFaults faults_;
  std::int64_t begun_ns_ = 0;
  std::uint64_t left_out_ = 0;  ///< samples so far
  std::optional<Sample> last_;  ///< put out
  std::uint64_t k_ = 0;         ///< of the sample at hand
  std::uint32_t active_ = 0;    ///< on it
};

}  // namespace inslab::faults
