#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/yaml.h>

#include <cmath>

#include "inslab/formats/profile_import/conversion.hpp"
#include "inslab/foundation/files/file_error.hpp"

namespace inslab::profile_import {
namespace {

std::string place(const std::string& file, const YAML::Mark& mark) {
  return file + ": line " + std::to_string(mark.line + 1) + ", column " + std::to_string(mark.column + 1) + ": ";
}

double number_of(const std::string& file, const std::string& key, const YAML::Node& node) {
  double value = 0.0;
  if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value) || value < 0.0) {
    throw files::ReadError(place(file, node.Mark()) + key + ": expected a finite number, 0 or above");
  }
  return value;
}

/// The section's value of that key. Throws files::ReadError when it is missing.
YAML::Node member(const std::string& file, const YAML::Node& section, const std::string& key) {
  const YAML::Node node = section[key];
  if (!node) throw files::ReadError(place(file, section.Mark()) + "imunoise has no " + key);
  return node;
}

Vector3 vector_of(const std::string& file, const YAML::Node& section, const std::string& key) {
  const YAML::Node node = member(file, section, key);
  if (!node.IsSequence() || node.size() != 3) {
    throw files::ReadError(place(file, node.Mark()) + key + ": expected a list of three numbers");
  }
  return {number_of(file, key, node[0]), number_of(file, key, node[1]), number_of(file, key, node[2])};
}

YAML::Node parsed(const std::string& file) {
  const std::string text = import_text(file);
  try {
    return YAML::Load(text);
  } catch (const YAML::DeepRecursion& error) {
    constexpr std::size_t kLevelsOfYamlCpp = 500;
    refuse_depth(file + ": line " + std::to_string(error.mark.line + 1), kLevelsOfYamlCpp);
  } catch (const YAML::Exception& error) {
    throw files::ReadError(place(file, error.mark) + "is no YAML: " + error.msg);
  }
}

}  // namespace

ImportedProfile import_kf_gins(const std::string& file, const ImportOptions&) {
  const YAML::Node root = parsed(file);
  const YAML::Node noise = root.IsMap() ? root["imunoise"] : YAML::Node(YAML::NodeType::Undefined);
  if (!noise || !noise.IsMap())
    throw files::ReadError(file + ": has no section imunoise; expected KF-GINS's configuration");

  ImportedProfile imported;
  GyroErrors& gyro = imported.profile.gyro;
  AccelErrors& accel = imported.profile.accel;
  imported.profile.source = "Imported from a configuration of KF-GINS";
  const auto take = [&](const char* key, const char* unit, const char* target, Vector3& member_value, const char* how) {
    const Vector3 value = vector_of(file, noise, key);
    member_value = value;
    imported.lines.push_back(conversion_line(std::string("imunoise.") + key, value, unit, target, value, how));
  };
  constexpr const char* kSteady = "the same; KF-GINS drives it with 2 sigma^2/T, so it is the steady-state sigma";
  take("arw", "deg/sqrt(h)", "gyro.arw_deg_per_sqrt_h", gyro.arw_deg_per_sqrt_h, "the same");
  take("vrw", "m/s/sqrt(h)", "accel.vrw_m_per_s_per_sqrt_h", accel.vrw_m_per_s_per_sqrt_h, "the same");
  take("gbstd", "deg/h", "gyro.bias_gm_sigma_deg_per_h", gyro.bias_gm_sigma_deg_per_h, kSteady);
  take("abstd", "mGal", "accel.bias_gm_sigma_mgal", accel.bias_gm_sigma_mgal, kSteady);
  take("gsstd", "ppm", "gyro.scale_factor_gm_sigma_ppm", gyro.scale_factor_gm_sigma_ppm, kSteady);
  take("asstd", "ppm", "accel.scale_factor_gm_sigma_ppm", accel.scale_factor_gm_sigma_ppm, kSteady);

  const double hours = number_of(file, "corrtime", member(file, noise, "corrtime"));
  const Vector3 seconds = Vector3::Constant(hours * 3600.0);
  for (Vector3* time_s : {&gyro.bias_gm_correlation_time_s, &accel.bias_gm_correlation_time_s,
                          &gyro.scale_factor_gm_correlation_time_s, &accel.scale_factor_gm_correlation_time_s}) {
    *time_s = seconds;
  }
  imported.lines.push_back(conversion_line("imunoise.corrtime", Vector3::Constant(hours), "h",
                                           "correlation times of both biases and scale factors, s", seconds, "x 3600"));
  imported.lines.emplace_back("init*: left out, they are where the filter begins and not how the sensor errs");
  check_imported(file, imported.profile);
  return imported;
}

}  // namespace inslab::profile_import
