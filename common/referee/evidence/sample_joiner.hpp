#pragma once

#include <map>
#include <utility>

#include "inslab/formats/log/log_walk.hpp"
#include "inslab/referee/evidence/swap_window.hpp"

namespace inslab::evidence {

/// Brings together samples that belong together: they come over several topics, in no order among each other.
class SampleJoiner {
 public:
  /// Puts them into these windows, which are used until the end.
  explicit SampleJoiner(SwapWindowsOfLog& windows);

  void take_part(log::LogWalk& walk);

  /// When the walk is over.
  void finish() { join(true); }

 private:
  /// Sensor number and sim time.
  using Key = std::pair<std::uint32_t, std::int64_t>;

  void join(bool all);
  /// The truth of an odometer's interval, from its beginning on; empty where the log does not have it all.
  std::vector<const TruthState*> way_of(const WheelTravel& travel) const;

  SwapWindowsOfLog& windows_;
  std::size_t next_join_;
  std::map<Key, TruthState> truths_;
  std::map<Key, ImuSample> samples_;
  std::map<Key, ImuTruth> imu_truths_;
  std::map<Key, GnssFix> fixes_;
  std::map<Key, MagneticField> fields_;
  std::map<Key, AirPressure> pressures_;
  std::map<Key, WheelTravel> travels_;
  std::map<Key, BaselineHeading> headings_;
  std::map<Key, Airflow> airflows_;
  std::map<Key, AirflowTruth> airflow_truths_;
};

}  // namespace inslab::evidence
