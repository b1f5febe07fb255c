#pragma once

#include <optional>
#include <vector>

#include "inslab/data/samples/air_pressure.hpp"
#include "inslab/data/samples/wheel_travel.hpp"
#include "inslab/models/barometer/static_port.hpp"
#include "inslab/models/odometer/wheel_contact.hpp"
#include "inslab/referee/evidence/log_summary.hpp"

namespace inslab::evidence {

/// The profile of that kind which a sensor has at a sim time; the default where it has none.
template <class Profile>
Profile profile_in_use(const LogSummary& summary, const SensorAddress& sensor, std::int64_t sim_time_ns) {
  const catalog::AnyProfile* profile = summary.in_use(Profile::kind, sensor, sim_time_ns);
  return profile ? std::get<Profile>(*profile) : Profile{};
}

/// What one barometer would show under the profiles in use, without noise, offset, range and the drifts of the air. It
/// goes on from sample to sample as the lag does.
class PressureExpectation {
 public:
  /// Of a sample and the vehicle's truth at its time, Pa.
  double pressure_pa(const AirPressure& sample, const TruthState& vehicle, const LogSummary& summary);

 private:
  std::optional<BarometerRevisions> revisions_;
  barometer::StaticPort port_;
};

/// The same of an odometer: the distance without noise, counts and all of the scale factor but the tyre's warming.
class WayExpectation {
 public:
  /// Of a sample and the truth of its interval, from its beginning on, m.
  double distance_m(const WheelTravel& sample, const std::vector<const TruthState*>& way, const LogSummary& summary);

 private:
  std::optional<OdometerRevisions> revisions_;
  OdometerErrorProfile errors_;
  odometer::WheelContact contact_;
};

}  // namespace inslab::evidence
