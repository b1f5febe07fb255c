#pragma once

#include <vector>

#include "inslab/foundation/time/rate.hpp"
#include "inslab/foundation/time/whole_numbers.hpp"

namespace inslab::time {

/// Every instant of several rates, each once and in order: the truth's samples when its sensors have other rates than
/// it has. With rates that the first one is a multiple of it is the first one's grid.
class Grid {
 public:
  /// Nearer to each other than this no two instants may lie: an interval of few nanoseconds would be rounding alone.
  static constexpr Nanoseconds kLeastApart{100};

  /// Throws std::invalid_argument when there is no rate, or when instants of two rates lie nearer than kLeastApart and
  /// do not coincide.
  explicit Grid(const std::vector<Rate>& rates);
  Grid(const Rate& rate) : Grid(std::vector<Rate>{rate}) {}  // NOLINT: the simplest grid

  /// The first instant after `t`, t >= 0.
  Nanoseconds after(Nanoseconds t) const;
  /// The last instant that is not after `t`, and the first that is not before it; t >= 0.
  Nanoseconds at_or_before(Nanoseconds t) const;
  Nanoseconds at_or_after(Nanoseconds t) const { return contains(t) ? t : after(t); }
  bool contains(Nanoseconds t) const;

  /// How many instants lie after 0 and not after `t`: the index of the last one.
  std::uint64_t index(Nanoseconds t) const;
  /// Instant k; instant 0 is 0.
  Nanoseconds at(std::uint64_t k) const;

  /// Instants in a second, on average.
  double hz() const { return hz_; }
  /// Mean interval of the fastest rate.
  double shortest_period_s() const;

 private:
  /// Instants that several rates share, `sign` telling whether they were counted too seldom or too often before.
  struct Shared {
    Whole samples;
    Whole seconds;
    int sign;
  };

  std::vector<Rate> rates_;  ///< none is a whole fraction of another
  std::vector<Shared> shared_;
  double hz_ = 0.0;
};

/// How near instants of two rates come to each other without coinciding, ns: the greatest common measure of both
/// periods. Of equal rates, or where one is a multiple of the other, that is the shorter period.
double least_distance_ns(const Rate& a, const Rate& b);

}  // namespace inslab::time
