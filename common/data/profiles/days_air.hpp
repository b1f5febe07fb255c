#pragma once

#include "inslab/foundation/fields/field.hpp"

namespace inslab {
inline namespace samples {

/// The air of a day beside the standard's, a part of a profile: its pressure at sea level, its temperature, and how
/// both drift with the weather.
struct DaysAir {
  double geoid_height_m = 0.0;
  double sea_level_pressure_pa = 101325.0;
  double sea_level_pressure_rate_pa_per_h = 0.0;
  double sea_level_pressure_gm_sigma_pa = 0.0;
  double sea_level_pressure_gm_correlation_time_s = 0.0;
  double temperature_deviation_deg_c = 0.0;
  double temperature_deviation_gm_sigma_deg_c = 0.0;
  double temperature_deviation_gm_correlation_time_s = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("geoid_height_m", "of mean sea level above the ellipsoid where the vehicle is").in(-200.0, 200.0),
          self.geoid_height_m);
    visit(Field("sea_level_pressure_pa", "at sim time 0; 101325 is the standard's").in(80000.0, 110000.0),
          self.sea_level_pressure_pa);
    visit(Field("sea_level_pressure_rate_pa_per_h", "how it changes with the weather").in(-5000.0, 5000.0),
          self.sea_level_pressure_rate_pa_per_h);
    visit(Field("sea_level_pressure_gm_sigma_pa", "its Gauss-Markov drift: steady-state standard deviation")
              .in(0.0, 5000.0),
          self.sea_level_pressure_gm_sigma_pa);
    visit(
        Field("sea_level_pressure_gm_correlation_time_s", "its correlation time; above 0 where sigma is").in(0.0, 1e7),
        self.sea_level_pressure_gm_correlation_time_s);
    visit(Field("temperature_deviation_deg_c", "from the standard's, the same at every height").in(-60.0, 60.0),
          self.temperature_deviation_deg_c);
    visit(Field("temperature_deviation_gm_sigma_deg_c", "its Gauss-Markov drift: steady-state standard deviation")
              .in(0.0, 5.0),
          self.temperature_deviation_gm_sigma_deg_c);
    visit(Field("temperature_deviation_gm_correlation_time_s", "its correlation time; above 0 where sigma is")
              .in(0.0, 1e7),
          self.temperature_deviation_gm_correlation_time_s);
  }
};

}  // namespace samples
}  // namespace inslab
