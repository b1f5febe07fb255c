#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "inslab/formats/profile_import/conversion.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/units/units.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::profile_import {
namespace profile_import_test {

using ::testing::Contains;
using ::testing::HasSubstr;

class ProfileImport : public test::TemporaryFolder {
 protected:
  template <class Importer>
  ImportedProfile import(Importer importer, const std::string& text, const ImportOptions& options = {}) {
    put(path("other"), text);
    return importer(path("other"), options);
  }

  template <class Importer>
  std::string error_of(Importer importer, const std::string& text, const ImportOptions& options = {}) {
    try {
      import(importer, text, options);
    } catch (const files::ReadError& error) {
      return error.what();
    }
    return "nothing was refused";
  }
};

constexpr const char* kKfGins = R"(
imudatarate: 200
initgyrbias: [ 1, 2, 3 ]
imunoise:
  arw: [0.003, 0.004, 0.005]   # deg/sqrt(h)
  vrw: [0.03, 0.03, 0.03]
  gbstd: [0.027, 0.027, 0.027]
  abstd: [15.0, 15.0, 15.0]
  gsstd: [300.0, 300.0, 300.0]
  asstd: [200.0, 200.0, 200.0]
  corrtime: 4.0
)";

TEST_F(ProfileImport, OfKfGinsTakesSigmasAsTheyAreAndHoursAsSeconds) {
  const ImportedProfile imported = import(import_kf_gins, kKfGins);
  const GyroErrors& gyro = imported.profile.gyro;
  EXPECT_EQ(gyro.arw_deg_per_sqrt_h, Vector3(0.003, 0.004, 0.005));
  EXPECT_EQ(gyro.bias_gm_sigma_deg_per_h, Vector3::Constant(0.027));
  EXPECT_EQ(gyro.bias_gm_correlation_time_s, Vector3::Constant(14400.0));
  EXPECT_EQ(gyro.scale_factor_gm_sigma_ppm, Vector3::Constant(300.0));
  EXPECT_EQ(imported.profile.accel.vrw_m_per_s_per_sqrt_h, Vector3::Constant(0.03));
  EXPECT_EQ(imported.profile.accel.bias_gm_sigma_mgal, Vector3::Constant(15.0));
  EXPECT_EQ(imported.profile.accel.scale_factor_gm_correlation_time_s, Vector3::Constant(14400.0));
  EXPECT_TRUE(gyro.bias_constant_deg_per_h.isZero(0.0));
  EXPECT_THAT(imported.lines, Contains(HasSubstr("imunoise.gbstd 0.027 deg/h -> gyro.bias_gm_sigma_deg_per_h 0.027")));
}

TEST_F(ProfileImport, OfKfGinsNamesTheLineAtFault) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = kKfGins;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(error_of(import_kf_gins, with("[15.0, 15.0, 15.0]", "[15.0, -1, 15.0]")),
              HasSubstr("line 8, column 17: abstd: expected a finite number, 0 or above"));
  EXPECT_THAT(error_of(import_kf_gins, with("[15.0, 15.0, 15.0]", "[15.0]")), HasSubstr("line 8"));
  EXPECT_THAT(error_of(import_kf_gins, with("  corrtime: 4.0\n", "")), HasSubstr("imunoise has no corrtime"));
  EXPECT_THAT(error_of(import_kf_gins, with("corrtime: 4.0", "corrtime: 0.0")),
              HasSubstr("gyro.bias_gm_correlation_time_s[0] is not above 0"));
  EXPECT_THAT(error_of(import_kf_gins, "a: [1, 2"), HasSubstr("is no YAML"));
  EXPECT_THAT(error_of(import_kf_gins, "a: 1\n"), HasSubstr("has no section imunoise"));
}

constexpr const char* kGnssInsSim = R"(import numpy as np
imu_err = {'gyro_b': np.array([1.0, -2.0, 3.0]),  # deg/h
           'gyro_arw': np.array([0.25, 0.25, 0.25]) * 1.0,
           'gyro_b_stability': np.array([3.5, 3.5, 3.5]),
           'gyro_b_corr': np.array([100.0, 100.0, 100.0]),
           'mag_std': np.array([0.2, 0.2, 0.2]),
           'accel_b': np.array([0.0e-3, 0.0e-3, 2e-3]),
           'accel_vrw': np.array([0.03119, 0.03009, 0.04779]),
           'accel_b_stability': np.array([4.29e-5, 5.72e-5, 8.02e-5]),
           'accel_b_corr': np.array([200.0, 200.0, 200.0])}
)";

