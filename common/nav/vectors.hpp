#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace inslab::nav {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;  // Hamilton; scalar first in files and on the wire

}  // namespace inslab::nav
