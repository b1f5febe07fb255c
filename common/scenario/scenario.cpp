#include "scenario/scenario.hpp"

#include <set>
#include <stdexcept>

#include "time/rate.hpp"

namespace inslab::scenario {

namespace {

std::string at(const char* list, std::size_t index, const char* key) {
  return std::string(list) + "[" + std::to_string(index) + "]." + key;
}

/// Periods divide, numbers are given once.
template <class Sensor>
std::optional<Violation> sensors_violation(const char* list, const std::vector<Sensor>& sensors, const time::Rate& truth) {
  std::set<std::uint32_t> numbers;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    if (!numbers.insert(sensors[i].number).second) {
      return Violation{at(list, i, "number"), "is " + std::to_string(sensors[i].number) + ", which another sensor has"};
    }
    try {
      (void)time::Rate(sensors[i].rate_hz).multiple_of(truth);
    } catch (const std::invalid_argument& error) {
      return Violation{at(list, i, "rate_hz"), error.what()};
    }
  }
  return std::nullopt;
}

bool has_sensor(const Scenario& scenario, SensorKind kind, std::uint32_t number) {
  const auto has = [number](const auto& sensors) {
    for (const auto& sensor : sensors) {
      if (sensor.number == number) return true;
    }
    return false;
  };
  return kind == SensorKind::Imu ? has(scenario.imu) : has(scenario.gnss);
}

std::optional<Violation> swaps_violation(const Scenario& scenario) {
  for (std::size_t i = 0; i < scenario.swaps.size(); ++i) {
    const ScheduledSwap& swap = scenario.swaps[i];
    if (!has_sensor(scenario, swap.sensor_kind, swap.sensor_number)) {
      return Violation{at("swaps", i, "sensor_number"), "names " + sensor_name({swap.sensor_kind, swap.sensor_number}) +
                                                            ", which the scenario does not have"};
    }
    if (swap.at_s >= scenario.duration_s) {
      return Violation{at("swaps", i, "at_s"), "lies at or after the end of the scenario"};
    }
    if (i > 0 && swap.at_s < scenario.swaps[i - 1].at_s) {
      return Violation{at("swaps", i, "at_s"), "lies before the swap above it; expected swaps in order of time"};
    }
    if (swap.fade_s > 0.0 && swap.kind != ProfileKind::Vibration) {
      return Violation{at("swaps", i, "fade_s"), "is set; only vibration fades"};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Violation> violation(const Scenario& scenario) {
  std::optional<time::Rate> truth;
  try {
    truth.emplace(scenario.truth_rate_hz);
  } catch (const std::invalid_argument& error) {
    return Violation{"truth_rate_hz", error.what()};
  }
  if (time::from_seconds(scenario.duration_s) < truth->period()) {
    return Violation{"duration_s", "is shorter than one period of the truth"};
  }
  if (scenario.start.at == StartAt::GpsTime && scenario.start.gps_seconds_of_week_s >= 604800.0) {
    return Violation{"start.gps_seconds_of_week_s", "is 604800; expected less than a week"};
  }
  if (auto broken = violation(scenario.trajectory)) {
    return Violation{"trajectory." + broken->path, broken->reason};
  }
  if (auto broken = sensors_violation("imu", scenario.imu, *truth)) return broken;
  if (auto broken = sensors_violation("gnss", scenario.gnss, *truth)) return broken;
  for (std::size_t i = 0; i < scenario.gnss.size(); ++i) {
    if (scenario.gnss[i].error_profile.empty()) return Violation{at("gnss", i, "error_profile"), "is empty"};
  }
  return swaps_violation(scenario);
}

}  // namespace inslab::scenario