TEST_F(ProfileImport, OfGnssInsSimTakesDegreesAsTheyAreAndForcesAsMilliGal) {
  const ImportedProfile imported = import(import_gnss_ins_sim, kGnssInsSim);
  EXPECT_EQ(imported.profile.gyro.bias_constant_deg_per_h, Vector3(1.0, -2.0, 3.0));
  EXPECT_EQ(imported.profile.gyro.arw_deg_per_sqrt_h, Vector3::Constant(0.25));
  EXPECT_EQ(imported.profile.gyro.bias_gm_sigma_deg_per_h, Vector3::Constant(3.5));
  EXPECT_EQ(imported.profile.gyro.bias_gm_correlation_time_s, Vector3::Constant(100.0));
  EXPECT_NEAR(imported.profile.accel.bias_constant_mgal[2], 200.0, 1e-12);
  EXPECT_NEAR(imported.profile.accel.bias_gm_sigma_mgal[1], 5.72, 1e-12);
  EXPECT_EQ(imported.profile.accel.vrw_m_per_s_per_sqrt_h, Vector3(0.03119, 0.03009, 0.04779));
  EXPECT_THAT(imported.lines, Contains(HasSubstr("so it is the steady-state sigma")));
}

TEST_F(ProfileImport, OfGnssInsSimReadsJsonToo) {
  const ImportedProfile imported = import(import_gnss_ins_sim, R"({"gyro_b": [0, 0, 0], "gyro_arw": [1, 1, 1],
    "gyro_b_stability": 2, "gyro_b_corr": 50, "accel_b": 0, "accel_vrw": [0.1, 0.1, 0.1], "accel_b_stability": 0})");
  EXPECT_EQ(imported.profile.gyro.bias_gm_sigma_deg_per_h, Vector3::Constant(2.0));
  EXPECT_TRUE(imported.profile.accel.bias_gm_sigma_mgal.isZero(0.0));
}

TEST_F(ProfileImport, OfGnssInsSimABiasWithoutCorrelationTimeIsWhiteNoiseAtItsRate) {
  const std::string text = R"({"gyro_b": 0, "gyro_arw": 0.3, "gyro_b_stability": 240, "accel_b": 0, "accel_vrw": 0.0,
    "accel_b_stability": 0.01, "accel_b_corr": float("inf")})";
  EXPECT_THAT(error_of(import_gnss_ins_sim, text), HasSubstr("give its rate with --rate"));
  ImportOptions options;
  options.rate_hz = 100.0;
  const ImportedProfile imported = import(import_gnss_ins_sim, text, options);
  // 240 deg/h at 100 Hz: 240/60/10 = 0.4 deg/sqrt(h); 0.01 m/s^2: 0.01 * 60/10 = 0.06 m/s/sqrt(h).
  EXPECT_NEAR(imported.profile.gyro.arw_deg_per_sqrt_h[0], 0.5, 1e-12);
  EXPECT_NEAR(imported.profile.accel.vrw_m_per_s_per_sqrt_h[0], 0.06, 1e-12);
  EXPECT_TRUE(imported.profile.gyro.bias_gm_sigma_deg_per_h.isZero(0.0));
}

TEST_F(ProfileImport, OfGnssInsSimNamesThePlaceAtFault) {
  EXPECT_THAT(error_of(import_gnss_ins_sim, "x = {'gyro_b': np.array([1, 2])}"),
              HasSubstr("line 1, column 30: expected ','"));
  EXPECT_THAT(error_of(import_gnss_ins_sim, "x = {'gyro_b': abc}"), HasSubstr("expected a number"));
  EXPECT_THAT(error_of(import_gnss_ins_sim, "x = {'gyro_b': 1}"), HasSubstr("has no 'gyro_arw'"));
  EXPECT_THAT(error_of(import_gnss_ins_sim, "x = 3"), HasSubstr("has no dictionary"));
  EXPECT_THAT(error_of(import_gnss_ins_sim, "{'gyro_b': 1, 'gyro_b': 1}"), HasSubstr("'gyro_b' is given twice"));
  std::string text = kGnssInsSim;
  EXPECT_THAT(error_of(import_gnss_ins_sim, text.replace(text.find("gyro_b_corr"), 11, "gyro_b_time")),
              HasSubstr("'gyro_b_time' is not a key"));
}

constexpr const char* kGazebo = R"(<?xml version="1.0"?>
<sdf version="1.6"><model name="m"><link name="l">
  <sensor name="imu_sensor" type="imu"><update_rate>250</update_rate>
    <imu>
      <angular_velocity>
        <x><noise type="gaussian"><mean>0</mean><stddev>0.009</stddev><bias_mean>3e-4</bias_mean>
          <bias_stddev>4e-4</bias_stddev><dynamic_bias_stddev>2e-5</dynamic_bias_stddev>
          <dynamic_bias_correlation_time>400</dynamic_bias_correlation_time></noise></x>
        <y><noise type="gaussian"><mean>1e-3</mean><stddev>0.009</stddev></noise></y>
        <z><noise type="none"><stddev>5</stddev></noise></z>
      </angular_velocity>
      <linear_acceleration>
        <x><noise type="gaussian_quantized"><stddev>0.02</stddev><precision>0.5</precision></noise></x>
      </linear_acceleration>
    </imu>
  </sensor>
