#pragma once

#include <vector>

#include "inslab/sim/offline_run.hpp"

namespace inslab::test {

/// Keeps everything an offline run gives.
class RunRecorder : public sim::RunSink {
 public:
  void journal(const catalog::AnyProfile& entry) override { entries.push_back(entry); }
  void vehicle_state(const UsedVehicleState& used) override { vehicle_states.push_back(used); }
  void truth(const TruthState& truth) override { truths.push_back(truth); }
  void imu(std::size_t, const ImuSample& sample, const ImuTruth& truth) override {
    samples.push_back(sample);
    imu_truths.push_back(truth);
  }
  void gnss(std::size_t, const GnssFix& fix) override { fixes.push_back(fix); }
  void ack(const ProfileAck& ack) override { acks.push_back(ack); }

  std::vector<catalog::AnyProfile> entries;
  std::vector<UsedVehicleState> vehicle_states;
  std::vector<TruthState> truths;
  std::vector<ImuSample> samples;
  std::vector<ImuTruth> imu_truths;
  std::vector<GnssFix> fixes;
  std::vector<ProfileAck> acks;
};

}  // namespace inslab::test
