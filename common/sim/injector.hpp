#pragma once

#include "inslab/models/imu/model.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/sim/profile_desk.hpp"

namespace inslab::imu {

/// One IMU that obeys the journal: truth and journal entries in, IMU samples and acknowledgements out. Knows no bus and
/// no clock; the live service and the one-process runner drive the same class.
class Injector {
 public:
  struct Result {
    std::optional<ImuModel::Output> output;
    std::vector<ProfileAck> acks;
  };

  Injector(const scenario::LoadedScenario& scenario, const scenario::LoadedImu& imu);

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
  time::Rate rate_;
  ImuModel model_;
  swap::ProfileDesk desk_;
};

}  // namespace inslab::imu
