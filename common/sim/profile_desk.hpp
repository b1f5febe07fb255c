#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "inslab/data/catalog/any_profile.hpp"
#include "inslab/data/requests/run_control.hpp"
#include "inslab/data/samples/stream_header.hpp"
#include "inslab/data/samples/truth_state.hpp"

namespace inslab::sim {

/// Where a service keeps the journal: it says when a truth sample may be processed, which profiles take effect before
/// it, and what to acknowledge after the first sample under them. Entries may arrive late, early and in any order; the
/// outcome depends on the journal and the truth alone.
class ProfileDesk {
 public:
  /// `in_use` holds the profiles the sensor began with.
  ProfileDesk(SensorAddress sensor, std::string service, const std::vector<catalog::AnyProfile>& in_use);

  /// Takes an entry of the journal, of any sensor; one that is known already is ignored.
  void add(const catalog::AnyProfile& entry);

  /// Whether every entry that is in effect for this sample has arrived.
  bool complete_for(const TruthState& truth) const;

  /// The entries of this sensor that take effect before the sample of sim time `sim_time_ns`, in order: at most one of
  /// each kind, since a later one supersedes an earlier one of the same instant. Call once for every sample.
  std::vector<catalog::AnyProfile> take_due(std::int64_t sim_time_ns);

  /// The acknowledgements that wait for the first sample under the new profiles, which is the one with this header.
  std::vector<ProfileAck> acknowledge(const StreamHeader& first_sample);

  /// The run is over: what becomes of the entries of this sensor under which no sample came out. They are rejected.
  std::vector<ProfileAck> close(const RunId& run);

  /// What it needs to go on from here (data/state/state_stream.hpp): entries that have been taken are not needed again;
  /// those that lie ahead come again with the journal.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.taken_until_ns_, self.taken_, self.parameters_in_use_, self.to_acknowledge_);
    if constexpr (!std::is_const_v<Self>) self.forget_taken();
  }

 private:
  void forget_taken();
  ProfileAck ack_of(const catalog::AnyProfile& entry, AckOutcome outcome) const;

  SensorAddress sensor_;
  std::string service_;
  using Place = std::pair<std::int64_t, std::uint32_t>;                     // apply time and number
  std::int64_t taken_until_ns_ = std::numeric_limits<std::int64_t>::min();  // entries before it have been taken
  std::uint64_t taken_ = 0;                                                 // how many that are, of all sensors
  std::set<Place> ahead_;                                                   // the others that are known, of all sensors
  std::map<Place, catalog::AnyProfile> waiting_;                            // those of this sensor
  std::array<std::vector<std::uint8_t>, catalog::ProfileKinds::size>
      parameters_in_use_;  // by kind, CDR without the request
  std::vector<ProfileAck> to_acknowledge_;
};

}  // namespace inslab::sim
