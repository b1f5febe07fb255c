#pragma once

#include <string>
#include <vector>

#include "inslab/bus/dds/endpoint.hpp"

namespace inslab::dds {

/// What keeps a writer and a reader from hearing each other, and what to do about it.
struct WireFinding {
  std::string what;  ///< topic, both ends, policy and both values
  std::string cure;  ///< what to set at the end that is not ours
};

/// One finding for each reason and each pair of names of participants. Units keep apart on purpose: that endpoints of
/// ours in two of them do not match is no finding, nor is an app that has its counterpart in a unit of its own.
std::vector<WireFinding> wire_findings(const std::vector<Endpoint>& endpoints);

/// The units whose services are among the endpoints, in order; "" is the one without a name.
std::vector<std::string> units_among(const std::vector<Endpoint>& endpoints);

}  // namespace inslab::dds
