#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "inslab/nav/strapdown.hpp"

namespace inslab::verify {

/// A strapdown algorithm as the blocks of the verification see it.
class Mechanization {
 public:
  Mechanization() = default;
  Mechanization(const Mechanization&) = delete;
  Mechanization& operator=(const Mechanization&) = delete;
  virtual ~Mechanization() = default;

  virtual void advance(const nav::ImuIncrements& imu) = 0;
  virtual void hold_vertical(double height_m, double v_d_m_per_s) = 0;
  virtual nav::NavState state() const = 0;
};

/// Begins one: the state, gravity, the algorithm's options, the interval that ends at the start.
using MechanizationOf = std::function<std::unique_ptr<Mechanization>(
    const nav::NavState& start, const nav::Gravity& gravity, const nav::Strapdown::Options& options,
    const std::optional<nav::ImuIncrements>& before)>;

/// The product's: nav::Strapdown.
std::unique_ptr<Mechanization> product_mechanization(const nav::NavState& start, const nav::Gravity& gravity,
                                                     const nav::Strapdown::Options& options,
                                                     const std::optional<nav::ImuIncrements>& before);

/// The two-sample algorithm of thesis (2-29)..(2-57) written again, in long double, with rotation matrices and with
/// latitude, longitude and height instead of the product's quaternions, and with an ellipsoid and a gravity of its own
/// (reference_earth.hpp; `gravity` is not looked at). The inverse mechanization and nav::Strapdown share their
/// equations, so that a wrong one goes unseen between the two; here it shows.
std::unique_ptr<Mechanization> reference_mechanization(const nav::NavState& start, const nav::Gravity& gravity,
                                                       const nav::Strapdown::Options& options,
                                                       const std::optional<nav::ImuIncrements>& before);

}  // namespace inslab::verify
