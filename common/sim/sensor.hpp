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
///
/// and, of a kind that has samples at times of their own, as a receiver has pulses:
///
///   using Beside                                         one of them, with the samples of its streams
///   static std::optional<Beside> beside(model, truth)    asked for before process()
///   samples(beside), hand(sink, index, beside)           as of an output
template <class Kind>
struct SensorModel;

namespace detail {
struct NothingBeside {};
template <class Wiring, class = void>
struct BesideOf {
  using type = NothingBeside;
};
template <class Wiring>
struct BesideOf<Wiring, std::void_t<typename Wiring::Beside>> {
  using type = typename Wiring::Beside;
};
}  // namespace detail

/// What a kind of sensor has at times of its own, and whether it has such.
template <class Kind>
using Beside = typename detail::BesideOf<SensorModel<Kind>>::type;
template <class Kind>
inline constexpr bool has_beside = !std::is_same_v<Beside<Kind>, detail::NothingBeside>;

/// One sensor that obeys the journal: truth and journal entries in, samples and acknowledgements out. Knows no bus and
/// no clock; the live service and the one-process runner drive the same class.
template <class Kind>
class Sensor {
 public:
  using Wiring = SensorModel<Kind>;
  using Output = typename Wiring::Output;
  struct Result {
    std::vector<Output> late;  ///< of samples before this one, that were held back and come now: before `output`
    std::optional<sim::Beside<Kind>> beside;  ///< before `output`
    std::optional<Output> output;
    std::vector<ProfileAck> acks;  ///< an outage keeps them back until the first sample after it

    /// Calls `use` with everything that comes out, in its order.
    template <class Use>
    void put_out(const Use& use) {
      for (Output& each : late) use(each);
      if constexpr (has_beside<Kind>) {
        if (beside) use(*beside);
      }
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
    if constexpr (has_beside<Kind>) result.beside = beside(truth);
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
    visit(self.model_, self.faults_, self.held_back_, self.desk_, self.put_out_beside_);
  }

 private:
  static std::vector<catalog::AnyProfile> begins_with(const scenario::Loaded<Kind>& sensor) {
    std::vector<catalog::AnyProfile> profiles;
    for_each_profile(Tag<Kind>{}, sensor, [&profiles](const auto& profile) { profiles.emplace_back(profile); });
    return profiles;
  }
  /// Numbered from 0 without gaps; none while a fault silences the sensor.
  std::optional<sim::Beside<Kind>> beside(const TruthState& truth) {
    std::optional<sim::Beside<Kind>> beside = Wiring::beside(model_, truth);
    if (!beside || faults_.silence(truth.header.sim_time_ns)) return std::nullopt;
    for_each_of(Wiring::samples(*beside), [&](auto& sample) {
      sample.header.run_id = truth.header.run_id;
      sample.header.sequence_number = put_out_beside_;
      sample.header.publish_realtime_ns = sample.header.publish_monotonic_ns = 0;
    });
    ++put_out_beside_;
    return beside;
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
  std::uint64_t put_out_beside_ = 0;
};

}  // namespace inslab::sim
