#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/models/gnss/gnss_model.hpp"
#include "inslab/nav/geodesy.hpp"

namespace inslab::statistical {
namespace gnss_statistics_test {

/// Errors of every epoch, north east down of position (m) and of velocity (m/s).
std::array<std::vector<double>, 6> errors_of(const GnssErrorProfile& profile, std::uint64_t seed, std::int64_t epochs) {
  gnss::GnssModel::Setup setup{seed, 0, time::Rate(1.0), profile, {}, {}, {}};
  setup.installation.target.kind = SensorKind::Gnss;
  gnss::GnssModel model(setup);
  TruthState truth;
  truth.latitude_rad = 0.53;
  truth.longitude_rad = 1.996;
  std::array<std::vector<double>, 6> errors;
  for (std::int64_t k = 1; k <= epochs; ++k) {
    truth.header.sim_time_ns = k * 1000000000;
    const auto fix = model.observe(truth);
    const Vector3 position = nav::ned_from(geodetic_of(truth), geodetic_of(*fix));
    for (int axis = 0; axis < 3; ++axis) {
      errors[axis].push_back(position[axis]);
      errors[3 + axis].push_back(fix->v_n[axis]);
    }
  }
  return errors;
}

// Thesis tables 4-8 and 4-9: 20 minutes, three grades; 20 seeds pooled. The sample variance of N = 24000 draws has
// relative standard error sqrt(2/N) = 0.9 %.
TEST(GnssStatistics, ErrorsHaveTheSetSigmaAtEveryGrade) {
  const double position_m[3] = {0.03, 0.3, 3.0}, velocity_m_per_s[3] = {0.05, 0.5, 5.0};
  GnssErrorProfile profile;
  profile.position_sigma_ned_m = {position_m[0], position_m[1], position_m[2]};
  profile.velocity_sigma_ned_m_per_s = {velocity_m_per_s[0], velocity_m_per_s[1], velocity_m_per_s[2]};
  std::array<double, 6> sum{};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto errors = errors_of(profile, seed, 1200);
    for (int axis = 0; axis < 6; ++axis) {
      for (const double e : errors[axis]) sum[axis] += e * e;
    }
  }
  for (int axis = 0; axis < 6; ++axis) {
    const double sigma = axis < 3 ? position_m[axis] : velocity_m_per_s[axis - 3];
    EXPECT_NEAR(sum[axis] / 24000.0, sigma * sigma, 4.0 * std::sqrt(2.0 / 24000.0) * sigma * sigma) << axis;
  }
}

// The correlation of independent numbers has standard error 1/sqrt(N); 15 pairs and 6 lags stay within 4.5 of them.
TEST(GnssStatistics, ErrorsAreWhiteAndIndependentOfEachOther) {
  GnssErrorProfile profile;
  profile.position_sigma_ned_m.setConstant(1.0);
  profile.velocity_sigma_ned_m_per_s.setConstant(1.0);
  const auto errors = errors_of(profile, 7, 20000);
  const auto correlation = [&](int a, int b, std::size_t lag) {
    double sum = 0.0;
    for (std::size_t k = 0; k + lag < errors[a].size(); ++k) sum += errors[a][k] * errors[b][k + lag];
    return sum / static_cast<double>(errors[a].size() - lag);
  };
  const double bound = 4.5 / std::sqrt(20000.0 - 1.0);
  for (int a = 0; a < 6; ++a) {
    EXPECT_LT(std::abs(correlation(a, a, 1)), bound) << a;
    for (int b = a + 1; b < 6; ++b) EXPECT_LT(std::abs(correlation(a, b, 0)), bound) << a << " and " << b;
  }
}

}  // namespace gnss_statistics_test
}  // namespace inslab::statistical
