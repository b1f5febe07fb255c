#pragma once

#include <optional>
#include <string>
#include <vector>

#include "inslab/models/faults/sample_faults.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/sim/held_back.hpp"
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
  using Output = typename Wiring::Output;
  struct Result {
    std::vector<Output> late;  ///< of samples before this one, that were held back and come now: before `output`
    std::optional<Output> output;
    std::vector<ProfileAck> acks;  ///< an outage keeps them back until the first sample after it

    /// Calls `use` with everything that comes out, in its order.
    template <class Use>
    void put_out(const Use& use) {
      for (Output& each : late) use(each);
      if (output) use(*output);
    }
  };

  Sensor(const scenario::LoadedScenario& scenario, const scenario::Loaded<Kind>& sensor)
      : rate_(sensor.rate),
        model_(Wiring::setup(scenario, sensor)),
        faults_(scenario.stream_seed(), std::string(Kind::name) + std::to_string(sensor.number), sensor.rate),
        desk_({Kind::kind, sensor.number}, Kind::service, begins_with(sensor)) {}

  void add(const catalog::AnyProfile& entry) { desk_.add(entry); }
  bool ready_for(const TruthState& truth) const { return desk_.complete_for(truth); }

  /// Truth samples come in order, each once, when ready_for() says so.
  Result process(const TruthState& truth) {
    Result result;
    if (Wiring::takes_profiles_at(rate_, truth)) apply(desk_.take_due(truth.header.sim_time_ns));
    result.output = Wiring::process(model_, truth);
    if (result.output && !passes_faults(*result.output, truth.header.run_id)) result.output.reset();
    if (result.output) result.acks = desk_.acknowledge(std::get<0>(Wiring::samples(*result.output)).header);
    const std::int64_t now_ns = truth.header.sim_time_ns;
    held_back_.pass(now_ns, time::from_seconds(faults_.delay_s(now_ns)).count(), result.late, result.output);
    return result;
  }

  /// The run is over: what becomes of swaps under which no sample came out.
  std::vector<ProfileAck> close(const RunId& run) { return desk_.close(run); }

  /// What it needs to go on from here (data/state/state_stream.hpp).
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.model_, self.faults_, self.held_back_, self.desk_);
  }

 private:
  static std::vector<catalog::AnyProfile> begins_with(const scenario::Loaded<Kind>& sensor) {
    std::vector<catalog::AnyProfile> profiles;
    for_each_profile(Tag<Kind>{}, sensor, [&profiles](const auto& profile) { profiles.emplace_back(profile); });
    return profiles;
  }
  /// False when it is left out.
  bool passes_faults(Output& output, const RunId& run) {
    const auto samples = Wiring::samples(output);
    for_each_of(samples, [&run](auto& sample) { sample.header.run_id = run; });
    auto& first = std::get<0>(samples);
    make_available_at(first, available_at_ns(first));
    return std::apply([this](auto&... sample) { return faults_.pass(sample...); }, samples);
  }
  /// The journal lets pass only what sensors of this kind take.
  void apply(const std::vector<catalog::AnyProfile>& entries) {
    for (const catalog::AnyProfile& entry : entries) {
      std::visit(
          [this](const auto& profile) {
            using Profile = std::decay_t<decltype(profile)>;
            if constexpr (catalog::takes<Kind, Profile>) model_.apply(profile);
            if constexpr (std::is_same_v<Profile, FaultProfile>) faults_.use(profile);
          },
          entry);
    }
  }

  time::Rate rate_;
  typename Wiring::Model model_;
  faults::SampleFaults<catalog::FirstSampleOf<Kind>> faults_;
  HeldBack<Wiring> held_back_;
  ProfileDesk desk_;
};

}  // namespace inslab::sim
