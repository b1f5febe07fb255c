#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "inslab/formats/mcap/mcap_format.hpp"

namespace inslab::mcap {

/// What a killed writer left of a log, as far as it is whole: enough to go on writing it.
struct UnfinishedLog {
  std::vector<Schema> schemas;
  std::vector<Channel> channels;
  std::vector<ChunkIndex> chunks;
  std::vector<MetadataIndex> metadata;
  Statistics statistics;
  std::uint64_t end = 0;  ///< of what is whole; what follows is to be cut off
};

/// Reads the records' heads and the message indexes of a log without a footer; the messages of the last chunk alone are
/// looked at, so a long log takes no longer than its number of chunks. A chunk whose indexes are not whole does not
/// count. Of what a writer appended beyond `known_size`, where it noted how long the file was, nothing counts. Throws
/// ReadError when the file is no MCAP log of ours or, up to there, has been closed properly.
UnfinishedLog read_unfinished(const std::string& path,
                              std::uint64_t known_size = std::numeric_limits<std::uint64_t>::max());

}  // namespace inslab::mcap
