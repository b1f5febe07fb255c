#pragma once

#include "inslab/scenario/acceptance.hpp"

namespace inslab::montecarlo {

/// A figure of docs/scoring.md that one run has.
struct RunFigure {
  scenario::Metric metric = scenario::Metric::HorizontalRms;
  scenario::Phase phase = scenario::Phase::All;
  std::uint32_t swap_interval = 0;
  double after_s = 0.0;
  double value = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("metric").required(), self.metric);
    visit(Field("phase").required(), self.phase);
    visit(Field("swap_interval").required(), self.swap_interval);
    visit(Field("after_s").required(), self.after_s);
    visit(Field("value", "in the unit of the metric").required(), self.value);
  }
};

/// The largest errors in one outage.
struct RunOutage {
  double begin_s = 0.0;
  double end_s = 0.0;
  double horizontal_m = 0.0;
  double vertical_m = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("begin_s").required(), self.begin_s);
    visit(Field("end_s").required(), self.end_s);
    visit(Field("horizontal_m").required(), self.horizontal_m);
    visit(Field("vertical_m").required(), self.vertical_m);
  }
};

/// One scored solution with what the filter believed of it. Errors are those of score::SolutionError.
struct Instant {
  std::uint32_t number = 0;  ///< of kInstants: the same in every run
  double time_s = 0.0;       ///< sim time
  Vector3 position_error_ned_m = Vector3::Zero();
  Vector3 position_sigma_ned_m = Vector3::Zero();
  Vector3 velocity_error_ned_m_per_s = Vector3::Zero();
  Vector3 velocity_sigma_ned_m_per_s = Vector3::Zero();
  Vector3 phi_ned_deg = Vector3::Zero();
  Vector3 phi_sigma_ned_deg = Vector3::Zero();
  double nees = 0.0;  ///< e^T P^-1 e of position, velocity, attitude: 9 degrees of freedom

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("number").required(), self.number);
    visit(Field("time_s").required(), self.time_s);
    visit(Field("position_error_ned_m").required(), self.position_error_ned_m);
    visit(Field("position_sigma_ned_m").required(), self.position_sigma_ned_m);
    visit(Field("velocity_error_ned_m_per_s").required(), self.velocity_error_ned_m_per_s);
    visit(Field("velocity_sigma_ned_m_per_s").required(), self.velocity_sigma_ned_m_per_s);
    visit(Field("phi_ned_deg").required(), self.phi_ned_deg);
    visit(Field("phi_sigma_ned_deg").required(), self.phi_sigma_ned_deg);
    visit(Field("nees").required(), self.nees);
  }
};

/// What became of one line of the scenario's acceptance.
struct RunVerdict {
  std::string line;
  bool judged = true;  ///< false: an offline run has no such figure
  bool passed = false;
  std::string why;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("line").at_most(1024).required(), self.line);
    visit(Field("judged").required(), self.judged);
    visit(Field("passed").required(), self.passed);
    visit(Field("why").at_most(4096).required(), self.why);
  }
};

/// The run is looked at so many times, evenly over its duration.
inline constexpr std::uint32_t kInstants = 100;

/// One run as its file says.
struct RunResult {
  std::string fingerprint;  ///< of the study
  std::uint32_t run = 0;
  std::uint64_t seed = 0;
  std::string failure;  ///< why there are no figures; empty: there are
  std::vector<RunVerdict> acceptance;
  std::vector<RunFigure> figures;
  std::vector<RunOutage> outages;
  std::vector<Instant> instants;

  bool succeeded() const { return failure.empty(); }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("fingerprint").required(), self.fingerprint);
    visit(Field("run").required(), self.run);
    visit(Field("seed").required(), self.seed);
    visit(Field("failure").at_most(4096).required(), self.failure);
    visit(Field("acceptance").at_most(256).required(), self.acceptance);
    visit(Field("figures").at_most(1000000).required(), self.figures);
    visit(Field("outages").at_most(1000000).required(), self.outages);
    visit(Field("instants").at_most(kInstants + 1).required(), self.instants);
  }
};

}  // namespace inslab::montecarlo
