#pragma once

#include <optional>
#include <vector>

#include "inslab/nav/vectors.hpp"

namespace inslab::nav {

/// The slopes at its points of the twice continuously differentiable piecewise cubic through them.
///
/// `intervals` are the parameter's steps from point to point, above 0, and `chord_slopes` the differences of
/// neighbouring points over them; at least one. Where an end's slope is not given the end piece is a parabola. Time and
/// memory are linear in the points.
std::vector<Vector3> cubic_spline_slopes(const std::vector<double>& intervals, const std::vector<Vector3>& chord_slopes,
                                         const std::optional<Vector3>& first, const std::optional<Vector3>& last);

}  // namespace inslab::nav
