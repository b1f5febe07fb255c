#pragma once

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/data/samples/imu_truth.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/strapdown.hpp"
#include "inslab/noise/random/stream.hpp"

namespace inslab::sim {

/// The IMU's true state plus errors drawn from a covariance with these sigmas: position m, velocity m/s, phi rad, each
/// in NED. What a filter that begins there with these sigmas believes of its errors is true. `draws`: numbers 0 to 8.
inline nav::NavState drawn_start(const ImuTruth& truth, const Vector9& sigmas, const random::Stream& draws) {
  Vector9 e;
  for (int i = 0; i < 9; ++i) e[i] = sigmas[i] * draws.normal(static_cast<std::uint64_t>(i));
  const nav::Geodetic place = geodetic_of(truth);
  return {nav::displaced(place, e.head<3>()), truth.v_n + e.segment<3>(3),
          nav::quaternion_from_rotation_vector(-e.tail<3>()) * truth.q_nb};
}

}  // namespace inslab::sim
