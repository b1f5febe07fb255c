#include "inslab/referee/verify/trajectory_block.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include "inslab/referee/verify/catalogue.hpp"
#include "inslab/referee/verify/ecef_reference.hpp"
#include "inslab/referee/verify/smoothness.hpp"

namespace inslab::verify {

namespace {

constexpr Real kPositionLimit_m = 1e-6L;
constexpr Real kVelocityLimit_m_per_s = 1e-8L;
constexpr Real kAttitudeLimit_deg = 1e-9L;
constexpr Real kSolversLimit_m = 1e-8L;
// The increments of a second. An attitude at its limit turns Earth rate by 1.3e-15 rad in it, to which each of 200
// samples adds the rounding of its own; and it turns the specific force by the limit times its size.
constexpr Real kDthetaLimit_rad = 1e-14L;
constexpr Real kSecondOfGravity_m_per_s = 9.8L;  // where a vehicle falls freely, rounding does not get less
constexpr Real kDvLimit_of_dv = kAttitudeLimit_deg * 3.14159265358979323846L / 180;

// A longitude is published to half a unit in the last place, 1.4e-9 m; the extrapolation adds up 16 such.
constexpr double kPositionJump_m = 3e-8;
// Of the rest, rounding is below 64 * 2e-16 of 250 m/s and 10 m/s^2; the sixth derivative of the fastest motion of the
// catalogue, bumps of 0.5 deg/s with a period of 2 s at 100 m/s, gives 1.6e-14 * 0.9 m/s^2 * pi^6 = 1e-11 m/s^2.
constexpr double kVelocityJump_m_per_s = 1e-10;
constexpr double kAttitudeJump_deg = 1e-10;
constexpr double kRateJump_deg_per_s = 1e-9;
constexpr double kSpecificForceJump_m_per_s2 = 1e-9;

/// Position RMS in m of the thesis's table 4-1; the others are not in it.
std::string thesis_position(const std::string& name) {
  static const std::map<std::string, std::string> figures{
      {"static", "0.00"}, {"basic", "0.03"}, {"vehicle", "0.07"}, {"ship", "0.06"}, {"aircraft", "0.03"}};
  const auto found = figures.find(name);
  return found == figures.end() ? "-" : found->second;
}

struct Flight {
  std::string name;
  scenario::Trajectory trajectory;
  double duration_s = 0.0;
};

/// A motor burns for 5 s, then three minutes of free flight with some drag, up to 45 km.
Flight ballistic() {
  Flight flight{"ballistic", catalogue_scenario("projectile").trajectory, 190.0};
  flight.trajectory.initial.pitch_deg = 65.0;
  scenario::Motion motor;
  motor.type = scenario::MotionType::DeltaSpeed;
  motor.speed_change_m_per_s = 950.0;
  scenario::Motion free;
  free.type = scenario::MotionType::Ballistic;
  free.drag_per_m = 2e-6;
  scenario::Segment burn, fall;
  burn.duration_s = 5.0;
  burn.motions = {motor};
  fall.duration_s = 300.0;
  fall.motions = {free};
  flight.trajectory.segments = {burn, fall};
  return flight;
}

/// A gun gives it 1e4 g for 5 ms and 20 turns a second, which the air takes away again.
Flight gun_launch() {
  Flight flight{"gun launch", catalogue_scenario("projectile").trajectory, 40.0};
  flight.trajectory.initial.speed_m_per_s = 0.0;
  flight.trajectory.initial.pitch_deg = 45.0;
  scenario::Motion charge, rifling, free;
  charge.type = scenario::MotionType::ConstantAccel;
  charge.acceleration_m_per_s2 = 98066.5;
  rifling.type = scenario::MotionType::RampRate;
  rifling.axis = scenario::Axis::X;
  rifling.to_deg_per_s = free.spin_deg_per_s = 7200.0;
  free.type = scenario::MotionType::Ballistic;
  free.drag_per_m = 1e-4;
  free.spin_decay_s = 30.0;
  scenario::Segment barrel, flies;
  barrel.duration_s = 0.005;
  barrel.motions = {charge, rifling};
  flies.duration_s = 300.0;
  flies.motions = {free};
  flight.trajectory.segments = {barrel, flies};
  return flight;
}

std::vector<Flight> flights() {
  std::vector<Flight> all;
  for (const std::string& name : catalogue()) {
    const scenario::Scenario scenario = catalogue_scenario(name);
    all.push_back({name, scenario.trajectory, scenario.duration_s});
  }
  all.push_back(ballistic());
  all.push_back(gun_launch());
  return all;
}

std::string figure(Real value) { return fmt::format("{:.1e}", static_cast<double>(value)); }

Row accuracy_row(const Flight& flight, const TruthOf& truth) {
  const Differences rms = compare_with_ecef(flight.trajectory, flight.duration_s, truth);
  const Real dv_limit_m_per_s = kDvLimit_of_dv * std::max(rms.dv_size_m_per_s, kSecondOfGravity_m_per_s);
  const std::string thesis_m = thesis_position(flight.name);
  const bool in_thesis = thesis_m != "-";
  Row row;
  row.cells = {flight.name,
               std::to_string(rms.seconds),
               figure(rms.position_m),
               thesis_m,
               figure(rms.velocity_m_per_s),
               in_thesis ? "<= 0.01" : "-",
               figure(rms.attitude_deg),
               in_thesis ? "<= 0.02" : "-",
               figure(rms.dtheta_rad),
               figure(rms.dv_m_per_s),
               figure(dv_limit_m_per_s),
               figure(rms.solvers_m)};
  row.held = rms.seconds > 0 && rms.position_m <= kPositionLimit_m && rms.velocity_m_per_s <= kVelocityLimit_m_per_s &&
             rms.attitude_deg <= kAttitudeLimit_deg && rms.dtheta_rad <= kDthetaLimit_rad &&
             rms.dv_m_per_s <= dv_limit_m_per_s && rms.solvers_m <= kSolversLimit_m;
  return row;
}

/// Nothing where no segment ends: such a row would hold whatever the truth did.
std::optional<Row> smoothness_row(const Flight& flight, const TruthOf& truth) {
  const JointJumps jumps = jumps_at_joints(flight.trajectory, flight.duration_s, truth);
  if (jumps.joints == 0) return std::nullopt;
  Row row;
  row.cells = {flight.name,
               std::to_string(jumps.joints),
               figure(jumps.position_m),
               figure(jumps.velocity_m_per_s),
               figure(jumps.attitude_deg),
               figure(jumps.rate_deg_per_s),
               figure(jumps.specific_force_m_per_s2)};
  row.held = jumps.position_m <= kPositionJump_m && jumps.velocity_m_per_s <= kVelocityJump_m_per_s &&
             jumps.attitude_deg <= kAttitudeJump_deg && jumps.rate_deg_per_s <= kRateJump_deg_per_s &&
             jumps.specific_force_m_per_s2 <= kSpecificForceJump_m_per_s2;
  return row;
}

}  // namespace

std::vector<Table> verify_trajectory(const Subjects& subjects, double longest_s) {
  Table accuracy;
  accuracy.title = "Truth of motion tables against an independent solution (thesis table 4-1)";
  accuracy.columns = {"motion", "seconds",          "position RMS m", "thesis",         "velocity RMS m/s",
                      "thesis", "attitude RMS deg", "thesis",         "dtheta RMS rad", "dv RMS m/s",
                      "limit",  "two solvers m"};
  accuracy.notes = {
      fmt::format(
          "Limits: position {:.0e} m, velocity {:.0e} m/s, attitude {:.0e} deg, the two solvers apart {:.0e} m.\n"
          "Increments of a second: dtheta {:.0e} rad; dv the attitude's limit times the specific force.",
          static_cast<double>(kPositionLimit_m), static_cast<double>(kVelocityLimit_m_per_s),
          static_cast<double>(kAttitudeLimit_deg), static_cast<double>(kSolversLimit_m),
          static_cast<double>(kDthetaLimit_rad)),
      "Reference: the same motion written in ECEF as displacement from the start, in long double, by Boost.Odeint's\n"
      "Bulirsch-Stoer and dopri5 at an absolute 1e-11 m, restarted at every corner. RMS of the norms at whole "
      "seconds.\n"
      "The thesis compared with SimGEN, over 20 minutes."};
  Table smoothness;
  smoothness.title = "Largest jumps where segments meet";
  smoothness.columns = {"motion", "joints", "position m", "velocity m/s", "attitude deg", "rate deg/s", "force m/s^2"};
  smoothness.notes = {
      fmt::format("Limits: {:.0e} m, {:.0e} m/s, {:.0e} deg, {:.0e} deg/s, {:.0e} m/s^2.", kPositionJump_m,
                  kVelocityJump_m_per_s, kAttitudeJump_deg, kRateJump_deg_per_s, kSpecificForceJump_m_per_s2),
      "Each against its polynomial through the samples before, so that what is shown without a jump is rounding.\n"
      "Rate and specific force are continuous because the catalogue leads every motion in and out by ramps."};
  for (Flight& flight : flights()) {
    flight.duration_s = std::min(flight.duration_s, longest_s);
    accuracy.rows.push_back(accuracy_row(flight, subjects.truth));
    // A free flight begins with the jump of a rate that nothing leads in.
    if (flight.name == "ballistic" || flight.name == "gun launch") continue;
    if (auto row = smoothness_row(flight, subjects.truth)) smoothness.rows.push_back(*std::move(row));
  }
  return {accuracy, smoothness};
}

}  // namespace inslab::verify
