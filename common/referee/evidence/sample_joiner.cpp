#include "inslab/referee/evidence/sample_joiner.hpp"

namespace inslab::evidence {

namespace {

constexpr std::size_t kPause = 4096;  // truth samples from one joining to the next
constexpr std::int64_t kStragglers_ns = 15'000'000'000;
constexpr std::int64_t kLongestWay_ns = 1'000'000'000;  // of an odometer's interval; longer ones are not weighed

/// Gives away, and forgets, what is not later than the limit.
template <class Kept, class Use>
void drain(Kept& kept, std::int64_t limit_ns, const Use& use) {
  for (auto it = kept.begin(); it != kept.end();) {
    if (it->first.second <= limit_ns) {
      use(it->first, it->second);
      it = kept.erase(it);
    } else {
      ++it;
    }
  }
}

}  // namespace

SampleJoiner::SampleJoiner(SwapWindowsOfLog& windows) : windows_(windows), next_join_(kPause) {}

void SampleJoiner::take_part(log::LogWalk& walk) {
  const auto of_sensor = [](auto& kept) {
    return [&kept](const auto& sample) { kept.emplace(Key{sample.sensor_number, sample.header.sim_time_ns}, sample); };
  };
  walk.each<TruthState>([this](const TruthState& truth) {
    truths_.emplace(Key{0, truth.header.sim_time_ns}, truth);
    if (truths_.size() < next_join_) return;
    join(false);
    next_join_ = truths_.size() + kPause;
  });
  walk.each<ImuSample>(of_sensor(samples_));
  walk.each<ImuTruth>(of_sensor(imu_truths_));
  walk.each<GnssFix>(of_sensor(fixes_));
  walk.each<MagneticField>(of_sensor(fields_));
  walk.each<AirPressure>(of_sensor(pressures_));
  walk.each<WheelTravel>(of_sensor(travels_));
  walk.each<BaselineHeading>(of_sensor(headings_));
  walk.each<Airflow>(of_sensor(airflows_));
  walk.each<AirflowTruth>(of_sensor(airflow_truths_));
}

/// Uses up what is complete; without `all` the last seconds stay, for stragglers of the other topics: what is sent
/// again to a logger that was killed comes seconds late.
void SampleJoiner::join(bool all) {
  if (truths_.empty()) return;
  const std::int64_t limit_ns = truths_.rbegin()->first.second - (all ? 0 : kStragglers_ns);
  drain(samples_, limit_ns, [this](const Key& key, const ImuSample& sample) {
    const auto perfect = imu_truths_.find(key);
    const auto vehicle = truths_.find({0, key.second});
    if (perfect != imu_truths_.end() && vehicle != truths_.end()) {
      windows_.add(sample, perfect->second, vehicle->second);
    }
  });
  drain(fixes_, limit_ns, [this](const Key& key, const GnssFix& fix) {
    const auto vehicle = truths_.find({0, key.second});
    if (vehicle != truths_.end()) windows_.add(fix, vehicle->second);
  });
  drain(fields_, limit_ns, [this](const Key& key, const MagneticField& sample) {
    const auto vehicle = truths_.find({0, key.second});
    if (vehicle != truths_.end()) windows_.add(sample, vehicle->second);
  });
  drain(pressures_, limit_ns, [this](const Key& key, const AirPressure& sample) {
    const auto vehicle = truths_.find({0, key.second});
    if (vehicle != truths_.end()) windows_.add(sample, vehicle->second);
  });
  drain(travels_, limit_ns, [this](const Key&, const WheelTravel& sample) {
    const std::vector<const TruthState*> way = way_of(sample);
    if (!way.empty()) windows_.add(sample, way);
  });
  drain(airflows_, limit_ns, [this](const Key& key, const Airflow& sample) {
    const auto perfect = airflow_truths_.find(key);
    const auto vehicle = truths_.find({0, key.second});
    if (perfect != airflow_truths_.end() && vehicle != truths_.end()) {
      windows_.add(sample, perfect->second, vehicle->second);
    }
  });
  drain(airflow_truths_, limit_ns, [](const Key&, const AirflowTruth&) {});
  drain(headings_, limit_ns, [this](const Key& key, const BaselineHeading& sample) {
    const auto vehicle = truths_.find({0, key.second});
    if (vehicle != truths_.end()) windows_.add(sample, vehicle->second);
  });
  drain(imu_truths_, limit_ns, [](const Key&, const ImuTruth&) {});
  // An odometer's next interval begins in what is used up.
  drain(truths_, limit_ns - kLongestWay_ns, [](const Key&, const TruthState&) {});
}

std::vector<const TruthState*> SampleJoiner::way_of(const WheelTravel& travel) const {
  const std::int64_t end_ns = travel.header.sim_time_ns;
  std::vector<const TruthState*> way;
  for (auto it = truths_.lower_bound({0, end_ns - travel.interval_ns}); it != truths_.end(); ++it) {
    const TruthState& truth = it->second;
    if (it->first.second > end_ns) break;
    const bool goes_on = way.empty() ? it->first.second == end_ns - travel.interval_ns
                                     : way.back()->header.sim_time_ns + truth.interval_ns == it->first.second;
    if (!goes_on) return {};
    way.push_back(&truth);
  }
  if (way.size() < 2 || way.back()->header.sim_time_ns != end_ns) return {};
  return way;
}

}  // namespace inslab::evidence
