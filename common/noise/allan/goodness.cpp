#include "inslab/noise/allan/goodness.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "inslab/noise/allan/confidence.hpp"

namespace inslab::allan {
namespace {

constexpr double kByChance = 1e-3;
constexpr double kFurthestByChance = 3.29;  ///< a normal variable is further out once in 1000
constexpr double kSlight = 0.05;
/// Fewer pairs of clusters say nothing that a chi-square of the whole curve should hear.
constexpr std::int64_t kLeastTerms = 4;

}  // namespace

bool Goodness::is_poor() const { return probability < kByChance && std::abs(departure) > kSlight; }

std::string Goodness::sentence() const {
  if (degrees < 1) return "too few points to judge the fit";
  char text[200];
  if (probability >= kByChance) return "the fit explains the curve";
  if (departure == 0.0) return "the fit departs from the curve by more than chance, but nowhere by much";
  std::snprintf(text, sizeof(text),
                "%s: at tau %.3g s it is %.2g %% %s the measured deviation, more than chance allows",
                is_poor() ? "the fit is poor" : "the fit departs from the curve a little", departure_tau_s,
                100.0 * std::abs(departure), departure > 0.0 ? "above" : "below");
  return text;
}

Goodness goodness_of(const Likelihood& record, const NoiseModel& model, int parameters) {
  Goodness goodness;
  goodness.degrees = -parameters;
  for (const AllanPoint& point : record.rough_curve()) {
    if (point.terms < kLeastTerms) continue;
    const double expected = allan_variance(model, record.dt_s(), point.m);
    const double degrees = equivalent_degrees_of_freedom(point, model, record.dt_s());
    const double normal = as_normal(point.variance / expected, degrees);
    goodness.chi_square += normal * normal;
    ++goodness.degrees;
    const double departure = std::sqrt(expected / point.variance) - 1.0;
    if (std::abs(normal) < kFurthestByChance || std::abs(departure) <= std::abs(goodness.departure)) continue;
    goodness.departure = departure;
    goodness.departure_tau_s = static_cast<double>(point.m) * record.dt_s();
  }
  if (goodness.degrees > 0) {
    goodness.probability = 1.0 - chi_square_probability(goodness.chi_square, goodness.degrees);
  }
  return goodness;
}

}  // namespace inslab::allan
