#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "inslab/foundation/fields/field.hpp"

namespace inslab::streams {

/// Who a process of a set is and what it was given. It stands in the announcement of its DDS participant, so that
/// everybody knows it before its first sample: services compare it at the start, and again where a stream changes its
/// writer. Knows no bus.
struct Identity {
  std::string service;
  std::uint32_t sensor_number = 0;
  std::string unit;  ///< empty: none
  std::string host;
  std::string process_space;  ///< where the process id counts, see foundation/host/host.hpp
  std::uint32_t pid = 0;
  std::uint64_t started_ticks = 0;     ///< with the process id it is one process for ever
  std::int64_t since_realtime_ns = 0;  ///< CLOCK_REALTIME
  std::string version;                 ///< of the product; empty: goes along with any
  std::string scenario;                ///< its name
  std::string scenario_hash;           ///< of the scenario and all that it names; empty: has none
  RunId run_id;                        ///< the one run that it obeys; zero: that of the server it finds

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("service").at_most(32), self.service);
    visit(Field("sensor_number"), self.sensor_number);
    visit(Field("unit").at_most(64), self.unit);
    visit(Field("host").at_most(64), self.host);
    visit(Field("process_space").at_most(64), self.process_space);
    visit(Field("pid"), self.pid);
    visit(Field("started_ticks"), self.started_ticks);
    visit(Field("since_realtime_ns"), self.since_realtime_ns);
    visit(Field("version").at_most(32), self.version);
    visit(Field("scenario").at_most(64), self.scenario);
    visit(Field("scenario_hash").at_most(64), self.scenario_hash);
    visit(Field("run_id"), self.run_id);
  }

  std::pair<std::string, std::uint32_t> role() const { return {service, sensor_number}; }
};

/// As bytes for an announcement.
std::vector<std::uint8_t> announced(const Identity& identity);
/// Out of an announcement; nothing when it is not one of this version's.
std::optional<Identity> identity_in(const std::vector<std::uint8_t>& announcement);

/// "inslab-imu-injector 0 (host bench, process 4711, since 2026-11-29 08:12:11 UTC, scenario 'demo')"
std::string words_of(const Identity& identity);

/// What another process of a unit must have in common with this one and has not; empty when they belong together. Who
/// has no scenario of its own goes along with any.
std::string difference(const Identity& own, const Identity& other);

/// Whether a process that begins must leave its place to another one of the same role: always, but of two that begin
/// together the first stays. Clocks of hosts that are not synchronised decide only that.
bool must_yield(const Identity& beginning, const Identity& other);

}  // namespace inslab::streams
