#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

namespace inslab::score {

/// Quantiles of magnitudes from 1e-9 to 1e9 in flat memory: bins of 1 %, so that a quantile is good to 0.5 %. Smaller
/// ones, 0 included, count in the lowest bin, larger ones in the highest.
class Quantiles {
 public:
  void add(double magnitude) {
    const double bin = std::log(std::max(magnitude, kSmallest) / kSmallest) / std::log(kRatio);
    ++bins_[std::min(static_cast<std::size_t>(bin), kBins - 1)];
    ++count_;
    largest_ = std::max(largest_, magnitude);
  }

  std::uint64_t count() const { return count_; }
  double largest() const { return largest_; }

  /// The magnitude that the share `q` (0 to 1) of all does not exceed; nothing when there is none.
  std::optional<double> at(double q) const {
    if (count_ == 0) return std::nullopt;
    const auto rank = static_cast<std::uint64_t>(std::ceil(q * static_cast<double>(count_)));
    std::uint64_t below = 0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      below += bins_[bin];
      if (below >= std::max<std::uint64_t>(rank, 1)) {
        return std::min(kSmallest * std::pow(kRatio, static_cast<double>(bin) + 0.5), largest_);
      }
    }
    return largest_;
  }

  /// Calls `each(middle, count)` with every bin that is not empty.
  template <class Each>
  void for_each_bin(const Each& each) const {
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      if (bins_[bin] > 0) each(kSmallest * std::pow(kRatio, static_cast<double>(bin) + 0.5), bins_[bin]);
    }
  }

 private:
  static constexpr double kSmallest = 1e-9;
  static constexpr double kRatio = 1.01;
  static constexpr std::size_t kBins = 4166;  // ln(1e18) / ln(1.01), and one

  std::array<std::uint32_t, kBins> bins_{};
  std::uint64_t count_ = 0;
  double largest_ = 0.0;
};

}  // namespace inslab::score
