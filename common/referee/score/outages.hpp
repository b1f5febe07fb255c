#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "inslab/referee/score/true_pose.hpp"

namespace inslab::score {

/// The largest errors between the last fix before an outage and the first one after it.
struct OutageDrift {
  std::int64_t begin_ns = 0;  ///< sim time of the last fix before it
  std::int64_t end_ns = 0;    ///< of the first fix after it, or of the end of the run
  std::uint64_t solutions = 0;
  double horizontal_m = 0.0;
  double vertical_m = 0.0;
};

/// When the receiver has no fix: between a fix and the next one, with an epoch without a fix between them, be it that
/// the receiver says so or that it says nothing. Before its first fix there is no outage.
class Outages {
 public:
  /// A period of 0: there is no receiver, and no outage.
  explicit Outages(std::int64_t period_ns) : period_ns_(period_ns) {}

  /// The receiver's epochs; those that do not come after the one before are passed over.
  void add(std::int64_t sim_time_ns, bool has_fix);

  /// Whether the epochs that decide about `sim_time_ns` are there, or have been missing for long.
  bool can_tell(std::int64_t sim_time_ns, std::int64_t newest_truth_ns) const;

  /// Whether a time lies in an outage, which is then open. Times do not go back.
  bool contains(std::int64_t sim_time_ns, std::int64_t newest_truth_ns);

  /// An error at the time that contains() was asked about last.
  void note(const SolutionError& error);

  /// The run ends: so does an open outage.
  void finish(std::int64_t newest_truth_ns);

  const std::vector<OutageDrift>& all() const { return outages_; }

 private:
  struct Epoch {
    std::int64_t sim_time_ns;
    bool has_fix;
  };

  std::int64_t period_ns_;
  std::deque<Epoch> epochs_;  ///< from the oldest that contains() has not passed
  std::optional<std::int64_t> last_fix_ns_;
  bool open_ = false;
  std::vector<OutageDrift> outages_;
};

}  // namespace inslab::score
