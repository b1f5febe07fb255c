#include "inslab/noise/allan/allan_stream.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace inslab::allan {
namespace {

AllanPoint point(std::int64_t m, double dt_s, double squares, std::int64_t stride, std::int64_t terms) {
  const double tau_s = static_cast<double>(m) * dt_s;
  return {m, terms > 0 ? squares / (2.0 * tau_s * tau_s * static_cast<double>(terms)) : 0.0, stride, terms};
}

/// The largest power of two that leaves m at least kClusterOverlap of it, without rest.
std::int64_t stride_of(std::int64_t m) {
  std::int64_t stride = 1;
  while (m % (2 * stride) == 0 && m / (2 * stride) >= AllanStream::kClusterOverlap) stride *= 2;
  return stride;
}

}  // namespace

AllanPoint overlapped_allan_variance(const std::vector<double>& phase, double dt_s, std::int64_t m) {
  const std::int64_t terms = std::max<std::int64_t>(static_cast<std::int64_t>(phase.size()) - 2 * m, 0);
  // Four sums side by side: one would wait for itself, and takes three times as long.
  double sums[4] = {};
  const double* x = phase.data();
  const auto square = [x, m](std::int64_t k) {
    const double z = x[k + 2 * m] - 2.0 * x[k + m] + x[k];
    return z * z;
  };
  std::int64_t k = 0;
  for (; k + 4 <= terms; k += 4) {
    for (int i = 0; i < 4; ++i) sums[i] += square(k + i);
  }
  for (; k < terms; ++k) sums[0] += square(k);
  return point(m, dt_s, (sums[0] + sums[1]) + (sums[2] + sums[3]), 1, terms);
}

std::vector<std::int64_t> curve_cluster_sizes(std::int64_t samples, int per_octave) {
  std::vector<std::int64_t> sizes = octave_cluster_sizes(samples / 4, per_octave);
  if (!sizes.empty() && sizes.back() < samples / 4) sizes.push_back(samples / 4);
  return sizes;
}

std::vector<std::int64_t> octave_cluster_sizes(std::int64_t largest, int per_octave) {
  std::vector<std::int64_t> sizes;
  for (int i = 0;; ++i) {
    const double wanted = std::exp2(static_cast<double>(i) / per_octave);
    std::int64_t stride = 1;
    while (wanted >= static_cast<double>(2 * AllanStream::kClusterOverlap * stride)) stride *= 2;
    const std::int64_t size = std::llround(wanted / static_cast<double>(stride)) * stride;
    if (size > largest) return sizes;
    if (sizes.empty() || size > sizes.back()) sizes.push_back(size);
  }
}

AllanStream::AllanStream(double dt_s, std::vector<std::int64_t> sizes) : dt_s_(dt_s), sizes_(sizes.size()) {
  if (!(std::isfinite(dt_s) && dt_s > 0.0)) throw std::invalid_argument("Allan: the interval is not above 0 s");
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const std::int64_t m = sizes[i];
    if (m < 1) throw std::invalid_argument("Allan: the cluster size " + std::to_string(m) + " is below 1");
    const std::int64_t stride = stride_of(m);
    auto level = std::find_if(levels_.begin(), levels_.end(), [&](const Level& l) { return l.stride == stride; });
    if (level == levels_.end()) level = levels_.insert(levels_.end(), Level{stride, {}, {}});
    level->sums.push_back({m, i, static_cast<std::size_t>(m / stride)});
  }
  for (Level& level : levels_) {
    std::size_t longest = 0;
    for (const Sum& sum : level.sums) longest = std::max(longest, sum.j);
    std::size_t length = 1;
    while (length < 2 * longest + 1) length *= 2;
    level.ring.resize(length);
    put(level, 0.0);
  }
  std::sort(levels_.begin(), levels_.end(), [](const Level& a, const Level& b) { return a.stride < b.stride; });
}

void AllanStream::put(Level& level, double phase) {
  const std::size_t mask = level.ring.size() - 1;
  const auto place = static_cast<std::size_t>(level.count);
  level.ring[place & mask] = phase;
  ++level.count;
  for (Sum& sum : level.sums) {
    if (2 * sum.j > place) continue;
    const double z = phase - 2.0 * level.ring[(place - sum.j) & mask] + level.ring[(place - 2 * sum.j) & mask];
    sum.squares += z * z;
    ++sum.terms;
  }
}

void AllanStream::add(double increment) {
  if (samples_ == 0) first_ = increment;
  phase_ += increment - first_;
  ++samples_;
  for (Level& level :
       levels_) {  // strides are powers of two in increasing order: the first that does not divide ends it
    if (samples_ % level.stride != 0) break;
    put(level, phase_);
  }
}

std::vector<AllanPoint> AllanStream::points() const {
  std::vector<AllanPoint> all(sizes_);
  for (const Level& level : levels_) {
    for (const Sum& sum : level.sums) all[sum.order] = point(sum.m, dt_s_, sum.squares, level.stride, sum.terms);
  }
  all.erase(std::remove_if(all.begin(), all.end(), [](const AllanPoint& p) { return p.terms == 0; }), all.end());
  return all;
}

std::size_t AllanStream::memory_bytes() const {
  std::size_t bytes = sizeof(*this);
  for (const Level& level : levels_) {
    bytes += sizeof(Level) + level.sums.size() * sizeof(Sum) + level.ring.size() * sizeof(double);
  }
  return bytes;
}

}  // namespace inslab::allan
