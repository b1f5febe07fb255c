#include "inslab/referee/verify/outage_verdict.hpp"

#include <fmt/format.h>

namespace inslab::verify {

double allowed_factor(Against against) { return against == Against::Simulated ? 2.0 : 1.5; }

OutageVerdict judged(const DriftFigures& ratios, Against against, const char* imu) {
  const double factor = allowed_factor(against);
  OutageVerdict verdict;
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    if (ratios[i] <= factor && ratios[i] >= 1.0 / factor) continue;
    const Side side = ratios[i] < 1.0 ? Side::Below : Side::Above;
    const double needed = (side == Side::Below ? 1.0 / factor : factor) / ratios[i];
    const bool is_known = is_known_miss(against, imu, i, side, side == Side::Below ? needed : 1.0 / needed);
    verdict.held = false;
    verdict.known_miss = verdict.known_miss && is_known;
    verdict.misses += fmt::format("{}{} x{:.2f}{}", verdict.misses.empty() ? "" : ", ", kDriftNames[i], needed,
                                  is_known ? "" : " (not known)");
  }
  return verdict;
}

}  // namespace inslab::verify
