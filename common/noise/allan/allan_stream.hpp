#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace inslab::allan {

/// One point of an Allan curve.
struct AllanPoint {
  std::int64_t m = 0;       ///< cluster size, samples; tau = m dt
  double variance = 0.0;    ///< u^2, u the unit of the rate
  std::int64_t stride = 1;  ///< samples between successive clusters; 1: fully overlapped
  std::int64_t terms = 0;   ///< second differences averaged
};

/// Overlapped Allan variance of a record in memory, at tau = m dt, in the phase form: the mean over all k of
/// (x[k+2m] - 2 x[k+m] + x[k])^2 / (2 tau^2). `phase` holds the integral of the rate, one value more than samples.
/// A point without a single term has 0 terms. Source: IEEE Std 952-1997, annex C; NIST SP 1065, (10).
AllanPoint overlapped_allan_variance(const std::vector<double>& phase, double dt_s, std::int64_t m);

/// About `per_octave` cluster sizes an octave from 1 to `largest`, all of the form j 2^l with j <= 2 kClusterOverlap,
/// which AllanStream keeps in little memory.
std::vector<std::int64_t> octave_cluster_sizes(std::int64_t largest, int per_octave = 3);

/// The sizes of a whole record's curve: those of octave_cluster_sizes(), and as the last a quarter of the record.
std::vector<std::int64_t> curve_cluster_sizes(std::int64_t samples, int per_octave = 3);

/// Overlapped Allan variance of a record that passes by once and may be of any length.
///
/// A cluster size m = j 2^l with j >= kClusterOverlap is estimated from the integral at every 2^l-th sample only, with
/// l as large as divides m so: clusters start every m/j <= m/32 instead of every sample, which costs less than 1 % of
/// the degrees of freedom (a test holds that), and their memory is 2j + 1 numbers. So the sizes of octave_cluster_sizes
/// take at most 130 numbers an octave, 30 kB an axis for 45 h at 200 Hz (26 octaves), however long the record; a size
/// that is odd takes 2m + 1 numbers and is fully overlapped.
class AllanStream {
 public:
  static constexpr std::int64_t kClusterOverlap = 32;

  /// `sizes`: cluster sizes in samples, each at least 1. Throws std::invalid_argument otherwise, or when dt_s <= 0.
  AllanStream(double dt_s, std::vector<std::int64_t> sizes);

  /// The next increment of the integral: the rate's integral over one sample, u s.
  void add(double increment);

  /// One point for each size with at least one term, in the order of the sizes given.
  std::vector<AllanPoint> points() const;

  std::int64_t samples() const { return samples_; }

  /// Bytes held for the record, whatever its length.
  std::size_t memory_bytes() const;

 private:
  struct Sum {
    std::int64_t m;
    std::size_t order;  ///< place among the sizes given
    std::size_t j;      ///< m in strides
    double squares = 0.0;
    std::int64_t terms = 0;
  };
  /// What shares a stride: one ring of the integral.
  struct Level {
    std::int64_t stride;
    std::vector<Sum> sums;
    std::vector<double> ring;  ///< a power of two long
    std::int64_t count = 0;    ///< values put in so far
  };

  static void put(Level& level, double phase);

  double dt_s_;
  std::size_t sizes_;
  std::vector<Level> levels_;  ///< by stride
  std::int64_t samples_ = 0;
  double first_ = 0.0;  ///< taken off every increment, so that the integral of a large constant costs no digits
  double phase_ = 0.0;
};

}  // namespace inslab::allan
