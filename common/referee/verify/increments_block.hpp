#pragma once

#include <vector>

#include "inslab/referee/verify/subjects.hpp"
#include "inslab/referee/verify/table.hpp"

namespace inslab::verify {

/// Independence of the algorithm: how the error of the two-sample mechanization of the truth's increments falls with
/// the rate, beside that of increments made as rate times interval. `duration_s` of motion, at most an hour; the
/// command takes a minute. Source: docs/models.md.
std::vector<Table> increments(double duration_s, const Subjects& subjects = {});

}  // namespace inslab::verify
