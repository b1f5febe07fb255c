#pragma once

#include <string>
#include <vector>

#include "inslab/data/requests/run_control.hpp"
#include "inslab/data/samples/service_status.hpp"
#include "inslab/data/samples/stream_header.hpp"
#include "inslab/data/streams/stream_monitor.hpp"

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

/// What of one stream is in the log.
struct LoggedStream {
  std::string topic;
  streams::StreamProgress progress;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("topic"), self.topic);
    visit(Field("progress"), self.progress);
  }
};

/// How many samples of one stream its service says it has sent.
struct SentStream {
  std::string topic;
  std::uint64_t samples = 0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("topic"), self.topic);
    visit(Field("samples"), self.samples);
  }
};

/// Whom a stream came from last.
struct LoggedSource {
  std::string topic;
  RunId participant;  ///< its GUID's twelve bytes, which name the participant
  std::int64_t received_realtime_ns = 0;
  std::uint64_t sequence_number = 0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("topic"), self.topic);
    visit(Field("participant"), self.participant);
    visit(Field("received_realtime_ns"), self.received_realtime_ns);
    visit(Field("sequence_number"), self.sequence_number);
  }
};

/// Which messages of one of an app's writers are in the log, by that writer's own count.
struct LoggedWriter {
  std::string topic;
  RunId writer;  ///< its GUID, which has as many bytes
  std::vector<streams::NumberRange> numbers;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("topic"), self.topic);
    visit(Field("writer"), self.writer);
    visit(Field("numbers").at_most(512), self.numbers);
  }
};

/// What a logger needs to go on with the log of a run after it was killed: written with every flush of the log, which
/// the LogTail of the same generation completes. A logger may be killed between the flush and this: what the file has
/// beyond `file_size` is in the tail too.
struct LoggerState {
  RunId run_id;  ///< stands in the checkpoint's head
  std::string path;
  std::uint64_t file_size = 0;
  std::uint64_t generation = 0;
  std::vector<LoggedStream> streams;
  std::vector<LoggedSource> sources;
  std::vector<std::uint32_t> channel_counts;  ///< messages of each channel, in the order of the channels
  std::vector<std::uint64_t> once;            ///< hashes of the messages that late joiners get again
  bool run_began = false;
  bool run_ended = false;
  ClockMode clock = ClockMode::RealTime;
  std::vector<LoggedService> services;
  std::vector<LoggedWriter> app_writers;
  std::vector<SentStream> sent;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("path").at_most(4096), self.path);
    visit(Field("file_size"), self.file_size);
    visit(Field("generation"), self.generation);
    visit(Field("streams").at_most(64), self.streams);
    visit(Field("sources").at_most(64), self.sources);
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
