#include "inslab/referee/evidence/air_data_evidence.hpp"

#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/referee/evidence/evidence_lines.hpp"

namespace inslab::evidence {
namespace {

double scaled(double scale_factor_ppm, double value) { return (1.0 + units::kPpm * scale_factor_ppm) * value; }

/// The errors of one value, in its unit.
struct Errors {
  const char* name;
  const char* unit;
  double offset;
  double white_sigma;
  double gm_sigma;
  double gm_correlation_time_s;
};

/// A count is as good as uniform noise of its width where the noise is not much narrower.
double white(double sigma, double count) { return std::hypot(sigma, count / std::sqrt(12.0)); }

Errors errors_of(const char* name, const PressureSensorErrors& sensor) {
  return {name,
          "Pa",
          sensor.offset_pa,
          white(sensor.white_sigma_pa, sensor.quantization_pa),
          sensor.gm_sigma_pa,
          sensor.gm_correlation_time_s};
}
Errors errors_of(const char* name, const VaneErrors& vane) {
  return {name,
          "deg",
          vane.bias_deg,
          white(vane.white_sigma_deg, vane.quantization_deg),
          vane.gm_sigma_deg,
          vane.gm_correlation_time_s};
}
std::vector<Errors> errors_of(const AirDataErrorProfile& profile) {
  return {errors_of("impact pressure", profile.impact_pressure), errors_of("static pressure", profile.static_pressure),
          errors_of("angle of attack", profile.angle_of_attack)};
}

}  // namespace

Vector3 left_of_airflow(const Airflow& sample, const AirflowTruth& perfect, const AirDataErrorProfile& errors) {
  const auto at_the_sensor = [](double true_pa, const PressureErrorBudget& budget) {
    return true_pa + budget.probe + budget.position + budget.line;
  };
  const double impact_pa = at_the_sensor(perfect.impact_pressure_pa, perfect.impact_pressure_error);
  const double static_pa = at_the_sensor(perfect.static_pressure_pa, perfect.static_pressure_error);
  const VaneErrors& vane = errors.angle_of_attack;
  const double turned_rad = scaled(vane.scale_factor_ppm, (1.0 + vane.upwash) * perfect.angle_of_attack_rad);
  return {sample.impact_pressure_pa - scaled(errors.impact_pressure.scale_factor_ppm, impact_pa),
          sample.static_pressure_pa - scaled(errors.static_pressure.scale_factor_ppm, static_pa),
          units::kDegPerRad * (sample.angle_of_attack_rad - turned_rad)};
}

std::vector<EvidenceLine> air_data_lines(const LogSummary& summary, const SwapWindows& swap, double period_s) {
  const auto errors_in = [&](const SwapWindow& window) {
    return errors_of(profile_in_use<AirDataErrorProfile>(summary, swap.ack.target, window.after_ns + 1));
  };
  const std::vector<Errors> before = errors_in(swap.before), after = errors_in(swap.after);
  std::vector<EvidenceLine> lines;
  for (int value = 0; value < 3; ++value) {
    const auto i = static_cast<std::size_t>(value);
    const auto noise = [&](const Errors& errors) {
      const Vector3 only = Vector3::UnitX();
      return promised_difference_sigma(errors.white_sigma * only, errors.gm_sigma * only,
                                       Vector3::Constant(errors.gm_correlation_time_s), period_s, only);
    };
    const auto standing = [&](const SwapWindow& window, const Errors& errors) {
      constexpr double kRounding = 1e-6;
      const double error =
          std::hypot(errors.white_sigma / std::sqrt(static_cast<double>(window.airflow.count())), errors.gm_sigma);
      return judged(window.airflow.mean()[value], errors.offset, 4.0 * error + kRounding);
    };
    const std::string name = before[i].name;
    lines.push_back(fix_line((name + " noise").c_str(), before[i].unit, swap.before.airflow, swap.after.airflow,
                             noise(before[i]), noise(after[i]), Vector3::Unit(value)));
    lines.push_back(
        {name + " offset", before[i].unit, standing(swap.before, before[i]), standing(swap.after, after[i])});
  }
  return lines;
}

}  // namespace inslab::evidence
