#include "inslab/scenario/scenario.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/foundation/fields/limits.hpp"
#include "inslab/foundation/text/shown.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/time/grid.hpp"
#include "inslab/nav/world_magnetic_model.hpp"
#include "inslab/scenario/waypoint_route.hpp"

namespace inslab::scenario {

namespace {

std::string at(const std::string& list, std::size_t index, const char* key) {
  return list + "[" + std::to_string(index) + "]." + key;
}

/// A rate of the scenario, and where it stands.
struct NamedRate {
  std::string path;
  double hz;
};

/// Two streams' instants coincide or keep a distance. `earlier` are the rates above this one.
std::optional<Violation> rate_violation(const NamedRate& rate, const std::vector<NamedRate>& earlier) {
  for (const NamedRate& other : earlier) {
    const double apart_ns = time::least_distance_ns(time::Rate(rate.hz), time::Rate(other.hz));
    const auto least_ns = static_cast<double>(time::Grid::kLeastApart.count());
    if (apart_ns >= least_ns) continue;
    const std::string hz = number_text(rate.hz), other_hz = number_text(other.hz);
    return Violation{Rule::SensorInstants, rate.path,
                     "is " + hz + ", and its instants come within " + number_text(std::round(10.0 * apart_ns) / 10.0) +
                         " ns of those of " + other.path + ", " + other_hz + ", without meeting them: the truth has " +
                         "a sample at each; expected at least " + number_text(least_ns) +
                         " ns: choose one rate for both, a whole multiple, or fewer digits"};
  }
  return std::nullopt;
}

/// Numbers are given once, instants are apart.
template <class Sensor>
std::optional<Violation> sensors_violation(const std::string& list, const std::vector<Sensor>& sensors,
                                           std::vector<NamedRate>& rates) {
  std::set<std::uint32_t> numbers;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    if (!numbers.insert(sensors[i].number).second) {
      return Violation{Rule::SensorNumberOnce, at(list, i, "number"),
                       "is " + std::to_string(sensors[i].number) + ", which another sensor has"};
    }
    const NamedRate rate{at(list, i, "rate_hz"), sensors[i].rate_hz};
    if (auto broken = rate_violation(rate, rates)) return broken;
    rates.push_back(rate);
  }
  return std::nullopt;
}

/// Receivers alone: outages by time and by place.
template <class Receiver>
std::optional<Violation> outages_violation(const Receiver& sensor, const std::string& path) {
  for (std::size_t i = 0; i < sensor.outages.size(); ++i) {
    const Outage& outage = sensor.outages[i];
    if (outage.period_s != 0.0 && !(outage.period_s > outage.duration_s)) {
      return Violation{Rule::OutagePeriod, path + at("outages", i, "period_s"),
                       "is not above duration_s; expected 0, or an outage that ends before it comes again"};
    }
  }
  for (std::size_t i = 0; i < sensor.outage_areas.size(); ++i) {
    const std::vector<GroundPoint>& points = sensor.outage_areas[i].path;
    const std::string name = path + at("outage_areas", i, "path");
    if (points.empty()) return Violation{Rule::OutagePath, name, "is empty; expected a point or more"};
    for (std::size_t k = 1; k < points.size(); ++k) {
      const double leg_m = (ground_point_e(points[k]) - ground_point_e(points[k - 1])).norm();
      if (leg_m > kMaxOutageLegM) {
        return Violation{Rule::OutagePath, name + "[" + std::to_string(k) + "]",
                         "lies " + std::to_string(leg_m) + " m from the point before it; expected at most 10 km"};
      }
    }
  }
  return std::nullopt;
}

/// Topics on which a foreign reader can be demanded: the truth, and those of the scenario's sensors.
bool is_stream(const Scenario& scenario, const std::string& topic) {
  bool is_one = topic == catalog::kTruth.name;
  for_each_sensor(scenario, [&](auto kind, const auto& sensor) {
    for_each(catalog::SamplesOf<typename decltype(kind)::type>{}, [&](auto sample) {
      is_one = is_one || topic == catalog::stream_topic<typename decltype(sample)::type>(sensor.number);
    });
  });
  return is_one;
}

bool has_sensor(const Scenario& scenario, const SensorAddress& address) {
  bool has = false;
  for_each_sensor(scenario, [&](auto kind, const auto& sensor) {
    has = has || SensorAddress{decltype(kind)::type::kind, sensor.number} == address;
  });
  return has;
}

/// The name becomes that of the run's log, so it must not lead elsewhere or hide the file.
std::optional<Violation> name_violation(const std::string& name) {
  const auto fits = [](unsigned char c) {
    return c >= 0x80 || std::isalnum(c) || c == '_' || c == '-' || c == '.' || c == ' ';
  };
  const bool is_safe = !name.empty() && name.front() != '.' && std::all_of(name.begin(), name.end(), fits);
  if (is_safe && text::is_plain(name)) return std::nullopt;
  return Violation{
      Rule::RunName, "name",
      "is " + text::quoted(name) +
          "; expected letters of any script, digits, spaces and _-. with no dot at the beginning: it names "
          "the log"};
}

/// Where the vehicle is after the last waypoint can be said only when it stands there.
std::optional<Violation> route_violation(const Scenario& scenario) {
  const std::vector<Waypoint>& waypoints = scenario.trajectory.waypoints;
  if (scenario.trajectory.source != TrajectorySource::Waypoints || waypoints.back().speed_m_per_s == 0.0) {
    return std::nullopt;
  }
  const double end_s = time::to_seconds(WaypointRoute(waypoints, route_options(scenario.trajectory)).duration());
  if (scenario.duration_s <= end_s) return std::nullopt;
  return Violation{Rule::RouteCoversRun, "duration_s",
                   "lies after the last waypoint, which the vehicle passes in motion at " + std::to_string(end_s) +
                       " s; expected an earlier end, or a last speed of 0"};
}

/// What can be wrong with a list of swaps whatever the scenario.
std::optional<Violation> list_violation(const std::vector<ScheduledSwap>& swaps) {
  for (std::size_t i = 0; i < swaps.size(); ++i) {
    const ScheduledSwap& swap = swaps[i];
    if (!catalog::takes_profile(swap.sensor_kind, swap.kind)) {
      return Violation{Rule::ProfileFitsSensor, at("swaps", i, "sensor_kind"),
                       "is " + std::string(enum_name(swap.sensor_kind)) + "; a profile of the kind " +
                           std::string(enum_name(swap.kind)) + " is for " + catalog::wearers(swap.kind)};
    }
    if (i > 0 && swap.at_s < swaps[i - 1].at_s) {
      return Violation{Rule::SwapsInOrder, at("swaps", i, "at_s"),
                       "lies before the swap above it; expected swaps in order of time"};
    }
    if (swap.fade_s > 0.0 && swap.kind != ProfileKind::Vibration) {
      return Violation{Rule::OnlyVibrationFades, at("swaps", i, "fade_s"), "is set; only vibration fades"};
    }
  }
  return std::nullopt;
}

std::optional<Violation> swaps_violation(const Scenario& scenario) {
  for (std::size_t i = 0; i < scenario.swaps.size(); ++i) {
    const ScheduledSwap& swap = scenario.swaps[i];
    if (!has_sensor(scenario, {swap.sensor_kind, swap.sensor_number})) {
      return Violation{Rule::SensorExists, at("swaps", i, "sensor_number"),
                       "names " + catalog::sensor_name({swap.sensor_kind, swap.sensor_number}) +
                           ", which the scenario does not have"};
    }
    if (swap.at_s >= scenario.duration_s) {
      return Violation{Rule::SwapBeforeEnd, at("swaps", i, "at_s"), "lies at or after the end of the scenario"};
    }
  }
  return list_violation(scenario.swaps);
}

/// The reference navigation app has its sensors, and the unit to itself.
std::optional<Violation> reference_nav_violation(const Scenario& scenario) {
  if (!scenario.reference_nav) return std::nullopt;
  std::optional<Violation> missing;
  for_each(catalog::SensorKinds{}, [&](auto tag) {
    using Kind = typename decltype(tag)::type;
    for_each_of_the_app<Kind>(*scenario.reference_nav, [&](std::string_view key, std::uint32_t number) {
      if (missing || has_sensor(scenario, {Kind::kind, number})) return;
      missing = Violation{Rule::SensorExists, "reference_nav." + std::string(key),
                          "names " + catalog::sensor_name({Kind::kind, number}) + ", which the scenario does not have"};
    });
  });
  if (missing) return missing;
  if (const ReferenceNav& app = *scenario.reference_nav; app.other_odometer && app.other_odometer == app.odometer) {
    return Violation{Rule::SensorNumberOnce, "reference_nav.other_odometer",
                     "is " + std::to_string(*app.other_odometer) +
                         ", as reference_nav.odometer; expected the odometer of the wheel across from it"};
  }
  if (!scenario.require_nav_app) return std::nullopt;
  return Violation{Rule::OneNavApp, "require_nav_app",
                   "is true beside reference_nav; expected one of them: two apps on inslab/nav cannot be told apart"};
}

/// Limits that can be judged.
std::optional<Violation> acceptance_violation(const Scenario& scenario) {
  for (std::size_t i = 0; i < scenario.acceptance.size(); ++i) {
    const AcceptanceLimit& line = scenario.acceptance[i];
    if (!line.at_most && !line.at_least) {
      return Violation{Rule::AcceptanceLimit, at("acceptance", i, "at_most"),
                       "is not given, nor is at_least; expected one of them or both"};
    }
    if (line.at_most && line.at_least && *line.at_least > *line.at_most) {
      return Violation{Rule::AcceptanceLimit, at("acceptance", i, "at_least"), "is above at_most"};
    }
    if (is_of_the_run(line.metric) && (line.phase != Phase::All || line.after_s != 0.0)) {
      return Violation{Rule::AcceptancePhase, at("acceptance", i, line.after_s != 0.0 ? "after_s" : "phase"),
                       "is set, but " + std::string(enum_name(line.metric)) + " is a figure of the whole run"};
    }
    const std::size_t swaps = line.phase == Phase::SwapInterval ? scenario.swaps.size() : 0;
    if (line.swap_interval > swaps) {
      return Violation{
          Rule::AcceptancePhase, at("acceptance", i, "swap_interval"),
          "is " + std::to_string(line.swap_interval) + "; expected at most " + std::to_string(swaps) +
              (line.phase == Phase::SwapInterval ? ", the scenario's swaps" : ": the phase is not swap_interval")};
    }
    if (is_latency(line.metric) && scenario.clock.mode == ClockMode::Lockstep) {
      return Violation{Rule::AcceptanceClock, at("acceptance", i, "metric"),
                       "is " + std::string(enum_name(line.metric)) +
                           ", but in lockstep (clock.mode) the clock waits for the app; expected real_time"};
    }
    if (line.after_s >= scenario.duration_s) {
      return Violation{Rule::AcceptancePhase, at("acceptance", i, "after_s"),
                       "lies at or after the end of the scenario"};
    }
  }
  return std::nullopt;
}

/// A start at the wall clock is for whoever runs it.
std::optional<Violation> magnetic_date_violation(const Scenario& scenario) {
  if (scenario.start.at != StartAt::GpsTime) return std::nullopt;
  using nav::WorldMagneticModel;
  const double year =
      time::decimal_year({scenario.start.gps_week, time::from_seconds(scenario.start.gps_seconds_of_week_s).count()});
  if (year >= WorldMagneticModel::kFirstYear && year < WorldMagneticModel::kLastYear) return std::nullopt;
  for (std::size_t i = 0; i < scenario.magnetometer.size(); ++i) {
    if (scenario.magnetometer[i].field != MagneticModel::Wmm2025) continue;
    return Violation{Rule::MagneticModelDate, "magnetometer[" + std::to_string(i) + "].field",
                     "is wmm2025, which is valid from 2025 to the end of 2029, and the run begins in " +
                         number_text(std::floor(year)) + "; expected a start in these years, or wmm2025_extrapolated"};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Violation> violation(const Scenario& scenario) {
  if (auto broken = name_violation(scenario.name)) return broken;
  if (time::from_seconds(scenario.duration_s) < time::Rate(scenario.truth_rate_hz).at(1)) {
    return Violation{Rule::RunLength, "duration_s", "is shorter than one period of the truth"};
  }
  if (scenario.start.at == StartAt::GpsTime && scenario.start.gps_seconds_of_week_s >= 604800.0) {
    return Violation{Rule::StartInWeek, "start.gps_seconds_of_week_s", "is 604800; expected less than a week"};
  }
  if (auto broken = magnetic_date_violation(scenario)) return broken;
  if (auto broken = violation(scenario.trajectory)) {
    return Violation{broken->rule, "trajectory." + broken->path, broken->reason};
  }
  if (scenario.trajectory.source == TrajectorySource::VehicleState &&
      (scenario.clock.mode == ClockMode::Lockstep || scenario.clock.rate != 1.0)) {
    return Violation{Rule::VehicleClock, scenario.clock.rate != 1.0 ? "clock.rate" : "clock.mode",
                     "does not fit a live vehicle (trajectory.source vehicle_state), whose states come in real time: "
                     "expected real_time at rate 1"};
  }
  if (auto broken = route_violation(scenario)) return broken;
  std::vector<NamedRate> rates{{"truth_rate_hz", scenario.truth_rate_hz}};
  std::optional<Violation> broken_sensor;
  for_each(catalog::SensorKinds{}, [&](auto tag) {
    using Kind = typename decltype(tag)::type;
    if (!broken_sensor) broken_sensor = sensors_violation(std::string(Kind::name), sensors_of<Kind>(scenario), rates);
  });
  if (broken_sensor) return broken_sensor;
  for (std::size_t i = 0; i < scenario.gnss.size(); ++i) {
    if (auto broken = outages_violation(scenario.gnss[i], at("gnss", i, ""))) return broken;
  }
  for (std::size_t i = 0; i < scenario.heading.size(); ++i) {
    if (auto broken = outages_violation(scenario.heading[i], at("heading", i, ""))) return broken;
  }
  for (std::size_t i = 0; i < scenario.require_subscribers.size(); ++i) {
    if (is_stream(scenario, scenario.require_subscribers[i].topic)) continue;
    return Violation{Rule::SubscribedTopic, at("require_subscribers", i, "topic"),
                     "is '" + scenario.require_subscribers[i].topic +
                         "'; expected inslab/truth or a topic of a sensor of the scenario"};
  }
  if (auto broken = reference_nav_violation(scenario)) return broken;
  if (auto broken = acceptance_violation(scenario)) return broken;
  return swaps_violation(scenario);
}

std::optional<Violation> violation(const Schedule& schedule) { return list_violation(schedule.swaps); }

}  // namespace inslab::scenario
