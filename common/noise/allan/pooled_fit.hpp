#pragma once

#include "inslab/noise/allan/fit.hpp"

namespace inslab::allan {

/// One parameter of a model that many records share.
struct PooledEstimate {
  Parameter parameter = Parameter::White;
  double value = 0.0;
  double relative_standard_error = 0.0;  ///< of value; from the spread of the records, not from the model
};

/// The model most likely for all records together, each with a constant bias of its own.
///
/// The standard errors are those that the records' own spread gives (the "sandwich" of Huber, 1967): with g_i the slope
/// of record i's logarithm of likelihood at the common maximum and H the curvature of their sum, the covariance is
/// H^-1 (sum g_i g_i^T) H^-1 n/(n - 1). Throws std::invalid_argument for fewer than two records.
std::vector<PooledEstimate> pooled_fit(const std::vector<Likelihood>& records, const std::vector<Term>& terms);

}  // namespace inslab::allan
