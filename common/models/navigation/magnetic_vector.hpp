#pragma once

#include <vector>

#include "inslab/data/samples/magnetic_field.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/navigation/measurement.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/world_magnetic_model.hpp"

namespace inslab::navigation {

/// What a magnetometer shows of the Earth's field, along its own axes m:
///
///   B_m = (I + soft iron) C_mb C_bn (World Magnetic Model + its error) + hard iron.
///
/// All three components are taken: heading is what of them attitude lacks, and no tilt has to be taken out first.
struct MagneticVector {
  using Sample = MagneticField;
  static constexpr std::string_view name = "magnetic_vector";

  static bool usable(const MagneticField& sample) { return sample.B_b_nt.allFinite() && !sample.saturated; }

  static void add_to(std::vector<Measurement>& measurements, const MagneticField& sample, const Situation& at,
                     const NavigationParameters& p) {
    const time::GpsTime now{sample.header.gps_week, sample.header.gps_time_of_week_ns};
    const nav::WorldMagneticModel earth(time::decimal_year(now));
    const nav::Vector3 B_n_nt = earth.B_n_nt(at.position) + at.estimates[StateBlock::EarthField];
    const nav::Vector3 rpy_rad = units::kDeg * p.magnetometer.mounting_rpy_deg;
    const nav::Matrix3 C_mb = nav::matrix_from_rpy({rpy_rad.x(), rpy_rad.y(), rpy_rad.z()}).transpose();
    const nav::Matrix3 C_mn = C_mb * at.C_nb.transpose();
    const nav::Vector3 B_m_nt = C_mn * B_n_nt;
    nav::Matrix3 response = nav::Matrix3::Identity();
    for (std::size_t axis = 0; axis < kSoftIron.size(); ++axis) {
      response.row(static_cast<Eigen::Index>(axis)) += at.estimates[kSoftIron[axis]].transpose();
    }
    Measurement& m = measurements.emplace_back();
    m.name = name;
    m.gate = p.innovation_test.limit;
    m.innovation = response * B_m_nt + at.estimates[StateBlock::HardIron] - sample.B_b_nt;
    m.R = p.magnetometer.white_sigma_nt.cwiseAbs2();
    m.by(StateBlock::Attitude, -response * C_mn * nav::skew(B_n_nt));
    m.by(StateBlock::HardIron, nav::Matrix3::Identity());
    for (std::size_t axis = 0; axis < kSoftIron.size(); ++axis) {
      const auto row = static_cast<Eigen::Index>(axis);
      m.by(kSoftIron[axis], nav::Vector3::Unit(row) * B_m_nt.transpose());
    }
    m.by(StateBlock::EarthField, response * C_mn);
  }
};

}  // namespace inslab::navigation
