#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "inslab/foundation/fields/field.hpp"

namespace inslab {
inline namespace samples {

/// What is wrong with one measured value of a sensor: a field of its sample, by the name that it has there.
struct ChannelFault {
  std::string channel;
  bool sign_flip = false;
  Vector3 jump = Vector3::Zero();
  Vector3 ramp_per_s = Vector3::Zero();
  Vector3 noise_sigma = Vector3::Zero();

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("channel",
                "a measured field of the sensor's sample, such as pressure_pa; its unit is that of what follows")
              .required(),
          self.channel);
    visit(Field("sign_flip", "the value has the wrong sign, before the others are added"), self.sign_flip);
    visit(Field("jump", "added while the fault is on").in(-1e9, 1e9), self.jump);
    visit(Field("ramp_per_s", "speed of what is added, from 0 when the fault comes on").in(-1e9, 1e9), self.ramp_per_s);
    visit(Field("noise_sigma", "white noise added while the fault is on, of one sample").in(0.0, 1e9),
          self.noise_sigma);
  }
};

/// Faults that a sensor of any kind may have, a part of FaultProfile; what they do to a sample stands in
/// models/faults/sample_faults.hpp.
struct CommonFaults {
  bool off = false;
  bool stuck = false;
  bool frozen_time_tag = false;
  bool not_a_number = false;
  bool out_of_range = false;
  bool garbage = false;
  double delay_s = 0.0;
  std::uint32_t rate_divisor = 1;
  double intermittent_period_s = 0.0;
  double intermittent_duty = 0.5;
  std::vector<ChannelFault> channels;

  /// Whether any of them is on; what comes and goes is on, too.
  bool are_none() const {
    return !off && !stuck && !frozen_time_tag && !not_a_number && !out_of_range && !garbage && delay_s == 0.0 &&
           rate_divisor == 1 && channels.empty();
  }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("off", "no sample while on; an IMU's come and are not valid").appended(), self.off);
    visit(Field("stuck", "measured values repeat those of the last sample before").appended(), self.stuck);
    visit(Field("frozen_time_tag", "GPS week and time of week repeat those of the last sample before").appended(),
          self.frozen_time_tag);
    visit(Field("not_a_number", "measured values are not numbers").appended(), self.not_a_number);
    visit(Field("out_of_range", "measured values lie beyond what such a sensor can show, by as much as it can show")
              .appended(),
          self.out_of_range);
    visit(Field("garbage", "measured values are random, uniform over what such a sensor can show").appended(),
          self.garbage);
    visit(
        Field("delay_s", "samples are put out so much later, with the tags of their own time").appended().in(0.0, 5.0),
        self.delay_s);
    visit(Field("rate_divisor", "one sample in so many is put out; of an IMU's the others are not valid")
              .appended()
              .in(1.0, 1e6),
          self.rate_divisor);
    visit(Field("intermittent_period_s",
                "off, rate_divisor, channels and all between them come and go with it; 0: they stay")
              .appended()
              .in(0.0, 1e6),
          self.intermittent_period_s);
    visit(Field("intermittent_duty", "share of each period, from its beginning, in which they are on")
              .appended()
              .in(0.0, 1.0),
          self.intermittent_duty);
    visit(Field("channels", "faults of single measured values").appended().at_most(16), self.channels);
  }
};

/// Places of the faults that acted on a sample in the bits of `active_faults` of the truth.
enum class ActiveFault : std::uint32_t {
  Off,
  Stuck,
  FrozenTimeTag,
  NotANumber,
  OutOfRange,
  Garbage,
  Delay,
  Rate,
  Channel
};
constexpr std::uint32_t bit_of(ActiveFault fault) { return 1u << static_cast<std::uint32_t>(fault); }

}  // namespace samples
}  // namespace inslab
