#pragma once

#include "inslab/models/gnss/model.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/sim/profile_desk.hpp"

namespace inslab::gnss {

/// One GNSS receiver that obeys the journal: truth and journal entries in, fixes and acknowledgements out. Knows no bus
/// and no clock; the live service and the one-process runner drive the same class.
class Emulator {
 public:
  struct Result {
    std::optional<GnssFix> fix;
    std::vector<ProfileAck> acks;  ///< an outage keeps them back until the first fix after it
  };

  Emulator(const scenario::LoadedScenario& scenario, const scenario::LoadedGnss& gnss);

  void add(const AnyProfile& entry) { desk_.add(entry); }
  bool ready_for(const TruthState& truth) const { return desk_.complete_for(truth); }
  /// Truth samples come in order, each once, when ready_for() says so.
  Result process(const TruthState& truth);
  /// The run is over: what becomes of swaps under which no sample came out.
  std::vector<ProfileAck> close(const RunId& run) { return desk_.close(run); }

  /// What it needs to go on from here (recovery/state_stream.hpp).
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.model_, self.desk_);
  }

 private:
  GnssModel model_;
  swap::ProfileDesk desk_;
};

}  // namespace inslab::gnss
