#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "inslab/data/catalog/any_profile.hpp"
#include "inslab/data/requests/run_control.hpp"

namespace inslab::client {

/// What a client says to a running set and hears of it. RunClient is the one over DDS.
class RunLink {
 public:
  RunLink() = default;
  virtual ~RunLink() = default;
  RunLink(const RunLink&) = delete;
  RunLink& operator=(const RunLink&) = delete;

  /// Whether a trajectory server listens to requests.
  virtual bool connected() const = 0;
  /// False when the request could not be sent.
  virtual bool send(const catalog::AnyProfile& request) = 0;
  /// False when the command could not be sent; what becomes of it stands in the status.
  virtual bool send(const SimCommand& command) = 0;

  /// The run's latest status; nothing before the first.
  virtual std::optional<SimStatus> status() const = 0;
  /// How many statuses have come: whether the server still speaks.
  virtual std::uint64_t statuses() const = 0;
  /// Which other run the trajectory server is in since, in words; empty: none.
  virtual std::string other_run() const = 0;
  /// What came back for a request so far.
  virtual std::vector<ProfileAck> acks(std::uint64_t request_id) const = 0;
};

}  // namespace inslab::client
