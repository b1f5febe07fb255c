#include "inslab/foundation/time/grid.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "inslab/foundation/time/whole_numbers.hpp"

namespace inslab::time {

namespace {

constexpr Whole kLongest_s = 9'000'000'000;               // as far as nanoseconds of 64 bits reach
constexpr Whole kLargest = static_cast<Whole>(1) << 120;  // over 2^63 samples that is longer still

/// One instant each `seconds` / `samples`.
struct Period {
  Whole seconds;
  Whole samples;
};

/// Whether every instant of `slow` is one of `fast`.
bool covers(const Rate& fast, const Rate& slow) {
  return static_cast<Whole>(fast.samples()) * slow.seconds() % (static_cast<Whole>(fast.seconds()) * slow.samples()) ==
         0;
}

/// The period after which both have an instant at once, or nothing when that is beyond all time.
std::optional<Period> common(const Period& a, const Period& b) {
  const Whole times = a.seconds / common_divisor(a.seconds, b.seconds);
  if (times > kLargest / b.seconds) return std::nullopt;
  const Whole seconds = times * b.seconds;
  const Whole samples = common_divisor(a.samples, b.samples);
  if (seconds / samples > kLongest_s) return std::nullopt;
  const Whole divisor = common_divisor(seconds, samples);
  return Period{seconds / divisor, samples / divisor};
}

/// How many instants round(k 1e9 seconds/samples) lie after 0 and not after `t_ns`.
Whole count_until(const Period& period, std::int64_t t_ns) {
  const Whole above = (2 * static_cast<Whole>(t_ns) + 1) * period.samples;
  const Whole below = 2 * static_cast<Whole>(kNsPerSecond) * period.seconds;
  return (above + below - 1) / below - 1;
}

}  // namespace

double least_distance_ns(const Rate& a, const Rate& b) {
  const Whole measure =
      common_divisor(static_cast<Whole>(a.seconds()) * b.samples(), static_cast<Whole>(b.seconds()) * a.samples());
  return 1e9 * static_cast<double>(measure) / static_cast<double>(a.samples()) / static_cast<double>(b.samples());
}

Grid::Grid(const std::vector<Rate>& rates) {
  if (rates.empty()) throw std::invalid_argument("a grid has at least one rate");
  for (const Rate& rate : rates) {
    const bool has_it =
        std::any_of(rates_.begin(), rates_.end(), [&rate](const Rate& other) { return covers(other, rate); });
    if (has_it) continue;
    rates_.erase(
        std::remove_if(rates_.begin(), rates_.end(), [&rate](const Rate& other) { return covers(rate, other); }),
        rates_.end());
    rates_.push_back(rate);
  }
  for (std::size_t i = 0; i < rates_.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (least_distance_ns(rates_[i], rates_[j]) < static_cast<double>(kLeastApart.count())) {
        throw std::invalid_argument("instants of " + std::to_string(rates_[j].hz()) + " Hz and " +
                                    std::to_string(rates_[i].hz()) + " Hz lie nearer than 100 ns to each other");
      }
    }
  }
  // Inclusion and exclusion: what two rates share was counted twice, what three share has then been taken off once too
  // often, and so on.
  std::vector<std::pair<Period, int>> sets;
  for (const Rate& rate : rates_) {
    const Period period{rate.seconds(), rate.samples()};
    const std::size_t before = sets.size();
    sets.push_back({period, 1});
    for (std::size_t i = 0; i < before; ++i) {
      if (const auto both = common(sets[i].first, period)) sets.push_back({*both, -sets[i].second});
    }
  }
  for (const auto& [period, sign] : sets) {
    shared_.push_back({period.samples, period.seconds, sign});
    hz_ += sign * static_cast<double>(period.samples) / static_cast<double>(period.seconds);
  }
}

Nanoseconds Grid::after(Nanoseconds t) const {
  Nanoseconds first = Nanoseconds::max();
  for (const Rate& rate : rates_) first = std::min(first, rate.at(rate.index(t) + 1));
  return first;
}

Nanoseconds Grid::at_or_before(Nanoseconds t) const {
  Nanoseconds last{0};
  for (const Rate& rate : rates_) last = std::max(last, rate.at(rate.index(t)));
  return last;
}

bool Grid::contains(Nanoseconds t) const {
  return std::any_of(rates_.begin(), rates_.end(), [t](const Rate& rate) { return rate.contains(t); });
}

std::uint64_t Grid::index(Nanoseconds t) const {
  if (rates_.size() == 1) return rates_.front().index(t);
  Whole count = 0;
  for (const Shared& shared : shared_) {
    count += shared.sign * count_until({shared.seconds, shared.samples}, t.count());
  }
  return static_cast<std::uint64_t>(count);
}

Nanoseconds Grid::at(std::uint64_t k) const {
  if (rates_.size() == 1) return rates_.front().at(k);
  // Instant k of the union comes no later than instant k of any of its rates.
  Nanoseconds before{-1}, until = Nanoseconds::max();
  for (const Rate& rate : rates_) until = std::min(until, rate.at(k));
  while (until - before > Nanoseconds(1)) {
    const Nanoseconds middle = before + (until - before) / 2;
    (index(middle) >= k ? until : before) = middle;
  }
  return until;
}

double Grid::shortest_period_s() const {
  double shortest_s = rates_.front().period_s();
  for (const Rate& rate : rates_) shortest_s = std::min(shortest_s, rate.period_s());
  return shortest_s;
}

}  // namespace inslab::time
