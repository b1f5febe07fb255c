#pragma once

#include "inslab/data/profiles/solution_rung.hpp"
#include "inslab/data/profiles/time_tag_errors.hpp"
#include "inslab/data/requests/profile_request.hpp"

namespace inslab {
inline namespace samples {

/// The errors of the second antenna's position relative to the first one's, north, east, down: white noise, and
/// first-order Gauss-Markov processes (multipath) whose sigma is the steady-state standard deviation.
struct BaselineErrors {
  Vector3 relative_sigma_ned_m = Vector3::Zero();
  Vector3 relative_gm_sigma_ned_m = Vector3::Zero();
  Vector3 relative_gm_correlation_time_s = Vector3::Zero();

  /// Of both together.
  Vector3 relative_total_sigma_ned_m() const {
    return (relative_sigma_ned_m.cwiseAbs2() + relative_gm_sigma_ned_m.cwiseAbs2()).cwiseSqrt();
  }

  /// Listed by the structs that are a kind of solution.
  template <class Self, class Visitor>
  static void error_fields(Self& self, Visitor& visit) {
    visit(Field("relative_sigma_ned_m",
                "white noise of the second antenna's position relative to the first: standard deviation north, east, "
                "down; over the baseline's length it is that of heading and pitch")
              .in(0.0, 100.0)
              .required(),
          self.relative_sigma_ned_m);
    visit(Field("relative_gm_sigma_ned_m", "Gauss-Markov error of the same, multipath: steady-state standard deviation")
              .in(0.0, 100.0),
          self.relative_gm_sigma_ned_m);
    visit(Field("relative_gm_correlation_time_s", "its correlation time; above 0 where sigma is").in(0.0, 1e7),
          self.relative_gm_correlation_time_s);
  }
};

/// A solution of the baseline worse than the profile's own.
struct LesserBaseline : SolutionRung, BaselineErrors {
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    SolutionRung::rung_fields(self, visit);
    BaselineErrors::error_fields(self, visit);
  }
};

/// How one receiver with two antennas errs: topic inslab/profile/heading_error and the files of
/// config/profiles/heading.
struct HeadingErrorProfile : BaselineErrors {
  static constexpr ProfileKind kind = ProfileKind::HeadingError;

  SensorAddress target{SensorKind::Heading, 0};
  ProfileRequest request;
  std::string name;
  std::string source;
  FixType fix_type = FixType::Fixed;
  std::vector<LesserBaseline> lesser_solutions;
  double mean_time_between_wrong_fixes_s = 0.0;
  double wrong_fix_lasts_s = 0.0;
  double wrong_fix_offset_m = 0.0;
  TimeTagErrors time_tag;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    profile_head_fields(self, visit);
    visit(Field("source", "where the figures come from").at_most(256), self.source);
    visit(Field("fix_type", "what the receiver claims of the baseline at its best"), self.fix_type);
    BaselineErrors::error_fields(self, visit);
    visit(Field("lesser_solutions", "worse ones that come after an outage and at random, from the worst up").at_most(4),
          self.lesser_solutions);
    visit(Field("mean_time_between_wrong_fixes_s",
                "mean of the exponential time until carrier phases are fixed to wrong whole numbers; 0: never")
              .in(0.0, 1e7),
          self.mean_time_between_wrong_fixes_s);
    visit(Field("wrong_fix_lasts_s", "until the receiver notices, or its fix is lost").in(0.0, 1e6),
          self.wrong_fix_lasts_s);
    visit(Field("wrong_fix_offset_m",
                "by so much, in a direction drawn anew each time, the second antenna is taken to be elsewhere; the "
                "claimed sigma stays")
              .in(0.0, 100.0),
          self.wrong_fix_offset_m);
    visit(Field("time_tag", "of the clock that tags the samples"), self.time_tag);
  }
};

}  // namespace samples
}  // namespace inslab
