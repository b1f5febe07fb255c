#pragma once

#include <string>

#include "inslab/noise/allan/likelihood.hpp"

namespace inslab::allan {

/// How well a fitted model explains the Allan curve of the record it was fitted to.
struct Goodness {
  double chi_square = 0.0;   ///< of the residuals; its mean is `degrees` where the model is right
  int degrees = 0;           ///< points less parameters
  double probability = 1.0;  ///< of a chi-square as large by chance
  double departure = 0.0;    ///< fitted over measured deviation less 1, where it is largest of the points chance denies
  double departure_tau_s = 0.0;

  /// Less likely than 1 in 1000, and a deviation off by more than 5 %. Of long records the first alone is no fault
  /// worth the name: they show what a sensor's filter does to a hundredth.
  bool is_poor() const;
  /// The number in words, for people.
  std::string sentence() const;
};

/// The residuals are those of the curve of pairs of clusters that do not overlap, tau an octave apart, whose points are
/// nearly independent where those of an overlapped curve are not: each is put as the normal variable that is as seldom,
/// given its degrees of freedom under the model, and their squares are added. `parameters`: fitted to the record.
Goodness goodness_of(const Likelihood& record, const NoiseModel& model, int parameters);

}  // namespace inslab::allan
