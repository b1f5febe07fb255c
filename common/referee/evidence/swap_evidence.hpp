#pragma once

#include <memory>
#include <string>
#include <vector>

#include "inslab/referee/evidence/log_summary.hpp"

namespace inslab::evidence {

/// A quantity measured in a stretch of the log beside what the profiles in use promise for it.
struct Measured {
  double value = 0.0;
  double promised = 0.0;
  double tolerance = 0.0;  ///< four standard errors, from the number of samples
  bool holds = false;
};

/// One quantity before and after a swap.
struct EvidenceLine {
  std::string quantity;
  std::string unit;
  Measured before;
  Measured after;
};

/// What the samples themselves say about one swap.
struct SwapEvidence {
  ProfileAck ack;
  std::string profile_name;
  bool first_sample_holds = false;    ///< the first sample with the new revision is the one the ack names
  std::vector<EvidenceLine> lines;    ///< empty where nothing can be measured
  std::string why_nothing;            ///< then the reason; "only 12 samples before it, 30 are needed"
  std::vector<std::string> left_out;  ///< names of what the profile sets and no line weighs (evidence_uses.hpp)

  bool holds() const;
};

/// Weighs every acknowledged swap along a walk, by the samples up to 20 s before and after it, as far as no other swap
/// of the same sensor lies between: ImuSample minus what the sensor's bandwidth lets pass of the ImuTruth, GnssFix
/// minus the truth. What a profile promises is followed through its own bandwidth. The published error budget is not
/// used.
class SwapWeigher {
 public:
  /// `summary` is used until the end.
  explicit SwapWeigher(const LogSummary& summary);
  ~SwapWeigher();
  SwapWeigher(const SwapWeigher&) = delete;
  SwapWeigher& operator=(const SwapWeigher&) = delete;

  void take_part(log::LogWalk& walk);

  /// When the walk is over; once.
  std::vector<SwapEvidence> finish();

 private:
  struct Gathered;
  std::unique_ptr<Gathered> gathered_;
};

/// Reads the log once, for its swaps alone. Throws files::ReadError.
std::vector<SwapEvidence> weigh_swaps(const mcap::McapReader& log, const LogSummary& summary);

}  // namespace inslab::evidence
