#include "inslab/foundation/host/latency_histogram.hpp"

#include <algorithm>
#include <cmath>

namespace inslab::host {

namespace {
const double kLogWidth = std::log(1.02);
}

void LatencyHistogram::add(double seconds) {
  const double position = std::log(std::max(seconds, kSmallest_s) / kSmallest_s) / kLogWidth;
  ++bins_[std::min(static_cast<std::size_t>(position), kBins - 1)];
  ++count_;
  max_s_ = std::max(max_s_, seconds);
}

double LatencyHistogram::quantile_s(double q) const {
  if (count_ == 0) return -1.0;
  const auto rank = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::ceil(q * static_cast<double>(count_))));
  std::uint64_t below = 0;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    below += bins_[bin];
    if (below >= rank) return std::min(max_s_, kSmallest_s * std::exp(kLogWidth * (static_cast<double>(bin) + 0.5)));
  }
  return max_s_;
}

}  // namespace inslab::host
