#pragma once

#include "inslab/data/profiles/days_air.hpp"
#include "inslab/data/profiles/time_tag_errors.hpp"
#include "inslab/data/profiles/wind_field.hpp"
#include "inslab/data/requests/profile_request.hpp"

namespace inslab {
inline namespace samples {

/// How one pressure sensor errs.
struct PressureSensorErrors {
  double scale_factor_ppm = 0.0;
  double offset_pa = 0.0;
  double white_sigma_pa = 0.0;
  double gm_sigma_pa = 0.0;
  double gm_correlation_time_s = 0.0;
  double min_pressure_pa = 0.0;
  double max_pressure_pa = 0.0;
  double quantization_pa = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("scale_factor_ppm", "shown too much").in(-5e5, 5e5), self.scale_factor_ppm);
    visit(Field("offset_pa", "shown too much").in(-1e5, 1e5), self.offset_pa);
    visit(Field("white_sigma_pa", "white noise: standard deviation of one sample").in(0.0, 1e4), self.white_sigma_pa);
    visit(Field("gm_sigma_pa", "Gauss-Markov error: steady-state standard deviation").in(0.0, 1e4), self.gm_sigma_pa);
    visit(Field("gm_correlation_time_s", "its correlation time; above 0 where sigma is").in(0.0, 1e7),
          self.gm_correlation_time_s);
    visit(Field("min_pressure_pa", "smallest that comes out").in(-2e5, 2e5), self.min_pressure_pa);
    visit(Field("max_pressure_pa", "largest that comes out; with both 0 there is no range").in(-2e5, 1e6),
          self.max_pressure_pa);
    visit(Field("quantization_pa", "of one count; 0: none").in(0.0, 1e4), self.quantization_pa);
  }
};

/// How one vane errs.
struct VaneErrors {
  double upwash = 0.0;
  double scale_factor_ppm = 0.0;
  double bias_deg = 0.0;
  double white_sigma_deg = 0.0;
  double gm_sigma_deg = 0.0;
  double gm_correlation_time_s = 0.0;
  double full_scale_deg = 0.0;
  double quantization_deg = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("upwash", "by this part the flow at the vane is steeper than the free one: 0.1 is 10 percent")
              .in(-0.9, 5.0),
          self.upwash);
    visit(Field("scale_factor_ppm", "of the vane's encoder: shown too much").in(-5e5, 5e5), self.scale_factor_ppm);
    visit(Field("bias_deg", "of the vane's mounting: shown too much").in(-45.0, 45.0), self.bias_deg);
    visit(Field("white_sigma_deg", "white noise: standard deviation of one sample").in(0.0, 45.0),
          self.white_sigma_deg);
    visit(Field("gm_sigma_deg", "Gauss-Markov error: steady-state standard deviation").in(0.0, 45.0),
          self.gm_sigma_deg);
    visit(Field("gm_correlation_time_s", "its correlation time; above 0 where sigma is").in(0.0, 1e7),
          self.gm_correlation_time_s);
    visit(Field("full_scale_deg", "largest angle that comes out, either way; 0: no limit").in(0.0, 180.0),
          self.full_scale_deg);
    visit(Field("quantization_deg", "of one count; 0: none").in(0.0, 45.0), self.quantization_deg);
  }
};

/// How one air data probe errs, and the air that it is in: topic inslab/profile/air_data_error and the files of
/// config/profiles/air_data.
struct AirDataErrorProfile {
  static constexpr ProfileKind kind = ProfileKind::AirDataError;

  SensorAddress target{SensorKind::AirData, 0};
  ProfileRequest request;
  std::string name;
  std::string source;
  DaysAir air;
  WindField wind;
  double acceptance_angle_deg = 20.0;
  double static_pressure_coefficient = 0.0;
  double pitot_time_constant_s = 0.0;
  double static_time_constant_s = 0.0;
  double drain_time_constant_s = 1.0;
  PressureSensorErrors impact_pressure;
  PressureSensorErrors static_pressure;
  double recovery_factor = 1.0;
  double temperature_offset_deg_c = 0.0;
  double temperature_white_sigma_deg_c = 0.0;
  VaneErrors angle_of_attack;
  VaneErrors angle_of_sideslip;
  TimeTagErrors time_tag;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    profile_head_fields(self, visit);
    visit(Field("source", "where the figures come from").at_most(256), self.source);
    visit(Field("air", "of the day"), self.air);
    visit(Field("wind", "and how it moves"), self.wind);
    visit(Field("acceptance_angle_deg",
                "flow this far from the tube's axis is felt in full; beyond, ever less, from abeam not at all")
              .in(0.0, 89.0),
          self.acceptance_angle_deg);
    visit(Field("static_pressure_coefficient",
                "K: the static port shows K times the dynamic pressure too much, that of the true airspeed")
              .in(-2.0, 2.0),
          self.static_pressure_coefficient);
    visit(Field("pitot_time_constant_s", "of the first-order lag of the pitot line; 0: none").in(0.0, 100.0),
          self.pitot_time_constant_s);
    visit(Field("static_time_constant_s", "of the same of the static line").in(0.0, 100.0),
          self.static_time_constant_s);
    visit(
        Field("drain_time_constant_s", "with which the pitot line empties through its drain when its mouth is blocked")
            .in(0.0, 1000.0),
        self.drain_time_constant_s);
    visit(Field("impact_pressure", "the sensor between the pitot and the static line").required(),
          self.impact_pressure);
    visit(Field("static_pressure", "the sensor of the static line"), self.static_pressure);
    visit(Field("recovery_factor", "of the temperature probe: part of the flow's heat that it feels").in(0.0, 1.0),
          self.recovery_factor);
    visit(Field("temperature_offset_deg_c", "shown too much").in(-100.0, 100.0), self.temperature_offset_deg_c);
    visit(Field("temperature_white_sigma_deg_c", "white noise: standard deviation of one sample").in(0.0, 10.0),
          self.temperature_white_sigma_deg_c);
    visit(Field("angle_of_attack", "the vane for it"), self.angle_of_attack);
    visit(Field("angle_of_sideslip", "the vane for it"), self.angle_of_sideslip);
    visit(Field("time_tag", "of the clock that tags the samples"), self.time_tag);
  }
};

}  // namespace samples
}  // namespace inslab
