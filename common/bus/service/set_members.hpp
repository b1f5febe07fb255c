#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "inslab/bus/dds/participant.hpp"
#include "inslab/data/streams/identity.hpp"

namespace inslab::service {

/// A process cannot start here: somebody else is there already. Says who, and what to choose.
class PlaceTaken : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Whether the process still runs; of another host or container it is not known, and it counts as running.
bool lives(const streams::Identity& identity);

/// The processes of ours that are heard on the network in this unit, and run.
std::vector<streams::Identity> members_of(const dds::Participant& participant, const std::string& unit);

/// Before a process takes its place: hears who is there, for as long as that takes, and throws PlaceTaken when
/// `is_in_the_way` says so of one that was there before.
void look_around(const dds::Participant& participant, const streams::Identity& own,
                 const std::function<bool(const streams::Identity& other)>& is_in_the_way);

/// As look_around(), for one service: another of its role is in the way, and so is a trajectory server that has another
/// scenario.
void look_around(const dds::Participant& participant, const streams::Identity& own);

}  // namespace inslab::service
