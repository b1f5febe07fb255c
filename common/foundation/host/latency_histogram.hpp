#pragma once

#include <array>
#include <cstdint>

namespace inslab::host {

/// Latencies from 100 ns to 1000 s in bins of 2 %, in flat memory. What lies outside counts in the bin at that end, so
/// that clocks which do not agree cannot upset it.
class LatencyHistogram {
 public:
  void add(double seconds);

  std::uint64_t count() const { return count_; }
  double max_s() const { return max_s_; }
  /// The latency that the share `q` (0 to 1) of all does not exceed, to 1 %; -1 when there is none.
  double quantile_s(double q) const;

 private:
  static constexpr double kSmallest_s = 1e-7;
  static constexpr std::size_t kBins = 1164;  // ln(1e10) / ln(1.02)

  std::array<std::uint64_t, kBins> bins_{};
  std::uint64_t count_ = 0;
  double max_s_ = -1.0;
};

}  // namespace inslab::host
