#pragma once

#include <memory>
#include <tuple>

#include "inslab/bus/service/stream_output.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/scenario/service_names.hpp"

namespace inslab::sensor {

/// The streams of one sensor on the bus, such as inslab/imu/N and inslab/imu_truth/N, which go together.
template <class Kind>
class SensorOutputs {
 public:
  SensorOutputs(service::Context& context, const scenario::Loaded<Kind>& sensor, bool paced_by_nav_app)
      : outputs_(outputs(context, sensor, paced_by_nav_app, catalog::SamplesOf<Kind>{})) {}

  void begin_run(const RunId& run, ClockMode clock) {
    for_each_of(outputs_, [&](auto& output) { output->begin_run(run, clock); });
  }
  /// One sample of each stream, in their order.
  template <class... Sample>
  void put(Sample&... samples) {
    (std::get<Output<Sample>>(outputs_)->put(samples), ...);
  }
  void flush_blocks() {
    for_each_of(outputs_, [](auto& output) { output->flush_block(); });
  }
  void take(const Credit& credit) {
    for_each_of(outputs_, [&credit](auto& output) { output->take(credit); });
  }
  bool has_room() const {
    return std::apply([](const auto&... output) { return (output->has_room() && ...); }, outputs_);
  }
  /// Sequence numbers that follow the newest of each, and whether everybody has them up to there.
  std::vector<std::uint64_t> ends() const {
    return std::apply([](const auto&... output) { return std::vector<std::uint64_t>{output->next_sequence()...}; },
                      outputs_);
  }
  bool delivered(const std::vector<std::uint64_t>& ends) const {
    auto end = ends.begin();
    return std::apply([&end](const auto&... output) { return ((output->lowest_wanted() >= *end++) && ...); }, outputs_);
  }
  bool are_logged() const {
    return std::apply([](const auto&... output) { return (output->is_logged() && ...); }, outputs_);
  }
  /// Whose readers are missing; empty when none.
  std::string missing_readers() const {
    std::string missing;
    for_each_of(outputs_, [&missing](const auto& output) {
      if (missing.empty()) missing = output->missing_readers();
    });
    return missing;
  }
  void save(state::StateWriter& writer) const {
    for_each_of(outputs_, [&writer](const auto& output) { output->save(writer); });
  }
  void load(state::StateReader& reader) {
    for_each_of(outputs_, [&reader](auto& output) { output->load(reader); });
  }
  void report(ServiceStatus& status) const {
    for_each_of(outputs_, [&status](const auto& output) { status.streams.push_back(output->status()); });
  }
  void wait_for_acknowledgments(time::Nanoseconds deadline) {
    for_each_of(outputs_, [deadline](auto& output) { output->wait_for_acknowledgments(deadline); });
  }
  /// Of the first stream, which an app may set the pace of.
  const std::string& topic() const { return std::get<0>(outputs_)->topic(); }

 private:
  template <class Sample>
  using Output = std::unique_ptr<service::StreamOutput<Sample>>;
  using Outputs = Applied<std::tuple, Mapped<Output, catalog::SamplesOf<Kind>>>;

  template <class... Sample>
  static Outputs outputs(service::Context& context, const scenario::Loaded<Kind>& sensor, bool paced_by_nav_app,
                         Types<Sample...>) {
    return {output<Sample>(context, sensor, paced_by_nav_app)...};  // braces: in their order
  }
  template <class Sample>
  static Output<Sample> output(service::Context& context, const scenario::Loaded<Kind>& sensor, bool paced_by_nav_app) {
    using Stream = service::StreamOutput<Sample>;
    const catalog::Audience audience = catalog::kStream<Sample>.audience;
    const double rate_hz = sensor.rate.hz();
    return std::make_unique<Stream>(
        context, dds::topics::stream<Sample>(sensor.number, rate_hz),
        typename Stream::Settings{scenario::stream_consumers<Sample>(context.scenario().scenario, sensor.number),
                                  paced_by_nav_app && audience == catalog::Audience::App, Stream::kWindowSamples,
                                  Stream::half_a_minute(rate_hz)});
  }

  Outputs outputs_;
};

}  // namespace inslab::sensor
