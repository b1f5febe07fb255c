#pragma once

#include <string>

#include "inslab/referee/verify/known_misses.hpp"

namespace inslab::verify {

/// Drifts held against the thesis's, on both sides.
struct OutageVerdict {
  bool held = true;        ///< every figure is within the factor, either way
  bool known_miss = true;  ///< those that are not are known misses
  std::string misses;      ///< each figure outside and what it would have to be multiplied by; empty: none
};

/// The factor, either way: 2 for what the thesis simulated, 1.5 for what it measured.
double allowed_factor(Against against);

OutageVerdict judged(const DriftFigures& ratios, Against against, const char* imu);

}  // namespace inslab::verify
