#pragma once

#include "inslab/data/profiles/time_tag_errors.hpp"
#include "inslab/data/requests/profile_request.hpp"

namespace inslab {
inline namespace samples {

/// How one odometer errs, and the wheel that it counts: topic inslab/profile/odometer_error and the files of
/// config/profiles/odometer.
struct OdometerErrorProfile {
  static constexpr ProfileKind kind = ProfileKind::OdometerError;

  SensorAddress target{SensorKind::Odometer, 0};
  ProfileRequest request;
  std::string name;
  std::string source;
  double scale_factor_ppm = 0.0;
  double scale_factor_turn_on_sigma_ppm = 0.0;
  double scale_factor_gm_sigma_ppm = 0.0;
  double scale_factor_gm_correlation_time_s = 0.0;
  double tyre_warming_ppm = 0.0;
  double tyre_warming_time_s = 600.0;
  double noise_m_per_sqrt_m = 0.0;
  double longitudinal_slip_threshold_m_per_s2 = 0.0;
  double longitudinal_slip_s2_per_m = 0.0;
  double lateral_slip_threshold_m_per_s2 = 0.0;
  double lateral_slip_s2_per_m = 0.0;
  double counts_per_revolution = 0.0;
  double wheel_circumference_m = 2.0;
  double dead_below_m_per_s = 0.0;
  bool direction_known = true;
  TimeTagErrors time_tag;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    profile_head_fields(self, visit);
    visit(Field("source", "where the figures come from").at_most(256), self.source);
    visit(Field("scale_factor_ppm", "distance shown too much").in(-5e5, 5e5).required(), self.scale_factor_ppm);
    visit(Field("scale_factor_turn_on_sigma_ppm", "the same, drawn once a run: standard deviation").in(0.0, 1e5),
          self.scale_factor_turn_on_sigma_ppm);
    visit(Field("scale_factor_gm_sigma_ppm", "Gauss-Markov drift of tyre and load: steady-state standard deviation")
              .in(0.0, 1e5),
          self.scale_factor_gm_sigma_ppm);
    visit(Field("scale_factor_gm_correlation_time_s", "its correlation time; above 0 where sigma is").in(0.0, 1e7),
          self.scale_factor_gm_correlation_time_s);
    visit(Field("tyre_warming_ppm",
                "change of the scale factor from sim time 0 to a warm tyre: below 0, as a warm tyre is larger and "
                "turns less")
              .in(-1e5, 1e5),
          self.tyre_warming_ppm);
    visit(Field("tyre_warming_time_s", "time constant of the warming").in(1.0, 1e5), self.tyre_warming_time_s);
    visit(Field("noise_m_per_sqrt_m", "of the road: standard deviation of the error of 1 m, growing with the root")
              .in(0.0, 1.0),
          self.noise_m_per_sqrt_m);
    visit(Field("longitudinal_slip_threshold_m_per_s2", "force along the wheel, over the mass, from which it slips")
              .in(0.0, 100.0),
          self.longitudinal_slip_threshold_m_per_s2);
    visit(Field("longitudinal_slip_s2_per_m",
                "slip for each m/s^2 beyond: driven the wheel turns too much, braked too little; 0: none")
              .in(0.0, 10.0),
          self.longitudinal_slip_s2_per_m);
    visit(Field("lateral_slip_threshold_m_per_s2", "force across the wheel, over the mass, from which it slips too")
              .in(0.0, 100.0),
          self.lateral_slip_threshold_m_per_s2);
    visit(Field("lateral_slip_s2_per_m", "slip for each m/s^2 beyond, in the sense of the force along; 0: none")
              .in(0.0, 10.0),
          self.lateral_slip_s2_per_m);
    visit(Field("counts_per_revolution", "whole counts of the encoder; 0: distance without steps").in(0.0, 1e6),
          self.counts_per_revolution);
    visit(Field("wheel_circumference_m", "by which counts are made a distance").in(0.1, 20.0),
          self.wheel_circumference_m);
    visit(Field("dead_below_m_per_s", "slower than this nothing is counted, and the way is lost").in(0.0, 10.0),
          self.dead_below_m_per_s);
    visit(Field("direction_known", "false: backwards counts as forwards"), self.direction_known);
    visit(Field("time_tag", "of the clock that tags the samples").appended(), self.time_tag);
  }
};

}  // namespace samples
}  // namespace inslab
