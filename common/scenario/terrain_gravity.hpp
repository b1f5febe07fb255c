#pragma once

#include <cstdint>
#include <optional>

#include "inslab/nav/gravity.hpp"
#include "inslab/nav/gravity_along_way.hpp"
#include "inslab/nav/gravity_field.hpp"
#include "inslab/scenario/trajectory.hpp"

namespace inslab::scenario {

/// A field of plane waves drawn from `seed` whose undulation N = T/g0 has at z = 0 the correlation
/// (1 + u + u^2/3) exp(-u), u the distance over correlation_m: the third-order model of S. Jordan, Self-consistent
/// statistical models for the gravity anomaly, vertical deflections and undulation of the geoid, J. Geophys. Res.
/// 77(20), 1972. Then the deflection along the track has sigma^2 (1 + u - u^2) exp(-u), across it sigma^2 (1 + u)
/// exp(-u), the anomaly 2 g0^2 sigma^2 (1 + u - u^2/2) exp(-u).
nav::GravityField gravity_field(const GravityVariation& variation, const nav::Geodetic& origin, std::uint64_t seed);

/// What departs from the model in the same way everywhere.
nav::Gravity::Disturbance constant_disturbance(const GravityOptions& options);

/// The model with the constant disturbance alone, which needs no seed.
nav::Gravity uniform_gravity(const GravityOptions& options);

/// All of it as a filter may believe in it, at the height 0; nothing where gravity is the model's. A process whose axes
/// know neither the direction of the way nor of each other: sigmas are by root of the sum of squares, and D is such
/// that the mean square of the slope is that of what is added up. Along the track a deflection of the third-order model
/// has 3 sigma^2/D^2 of slope squared, across it 1, the anomaly 2 of its own sigma^2/D^2: 2 in the mean, which is that
/// of a process with D over the root of 2. A constant has no slope. `grid`: of grid_file, null without one.
std::optional<nav::GravityAlongWay> gravity_along_way(const GravityOptions& options, const nav::GravityGrid* grid);

}  // namespace inslab::scenario
