#pragma once

#include <string>
#include <vector>

#include "inslab/bus/dds/participant.hpp"

/// The measure that the chain is held against: one process writes TruthState on a grid of deadlines with the product's
/// own QoS, another takes the time in the callback. Nothing else happens in either.
namespace inslab::bench {

struct BareHop {
  dds::ParticipantOptions network;
  double rate_hz = 200.0;
  double duration_s = 5.0;
  int readers = 1;  ///< each a process of its own
};

/// Body of the writing process; returns its exit code.
int write_bare_hop(const BareHop& hop);

/// Body of the reading process: one latency a line, in seconds, to `result_file`. Returns its exit code.
int read_bare_hop(const BareHop& hop, const std::string& result_file);

/// Latencies of a bare hop between fresh processes, those of all readers, without the first half second. Throws
/// std::runtime_error when one of them fails or a sample is lost.
std::vector<double> measure_bare_hop(const BareHop& hop, const std::string& transport, const std::string& folder);

}  // namespace inslab::bench
