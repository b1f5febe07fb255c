#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "inslab/bus/service/service.hpp"
#include "inslab/bus/service/stream_input.hpp"
#include "inslab/data/catalog/sensor_kinds.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::reference_nav {

/// The streams of the sensors of a kind that the app takes besides an IMU and a receiver, as its scenario says; without
/// any nothing is missing and nothing comes.
template <class Kind>
class AidInput {
 public:
  using Sample = catalog::FirstSampleOf<Kind>;
  /// What has come, and of which sensor.
  struct Arrived {
    using Source = Kind;
    std::uint32_t number = 0;
    streams::Arrived<Sample> what;
  };

  AidInput(service::Context& context, const scenario::ReferenceNav& app, const std::function<void(Arrived)>& enqueue) {
    scenario::for_each_of_the_app<Kind>(app, [&](std::string_view, std::uint32_t number) {
      const time::Rate rate = context.scenario().sensor<Kind>(number).rate;
      streams_[number].input = std::make_unique<service::StreamInput<Sample>>(
          context, dds::topics::stream<Sample>(number, rate.hz()), [enqueue, number](streams::Arrived<Sample> arrived) {
            enqueue({number, std::move(arrived)});
          });
    });
  }

  void begin_run(const RunId& run, ClockMode clock) {
    for (auto& [number, stream] : streams_) stream.input->begin_run(run, clock);
  }

  /// Calls `use` with each sample whose turn has come.
  template <class Use>
  void add(const Arrived& arrived, const Use& use) {
    Stream& stream = streams_.at(arrived.number);
    stream.input->add(arrived.what);
    while (const auto sample = stream.input->take()) {
      use(*sample);
      stream.next = sample->header.sequence_number + 1;
    }
  }

  void tick() {
    for (auto& [number, stream] : streams_) stream.input->tick(stream.next);
  }

  /// What is waited for; empty when nothing.
  std::string missing() const {
    for (const auto& [number, stream] : streams_) {
      if (!stream.input->matched()) return "waits for a writer of " + stream.input->topic();
    }
    return "";
  }

  void report(ServiceStatus& status) const {
    for (const auto& [number, stream] : streams_) status.streams.push_back(stream.input->status());
  }

 private:
  struct Stream {
    std::unique_ptr<service::StreamInput<Sample>> input;
    std::uint64_t next = 0;  ///< samples before this one have come
  };

  std::map<std::uint32_t, Stream> streams_;  ///< by the sensors' numbers
};

}  // namespace inslab::reference_nav
