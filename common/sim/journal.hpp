#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "inslab/data/catalog/any_profile.hpp"
#include "inslab/data/requests/run_control.hpp"
#include "inslab/foundation/fields/violation.hpp"
#include "inslab/foundation/time/grid.hpp"

namespace inslab::sim {

/// The answer to a request that changes nothing, with the field at fault and why.
ProfileAck rejected(const catalog::AnyProfile& request, const std::string& field, const std::string& reason);

/// The one order of all accepted swaps. Its owner, the trajectory server, is its only writer; every service obeys it.
///
/// An entry with apply time T is in effect for the samples after T: for an IMU the intervals that begin at T or later,
/// for a GNSS receiver the epochs after T. T lies on the truth grid.
class Journal {
 public:
  /// `sensors` are those of the scenario: a request for another one is rejected. `end` is the sim time of the last
  /// truth sample: what would take effect there or later is rejected, since no sample comes out under it.
  Journal(std::vector<SensorAddress> sensors, time::Grid truth_grid, time::Nanoseconds end);

  /// Judges a request when the last truth sample sent was that of sim time `now`. Gives the numbered entry with its
  /// apply time settled (a past or negative one becomes `now`, one between two grid points the later of them), or the
  /// rejection, which changes nothing and names the offending field.
  std::variant<catalog::AnyProfile, ProfileAck> submit(catalog::AnyProfile request, time::Nanoseconds now);

  /// How many entries are in effect for a sample of sim time `t`.
  std::uint32_t in_effect(time::Nanoseconds t) const;

  /// Whether an entry has this apply time.
  bool applies_at(time::Nanoseconds t) const;

  std::uint32_t size() const { return static_cast<std::uint32_t>(apply_times_.size()); }

 private:
  std::optional<Violation> rejection_of(const catalog::AnyProfile& request, time::Nanoseconds now) const;

  std::vector<SensorAddress> sensors_;
  time::Grid truth_grid_;
  time::Nanoseconds end_;
  std::vector<std::int64_t> apply_times_;  // sorted
};

}  // namespace inslab::sim
