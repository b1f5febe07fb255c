#pragma once

#include <string>
#include <vector>

#include "samples/stream_header.hpp"

namespace inslab::logger {

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

/// What a logger needs to go on with the log of a run after it was killed: written with every flush of the log, which
/// the LogTail of the same generation completes.
struct LoggerState {
  RunId run_id;  ///< stands in the checkpoint's head
  std::string path;
  std::uint64_t generation = 0;
  std::vector<LoggedStream> streams;
  std::vector<std::uint32_t> channel_counts;  ///< messages of each channel, in the order of the channels
  std::vector<std::uint64_t> once;            ///< hashes of the messages that late joiners get again

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("path").at_most(4096), self.path);
    visit(Field("generation"), self.generation);
    visit(Field("streams").at_most(64), self.streams);
    visit(Field("channel_counts").at_most(256), self.channel_counts);
    visit(Field("once").at_most(1'000'000), self.once);
  }
};

}  // namespace inslab::logger
