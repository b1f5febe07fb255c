#pragma once

#include <optional>
#include <string>

#include "inslab/foundation/fields/violation.hpp"

/// The rule of every Gauss-Markov error: one that is on has a correlation time.
namespace inslab::catalog::detail {

inline std::string element(const std::string& path, int index) { return path + "[" + std::to_string(index) + "]"; }

template <class Sigmas>
std::optional<Violation> correlation_violation(const std::string& path, const char* quantity, const Sigmas& sigma,
                                               const Sigmas& correlation_time_s) {
  for (int axis = 0; axis < static_cast<int>(sigma.size()); ++axis) {
    if (sigma[axis] != 0.0 && !(correlation_time_s[axis] > 0.0)) {
      return Violation{Rule::CorrelationTime, element(path, axis),
                       std::string("is not above 0 where ") + quantity + " is"};
    }
  }
  return std::nullopt;
}

inline std::optional<Violation> correlation_violation(const char* path, const char* quantity, double sigma,
                                                      double correlation_time_s) {
  if (sigma == 0.0 || correlation_time_s > 0.0) return std::nullopt;
  return Violation{Rule::CorrelationTime, path, std::string("is not above 0 where ") + quantity + " is"};
}

}  // namespace inslab::catalog::detail
