#pragma once

#include "inslab/data/profiles/time_tag_errors.hpp"
#include "inslab/data/requests/profile_request.hpp"

namespace inslab {
inline namespace samples {

/// How one barometer errs, and the air that it is in: topic inslab/profile/barometer_error and the files of
/// config/profiles/barometer.
struct BarometerErrorProfile {
  static constexpr ProfileKind kind = ProfileKind::BarometerError;

  SensorAddress target{SensorKind::Barometer, 0};
  ProfileRequest request;
  std::string name;
  std::string source;
  double geoid_height_m = 0.0;
  double sea_level_pressure_pa = 101325.0;
  double sea_level_pressure_rate_pa_per_h = 0.0;
  double sea_level_pressure_gm_sigma_pa = 0.0;
  double sea_level_pressure_gm_correlation_time_s = 0.0;
  double temperature_deviation_deg_c = 0.0;
  double temperature_deviation_gm_sigma_deg_c = 0.0;
  double temperature_deviation_gm_correlation_time_s = 0.0;
  double static_pressure_coefficient = 0.0;
  double time_constant_s = 0.0;
  double offset_pa = 0.0;
  double white_sigma_pa = 0.0;
  double gm_sigma_pa = 0.0;
  double gm_correlation_time_s = 0.0;
  double min_pressure_pa = 0.0;
  double max_pressure_pa = 0.0;
  double quantization_pa = 0.0;
  double temperature_offset_deg_c = 0.0;
  double temperature_white_sigma_deg_c = 0.0;
  double temperature_quantization_deg_c = 0.0;
  TimeTagErrors time_tag;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    profile_head_fields(self, visit);
    visit(Field("source", "where the figures come from").at_most(256), self.source);
    visit(Field("geoid_height_m", "of mean sea level above the ellipsoid where the vehicle is").in(-200.0, 200.0),
          self.geoid_height_m);
    visit(Field("sea_level_pressure_pa", "of the air at sim time 0; 101325 is the standard's").in(80000.0, 110000.0),
          self.sea_level_pressure_pa);
    visit(Field("sea_level_pressure_rate_pa_per_h", "how it changes with the weather").in(-5000.0, 5000.0),
          self.sea_level_pressure_rate_pa_per_h);
    visit(Field("sea_level_pressure_gm_sigma_pa", "its Gauss-Markov drift: steady-state standard deviation")
              .in(0.0, 5000.0),
          self.sea_level_pressure_gm_sigma_pa);
    visit(
        Field("sea_level_pressure_gm_correlation_time_s", "its correlation time; above 0 where sigma is").in(0.0, 1e7),
        self.sea_level_pressure_gm_correlation_time_s);
    visit(Field("temperature_deviation_deg_c", "of the air from the standard's, the same at every height")
              .in(-60.0, 60.0),
          self.temperature_deviation_deg_c);
    visit(Field("temperature_deviation_gm_sigma_deg_c", "its Gauss-Markov drift: steady-state standard deviation")
              .in(0.0, 5.0),
          self.temperature_deviation_gm_sigma_deg_c);
    visit(Field("temperature_deviation_gm_correlation_time_s", "its correlation time; above 0 where sigma is")
              .in(0.0, 1e7),
          self.temperature_deviation_gm_correlation_time_s);
    visit(Field("static_pressure_coefficient",
                "K: the port shows K times the dynamic pressure too much, that of the speed over ground in still air")
              .in(-2.0, 2.0),
          self.static_pressure_coefficient);
    visit(Field("time_constant_s", "of the first-order lag of port and filter; 0: none").in(0.0, 100.0),
          self.time_constant_s);
    visit(Field("offset_pa", "shown too much").in(-1e5, 1e5), self.offset_pa);
    visit(Field("white_sigma_pa", "white noise: standard deviation of one sample").in(0.0, 1e4).required(),
          self.white_sigma_pa);
    visit(Field("gm_sigma_pa", "Gauss-Markov error: steady-state standard deviation").in(0.0, 1e4), self.gm_sigma_pa);
    visit(Field("gm_correlation_time_s", "its correlation time; above 0 where sigma is").in(0.0, 1e7),
          self.gm_correlation_time_s);
    visit(Field("min_pressure_pa", "smallest pressure that comes out").in(0.0, 2e5), self.min_pressure_pa);
    visit(Field("max_pressure_pa", "largest pressure that comes out; 0: no limit").in(0.0, 1e6), self.max_pressure_pa);
    visit(Field("quantization_pa", "pressure of one count; 0: none").in(0.0, 1e4), self.quantization_pa);
    visit(Field("temperature_offset_deg_c", "how much warmer than the air the sensor is").in(-100.0, 100.0),
          self.temperature_offset_deg_c);
    visit(Field("temperature_white_sigma_deg_c", "white noise: standard deviation of one sample").in(0.0, 10.0),
          self.temperature_white_sigma_deg_c);
    visit(Field("temperature_quantization_deg_c", "temperature of one count; 0: none").in(0.0, 10.0),
          self.temperature_quantization_deg_c);
    visit(Field("time_tag", "of the clock that tags the samples").appended(), self.time_tag);
  }
};

}  // namespace samples
}  // namespace inslab
