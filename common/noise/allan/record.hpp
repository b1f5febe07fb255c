#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace inslab::allan {

/// What a fit needs of a record, in flat memory however long the record is: an orthogonal (Haar) split of it.
///
/// Fewer than `max_clusters` sums of 2^L successive increments, L as small as that allows; and of everything finer only
/// the mean square of the differences of neighbouring sums of 2^l increments, l < L, which are second differences of
/// the integral at tau = 2^l dt that do not overlap.
class Record {
 public:
  static constexpr std::size_t kMaxClusters = 8192;  ///< 64 kB

  /// Squares of the differences of neighbours at one cluster size.
  struct Details {
    double squares = 0.0;  ///< their sum, u^2 s^2
    std::int64_t count = 0;
  };

  /// Throws std::invalid_argument when dt_s is not above 0 or max_clusters is not an even number above 0.
  explicit Record(double dt_s, std::size_t max_clusters = kMaxClusters);

  /// The next increment of the integral: the rate's integral over one sample, u s.
  void add(double increment);

  double dt_s() const { return dt_s_; }
  std::int64_t samples() const { return samples_; }
  double span_s() const { return static_cast<double>(samples_) * dt_s_; }

  /// Mean of the rate over the whole record, u.
  double mean() const;

  std::int64_t samples_per_cluster() const { return std::int64_t{1} << details_.size(); }
  /// Mean rate of each cluster less that of the first sample of the record, u.
  std::vector<double> cluster_means() const;
  /// By l: differences of neighbours of 2^l increments.
  const std::vector<Details>& details() const { return details_; }

 private:
  void merge();

  double dt_s_;
  std::size_t max_clusters_;
  std::int64_t samples_ = 0;
  double first_ = 0.0;  ///< taken off every increment: the integral of a large constant costs no digits
  double total_ = 0.0;
  std::vector<Details> details_;
  std::vector<double> pending_;   ///< by l: the left one of a pair that waits for its neighbour
  std::vector<double> clusters_;  ///< sums
};

}  // namespace inslab::allan
