#pragma once

#include "inslab/foundation/fields/field.hpp"

namespace inslab {
inline namespace samples {

enum class ServiceState : std::uint32_t { Starting, Ready, Running, Finished, Fault };
enum class StreamDirection : std::uint32_t { In, Out };

template <>
struct EnumNames<ServiceState> {
  static constexpr std::string_view type = "ServiceState";
  static constexpr std::string_view prefix = "SERVICE_";
  static constexpr std::array<std::string_view, 5> values{"starting", "ready", "running", "finished", "fault"};
};
template <>
struct EnumNames<StreamDirection> {
  static constexpr std::string_view type = "StreamDirection";
  static constexpr std::string_view prefix = "STREAM_";
  static constexpr std::array<std::string_view, 2> values{"in", "out"};
};

/// Counters of one stream at one service.
struct StreamStatus {
  std::string topic;
  StreamDirection direction = StreamDirection::In;
  std::uint64_t samples = 0;
  std::uint64_t lost = 0;
  std::uint64_t out_of_order = 0;
  std::uint64_t duplicates = 0;
  double latency_p50_s = -1.0;  ///< publish to receipt; negative: unknown
  double latency_p99_s = -1.0;
  double latency_max_s = -1.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("topic").at_most(64), self.topic);
    visit(Field("direction"), self.direction);
    visit(Field("samples"), self.samples);
    visit(Field("lost"), self.lost);
    visit(Field("out_of_order"), self.out_of_order);
    visit(Field("duplicates"), self.duplicates);
    visit(Field("latency_p50_s"), self.latency_p50_s);
    visit(Field("latency_p99_s"), self.latency_p99_s);
    visit(Field("latency_max_s"), self.latency_max_s);
  }
};

/// The heartbeat of a service, 1 Hz (idl/control.idl).
struct ServiceStatus {
  std::string service;
  std::uint32_t sensor_number = 0;
  std::string host;
  std::uint32_t pid = 0;
  RunId run_id;
  ServiceState state = ServiceState::Starting;
  std::int64_t sim_time_ns = 0;
  std::int64_t realtime_ns = 0;
  std::uint32_t overruns = 0;
  std::uint32_t refused_messages = 0;
  std::uint32_t queue_depth_max = 0;
  std::uint64_t rss_bytes = 0;
  std::vector<StreamStatus> streams;
  std::string message;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("service").at_most(32).key(), self.service);
    visit(Field("sensor_number").key(), self.sensor_number);
    visit(Field("host").at_most(64), self.host);
    visit(Field("pid"), self.pid);
    visit(Field("run_id"), self.run_id);
    visit(Field("state"), self.state);
    visit(Field("sim_time_ns"), self.sim_time_ns);
    visit(Field("realtime_ns"), self.realtime_ns);
    visit(Field("overruns"), self.overruns);
    visit(Field("refused_messages"), self.refused_messages);
    visit(Field("queue_depth_max"), self.queue_depth_max);
    visit(Field("rss_bytes"), self.rss_bytes);
    visit(Field("streams").at_most(32), self.streams);
    visit(Field("message").at_most(256), self.message);
  }
};

}  // namespace samples
}  // namespace inslab
