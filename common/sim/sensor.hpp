#pragma once

#include <optional>
#include <vector>

#include "inslab/scenario/load.hpp"
#include "inslab/sim/profile_desk.hpp"

namespace inslab::sim {

/// What makes the samples of a kind of sensor, and how it is tied to a run; each kind has a header of its own,
/// imu_sensor.hpp and so on:
///
///   using Model                                          a value: profiles are applied to it, truth goes in
///   using Output                                         what the model makes of one truth sample
///   static Model::Setup setup(scenario, sensor)          of the scenario, for its sensor
///   static bool takes_profiles_at(rate, truth)           whether profiles may change before this truth sample
///   static std::optional<Output> process(model, truth)
///   static auto samples(output)                          references to the samples, in the order of the kind's streams
///   static void hand(sink, index, output)                to who takes what an offline run puts out
template <class Kind>
struct SensorModel;

/// One sensor that obeys the journal: truth and journal entries in, samples and acknowledgements out. Knows no bus and
/// no clock; the live service and the one-process runner drive the same class.
template <class Kind>
class Sensor {
 public:
  using Wiring = SensorModel<Kind>;
  struct Result {
    std::optional<typename Wiring::Output> output;
    std::vector<ProfileAck> acks;  ///< an outage keeps them back until the first sample after it
  };

  Sensor(const scenario::LoadedScenario& scenario, const scenario::Loaded<Kind>& sensor)
      : rate_(sensor.rate),
        model_(Wiring::setup(scenario, sensor)),
        desk_({Kind::kind, sensor.number}, Kind::service, begins_with(sensor)) {}

  void add(const catalog::AnyProfile& entry) { desk_.add(entry); }
  bool ready_for(const TruthState& truth) const { return desk_.complete_for(truth); }

  /// Truth samples come in order, each once, when ready_for() says so.
  Result process(const TruthState& truth) {
    Result result;
    if (Wiring::takes_profiles_at(rate_, truth)) apply(desk_.take_due(truth.header.sim_time_ns));
    result.output = Wiring::process(model_, truth);
    if (!result.output) return result;
    const auto samples = Wiring::samples(*result.output);
    for_each_of(samples, [&truth](auto& sample) { sample.header.run_id = truth.header.run_id; });
    result.acks = desk_.acknowledge(std::get<0>(samples).header);
    return result;
  }

  /// The run is over: what becomes of swaps under which no sample came out.
  std::vector<ProfileAck> close(const RunId& run) { return desk_.close(run); }

  /// What it needs to go on from here (data/state/state_stream.hpp).
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.model_, self.desk_);
  }

 private:
  static std::vector<catalog::AnyProfile> begins_with(const scenario::Loaded<Kind>& sensor) {
    std::vector<catalog::AnyProfile> profiles;
    for_each_profile(Tag<Kind>{}, sensor, [&profiles](const auto& profile) { profiles.emplace_back(profile); });
    return profiles;
  }
  /// The journal lets pass only what sensors of this kind take.
  void apply(const std::vector<catalog::AnyProfile>& entries) {
    for (const catalog::AnyProfile& entry : entries) {
      std::visit(
          [this](const auto& profile) {
            if constexpr (catalog::takes<Kind, std::decay_t<decltype(profile)>>) model_.apply(profile);
          },
          entry);
    }
  }

  time::Rate rate_;
  typename Wiring::Model model_;
  ProfileDesk desk_;
};

}  // namespace inslab::sim