</link></model></sdf>)";

TEST_F(ProfileImport, OfGazeboTakesDeviationsAtARateAndDrivingDensities) {
  const ImportedProfile imported = import(import_gazebo, kGazebo);
  const GyroErrors& gyro = imported.profile.gyro;
  EXPECT_NEAR(gyro.arw_deg_per_sqrt_h[0], 0.009 / std::sqrt(250.0) / units::kDegPerSqrtH, 1e-12);
  EXPECT_NEAR(gyro.bias_turn_on_sigma_deg_per_h[0], 5e-4 / units::kDegPerH, 1e-9);
  EXPECT_NEAR(gyro.bias_gm_sigma_deg_per_h[0], 2e-5 * std::sqrt(200.0) / units::kDegPerH, 1e-9);
  EXPECT_EQ(gyro.bias_gm_correlation_time_s, Vector3(400.0, 0.0, 0.0));
  EXPECT_NEAR(gyro.bias_constant_deg_per_h[1], -1e-3 / units::kDegPerH, 1e-9);  // left becomes right
  EXPECT_EQ(gyro.arw_deg_per_sqrt_h[2], 0.0);
  EXPECT_NEAR(imported.profile.accel.vrw_m_per_s_per_sqrt_h[0], 0.02 / std::sqrt(250.0) * 60.0, 1e-12);
  EXPECT_NEAR(imported.profile.accel.quantization_m_per_s[0], 0.002, 1e-15);
  EXPECT_THAT(imported.lines, Contains(HasSubstr("sigma = density sqrt(T/2)")));
}

TEST_F(ProfileImport, OfGazeboReadsTheOldFormToo) {
  const ImportedProfile imported = import(import_gazebo, R"(<sdf version="1.4"><sensor name="i" type="imu">
    <update_rate>100</update_rate><imu><noise><type>gaussian</type><rate><mean>0</mean><stddev>0.1</stddev></rate>
    <accel><stddev>1</stddev></accel></noise></imu></sensor></sdf>)");
  EXPECT_NEAR(imported.profile.gyro.arw_deg_per_sqrt_h[2], 0.01 / units::kDegPerSqrtH, 1e-12);
  EXPECT_NEAR(imported.profile.accel.vrw_m_per_s_per_sqrt_h[2], 6.0, 1e-12);
}

TEST_F(ProfileImport, OfGazeboNamesTheLineAtFault) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = kGazebo;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(error_of(import_gazebo, with("<stddev>0.02<", "<stddev>-0.02<")),
              HasSubstr("line 13: <stddev> is below 0"));
  EXPECT_THAT(error_of(import_gazebo, with("<stddev>0.02<", "<stddev>much<")),
              HasSubstr("line 13: <stddev> is not a finite"));
  EXPECT_THAT(error_of(import_gazebo, with("<update_rate>250</update_rate>", "")), HasSubstr("has no <update_rate>"));
  EXPECT_THAT(error_of(import_gazebo, with("</model>", "")),
              HasSubstr(": is no XML, or is broken there; expected an SDF file of Gazebo"));
  EXPECT_THAT(error_of(import_gazebo, "<sdf/>"), HasSubstr("has no <sensor type=\"imu\">"));
  ImportOptions options;
  options.sensor = "other";
  EXPECT_THAT(error_of(import_gazebo, kGazebo, options), HasSubstr("has no IMU 'other'; it has imu_sensor"));
}

TEST_F(ProfileImport, WhatIsNestedTooDeepIsRefusedAtOnceWithItsPlace) {
  const std::string brackets(600'000, '(');
  EXPECT_THAT(error_of(import_gnss_ins_sim, "{'gyro_b': " + brackets),
              HasSubstr("line 1, column 76: is nested deeper than 64"));
  std::string elements, sections = "imunoise:\n  arw: ";
  for (int i = 0; i < 100'000; ++i) {
    elements += "<a>";
    sections += "[";
  }
  EXPECT_THAT(error_of(import_gazebo, elements), HasSubstr("is nested deeper than 64"));
  EXPECT_THAT(error_of(import_kf_gins, sections), HasSubstr("line 2: is nested deeper than"));
}

TEST_F(ProfileImport, WhatIsTooLargeIsRefused) {
  const std::string large(std::size_t{5} << 20, ' ');
  for (const auto importer : {import_kf_gins, import_gnss_ins_sim, import_gazebo}) {
    EXPECT_THAT(error_of(importer, large), HasSubstr("has 5242880 bytes; expected at most 4194304"));
  }
}

}  // namespace profile_import_test
}  // namespace inslab::profile_import
