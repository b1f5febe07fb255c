#pragma once

#include <string>
#include <vector>

#include "inslab/data/requests/run_control.hpp"
#include "inslab/data/samples/service_status.hpp"
#include "inslab/data/samples/stream_header.hpp"

namespace inslab::sim {

/// What a service said last of itself.
struct LoggedService {
  std::string service;
  std::uint32_t number = 0;
  ServiceState state = ServiceState::Starting;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("service"), self.service);
    visit(Field("number"), self.number);
    visit(Field("state"), self.state);
  }
};

/// How far one stream is in the log.
struct LoggedStream {
  std::string topic;
  std::uint64_t samples = 0;
  std::uint64_t next_sequence = 0;  ///< the least that is not there

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("topic"), self.topic);
    visit(Field("samples"), self.samples);
    visit(Field("next_sequence"), self.next_sequence);
  }
};

/// Numbers without a gap.
struct NumberRange {
  std::uint64_t first = 0;
  std::uint64_t last = 0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("first"), self.first);
    visit(Field("last"), self.last);
  }
};

/// Which messages of one of an app's writers are in the log, by that writer's own count.
struct LoggedWriter {
  std::string topic;
  RunId writer;  ///< its GUID, which has as many bytes
  std::vector<NumberRange> numbers;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("topic"), self.topic);
    visit(Field("writer"), self.writer);
    visit(Field("numbers").at_most(512), self.numbers);
  }
};

/// What a logger needs to go on with the log of a run after it was killed: written with every flush of the log, which
/// the LogTail of the same generation completes.
struct LoggerState {
  RunId run_id;  ///< stands in the checkpoint's head
  std::string path;
  std::uint64_t generation = 0;
  std::vector<LoggedStream> streams;
  std::vector<std::uint32_t> channel_counts;  ///< messages of each channel, in the order of the channels
  std::vector<std::uint64_t> once;            ///< hashes of the messages that late joiners get again
  bool run_began = false;
  bool run_ended = false;
  ClockMode clock = ClockMode::RealTime;
  std::vector<LoggedService> services;
  std::vector<LoggedWriter> app_writers;
  std::vector<LoggedStream> sent;  ///< how many samples of each stream its service says it has sent; no next_sequence

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("path").at_most(4096), self.path);
    visit(Field("generation"), self.generation);
    visit(Field("streams").at_most(64), self.streams);
    visit(Field("channel_counts").at_most(256), self.channel_counts);
    visit(Field("once").at_most(1'000'000), self.once);
    visit(Field("run_began"), self.run_began);
    visit(Field("run_ended"), self.run_ended);
    visit(Field("clock"), self.clock);
    visit(Field("services").at_most(64), self.services);
    visit(Field("app_writers").at_most(1024), self.app_writers);
    visit(Field("sent").at_most(64), self.sent);
  }
};

}  // namespace inslab::sim
