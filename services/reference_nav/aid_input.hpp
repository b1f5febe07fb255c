#pragma once

#include <functional>
#include <memory>
#include <string>

#include "inslab/bus/service/service.hpp"
#include "inslab/bus/service/stream_input.hpp"
#include "inslab/data/catalog/sensor_kinds.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::reference_nav {

/// The stream of a sensor that the app takes besides an IMU and a receiver, if its scenario says so; without one
/// nothing is missing and nothing comes.
template <class Kind>
class AidInput {
 public:
  using Sample = catalog::FirstSampleOf<Kind>;
  using Arrived = streams::Arrived<Sample>;

  AidInput(service::Context& context, const scenario::ReferenceNav& app, std::function<void(Arrived)> enqueue) {
    const auto number = scenario::sensor_of_the_app<Kind>(app);
    if (!number) return;
    const time::Rate rate = context.scenario().sensor<Kind>(*number).rate;
    input_ = std::make_unique<service::StreamInput<Sample>>(context, dds::topics::stream<Sample>(*number, rate.hz()),
                                                            std::move(enqueue));
  }

  void begin_run(const RunId& run, ClockMode clock) {
    if (input_) input_->begin_run(run, clock);
  }

  /// Calls `use` with each sample whose turn has come.
  template <class Use>
  void add(const Arrived& arrived, const Use& use) {
    if (!input_) return;
    input_->add(arrived);
    while (const auto sample = input_->take()) {
      use(*sample);
      next_ = sample->header.sequence_number + 1;
    }
  }

  void tick() {
    if (input_) input_->tick(next_);
  }

  /// What is waited for; empty when nothing.
  std::string missing() const { return input_ && !input_->matched() ? "waits for a writer of " + input_->topic() : ""; }

  void report(ServiceStatus& status) const {
    if (input_) status.streams.push_back(input_->status());
  }

 private:
  std::unique_ptr<service::StreamInput<Sample>> input_;
  std::uint64_t next_ = 0;  ///< samples before this one have come
};

}  // namespace inslab::reference_nav
