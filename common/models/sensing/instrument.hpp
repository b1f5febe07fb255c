#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>

#include "inslab/data/catalog/checked_profile.hpp"
#include "inslab/data/samples/truth_state.hpp"
#include "inslab/foundation/time/rate.hpp"
#include "inslab/models/timing/sensor_clock.hpp"

/// What sensors that show one quantity at the instants of a rate have in common beside their physics.
namespace inslab::sensing {

/// How such a sensor errs: the first of its kind's profiles.
template <class Kind>
using ErrorsOf = std::tuple_element_t<0, Applied<std::tuple, typename Kind::Profiles>>;

/// What the model of one is made of.
template <class Kind>
struct Setup {
  std::uint64_t seed = 0;
  std::uint32_t sensor_number = 0;
  time::Rate rate;
  ErrorsOf<Kind> errors;
  InstallationProfile installation;
};

/// One sensor as an instrument: the profiles in force, the clock that tags its samples, their numbers, the names of its
/// random streams. A model has one of it and is left with the physics.
template <class Kind>
class Instrument {
 public:
  /// Throws std::invalid_argument when a profile breaks a rule of data/catalog/profile_rules.hpp.
  explicit Instrument(const Setup<Kind>& setup)
      : seed_(setup.seed),
        number_(setup.sensor_number),
        rate_(setup.rate),
        errors_(catalog::checked_for<Kind>(setup.errors)),
        installation_(catalog::checked_for<Kind>(setup.installation)),
        clock_(setup.errors.time_tag, setup.rate.period_s(), setup.seed, name()) {}

  const ErrorsOf<Kind>& errors() const { return errors_; }
  const InstallationProfile& installation() const { return installation_; }
  const FaultProfile& fault() const { return fault_; }

  /// Its random numbers for `what`, "barometer0/<what>", and those that the whole scenario shares, by their own name.
  random::Stream stream(const std::string& what) const { return {seed_, name() + "/" + what}; }
  random::Stream shared_stream(const std::string& of_the_scenario) const { return {seed_, of_the_scenario}; }

  /// Puts a profile in force from the next sample on. Throws std::invalid_argument when it breaks a rule, and then
  /// changes nothing.
  void take(const ErrorsOf<Kind>& profile) {
    errors_ = catalog::checked_for<Kind>(profile);
    clock_.retune(profile.time_tag, profile.request.continuity, instant_, rate_.at(instant_).count());
  }
  void take(const InstallationProfile& profile) { installation_ = catalog::checked_for<Kind>(profile); }
  void take(const FaultProfile& profile) { fault_ = catalog::checked_for<Kind>(profile); }

  /// The header as the sensor tags it, when `truth` is at one of its instants, k >= 1, whose number instant() then is;
  /// nothing between them and at t = 0. Instants come in order, each once, those too that show no sample.
  std::optional<StreamHeader> reach(const TruthState& truth) {
    const std::int64_t time_ns = truth.header.sim_time_ns;
    if (time_ns <= 0 || !rate_.contains(time::Nanoseconds(time_ns))) return std::nullopt;
    instant_ = rate_.index(time::Nanoseconds(time_ns));
    return clock_.tagged(truth.header, instant_);
  }
  std::uint64_t instant() const { return instant_; }
  const time::Rate& rate() const { return rate_; }

  /// A sample of that tag with all but what it shows: the next number, and the profiles that it is made under.
  template <class Sample>
  Sample labelled(const StreamHeader& tagged) {
    Sample sample;
    sample.header = tagged;
    sample.header.sequence_number = samples_++;
    sample.header.publish_realtime_ns = 0;
    sample.header.publish_monotonic_ns = 0;
    sample.sensor_number = number_;
    sample.revisions = {errors_.request.journal_number, installation_.request.journal_number,
                        fault_.request.journal_number};
    return sample;
  }

  /// What one of the same setup needs to go on from here (data/state/state_stream.hpp).
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.errors_, self.installation_, self.fault_);
    if constexpr (!std::is_const_v<Self>) self.clock_.use(self.errors_.time_tag);
    visit(self.clock_, self.instant_, self.samples_);
  }

 private:
  std::string name() const { return std::string(Kind::name) + std::to_string(number_); }

  std::uint64_t seed_;
  std::uint32_t number_;
  time::Rate rate_;
  ErrorsOf<Kind> errors_;
  InstallationProfile installation_;
  FaultProfile fault_;
  timing::SensorClock clock_;
  std::uint64_t instant_ = 0;  ///< the last one
  std::uint64_t samples_ = 0;
};

/// What a swap asks of random processes after instant `k`.
template <class... Process>
void go_on(Continuity continuity, std::uint64_t k, Process&... processes) {
  if (continuity == Continuity::Reset) (processes.reset(), ...);
  if (continuity == Continuity::Redraw) (processes.redraw(k), ...);
}

}  // namespace inslab::sensing
