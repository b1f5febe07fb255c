#pragma once

#include <vector>

#include "inslab/referee/verify/subjects.hpp"
#include "inslab/referee/verify/table.hpp"

namespace inslab::verify {

/// GNSS errors (thesis tables 4-8, 4-9): 20 minutes at 10 Hz of a car on a circle, three grades, white errors; three
/// axes times seeds 1 to `seeds` give independent estimates of each sigma. The pooled one must lie within 3.5 standard
/// errors of the set value, by the estimator's own variance.
Table gnss_noise(std::uint64_t seeds, const Subjects& subjects = {});

/// The same of first-order Gauss-Markov errors, which the seed document does not measure: sigma, and the
/// autocorrelation after one correlation time, which is 1/e.
Table gnss_gauss_markov(std::uint64_t seeds, const Subjects& subjects = {});

/// Antenna minus IMU against the rotated arm, and the antenna's velocity against the five-point derivative of its
/// positions, over two minutes of a vehicle that tumbles through all attitudes.
Table gnss_lever_arm(const Subjects& subjects = {});

/// `inslab verify gnss`: 20 seeds, or with `full` 200.
std::vector<Table> gnss(bool full);

}  // namespace inslab::verify
