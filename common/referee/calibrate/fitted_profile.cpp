#include "inslab/referee/calibrate/fitted_profile.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "inslab/data/catalog/profile_rules.hpp"
#include "inslab/foundation/fields/limits.hpp"
#include "inslab/foundation/text/shown.hpp"
#include "inslab/foundation/units/units.hpp"

namespace inslab::calibrate {
namespace {

/// The member of a triad's errors that a parameter goes to.
template <class Errors>
Vector3& member(Errors& errors, allan::Parameter parameter) {
  constexpr bool is_gyro = std::is_same_v<Errors, GyroErrors>;
  switch (parameter) {
    case allan::Parameter::White:
      if constexpr (is_gyro)
        return errors.arw_deg_per_sqrt_h;
      else
        return errors.vrw_m_per_s_per_sqrt_h;
    case allan::Parameter::Quantization:
      if constexpr (is_gyro)
        return errors.quantization_arcsec;
      else
        return errors.quantization_m_per_s;
    case allan::Parameter::Flicker:
      if constexpr (is_gyro)
        return errors.bias_instability_deg_per_h;
      else
        return errors.bias_instability_mgal;
    case allan::Parameter::RandomWalk:
      if constexpr (is_gyro)
        return errors.bias_random_walk_deg_per_h_per_sqrt_h;
      else
        return errors.bias_random_walk_mgal_per_sqrt_h;
    case allan::Parameter::GmSigma:
      if constexpr (is_gyro)
        return errors.bias_gm_sigma_deg_per_h;
      else
        return errors.bias_gm_sigma_mgal;
    case allan::Parameter::GmCorrelationTime:
      break;
  }
  return errors.bias_gm_correlation_time_s;
}

template <class Errors>
void take(const AxisAnalysis& axis, bool is_error, Errors& errors) {
  const auto place = static_cast<Eigen::Index>(axis.axis % 3);
  for (const FittedParameter& fitted : axis.parameters) {
    member(errors, fitted.parameter)[place] = fitted.value / profile_unit(fitted.parameter, axis.is_gyro()).si;
  }
  if (!is_error) return;
  if constexpr (std::is_same_v<Errors, GyroErrors>) {
    errors.bias_constant_deg_per_h[place] = axis.mean / units::kDegPerH;
  } else {
    errors.bias_constant_mgal[place] = axis.mean / units::kMGal;
  }
}

}  // namespace

ProfileUnit profile_unit(allan::Parameter parameter, bool is_gyro) {
  const double count = std::sqrt(1.0 / 12.0);  // Q of one count
  switch (parameter) {
    case allan::Parameter::White:
      return is_gyro ? ProfileUnit{"arw_deg_per_sqrt_h", "deg/sqrt(h)", units::kDegPerSqrtH}
                     : ProfileUnit{"vrw_m_per_s_per_sqrt_h", "m/s/sqrt(h)", units::kMPerSPerSqrtH};
    case allan::Parameter::Quantization:
      return is_gyro ? ProfileUnit{"quantization_arcsec", "arcsec", units::kArcsec * count}
                     : ProfileUnit{"quantization_m_per_s", "m/s", count};
    case allan::Parameter::Flicker:
      return is_gyro ? ProfileUnit{"bias_instability_deg_per_h", "deg/h", units::kDegPerH}
                     : ProfileUnit{"bias_instability_mgal", "mGal", units::kMGal};
    case allan::Parameter::RandomWalk:
      return is_gyro ? ProfileUnit{"bias_random_walk_deg_per_h_per_sqrt_h", "deg/h/sqrt(h)", units::kDegPerHPerSqrtH}
                     : ProfileUnit{"bias_random_walk_mgal_per_sqrt_h", "mGal/sqrt(h)", units::kMGalPerSqrtH};
    case allan::Parameter::GmSigma:
      return is_gyro ? ProfileUnit{"bias_gm_sigma_deg_per_h", "deg/h", units::kDegPerH}
                     : ProfileUnit{"bias_gm_sigma_mgal", "mGal", units::kMGal};
    case allan::Parameter::GmCorrelationTime:
      break;
  }
  return {"bias_gm_correlation_time_s", "s", 1.0};
}

ImuErrorProfile fitted_profile(const ImuAnalysis& analysis) {
  ImuErrorProfile profile;
  const std::string file = std::filesystem::path(analysis.path).filename().string();
  profile.name = text::cut(text::shown("fit of " + file), 64);
  const std::string poor = poor_fits(analysis);
  profile.source = text::cut(
      text::shown(fmt::format("Fitted by inslab allan to {} samples at {:g} Hz of {}{}", analysis.recording.samples,
                              1.0 / analysis.recording.dt_s, file, poor.empty() ? "" : "; poor: " + poor)),
      256);
  for (const AxisAnalysis& axis : analysis.axes) {
    if (axis.is_gyro()) {
      take(axis, analysis.is_error, profile.gyro);
    } else {
      take(axis, analysis.is_error, profile.accel);
    }
  }
  auto broken = limit_violation(profile);
  if (!broken) broken = catalog::violation(profile);
  if (broken) throw std::runtime_error("the fit is no profile: " + broken->path + " " + broken->reason);
  return profile;
}

}  // namespace inslab::calibrate
