#include "inslab/referee/navigate/offline_filter.hpp"

#include "inslab/data/catalog/topics.hpp"
#include "inslab/data/samples/nav_state.hpp"
#include "inslab/formats/log/log_topic.hpp"
#include "inslab/formats/recordings/gnss_text.hpp"
#include "inslab/formats/recordings/imu_text.hpp"
#include "inslab/foundation/files/input_limits.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::navigate {

namespace {

/// A position of the 7-column text; it has no velocity, which a sigma of 0 says.
GnssFix fix_of(const recordings::GnssTextRecord& record) {
  GnssFix fix;
  fix.header.sim_time_ns = record.in_week.count();
  fix.available_sim_time_ns = fix.header.sim_time_ns;
  fix.fix_type = FixType::Single;
  fix.latitude_rad = record.position.latitude_rad;
  fix.longitude_rad = record.position.longitude_rad;
  fix.height_m = record.position.height_m;
  fix.position_sigma_ned_m = record.sigma_ned_m;
  return fix;
}

bool navigates(const NavSolution& solution) {
  return solution.mode == NavMode::Navigating || solution.mode == NavMode::Coasting;
}

}  // namespace

OfflineFilter::OfflineFilter(const navigation::AppSetup& setup, const std::vector<GnssFix>& fixes)
    : navigator_(setup.parameters, setup.gravity) {
  for (const GnssFix& fix : fixes) navigator_.add(fix);
}

void OfflineFilter::start_at(const ImuTruth& truth) {
  starts_at_ns_ = truth.header.sim_time_ns;
  navigator_.start(nav_state(truth), *starts_at_ns_);
}

std::optional<NavSolution> OfflineFilter::take(const ImuSample& sample) {
  if (starts_at_ns_ && sample.header.sim_time_ns <= *starts_at_ns_) return std::nullopt;
  navigator_.add(sample);
  const auto step = navigator_.step();
  return step && step->solution && navigates(*step->solution) ? step->solution : std::nullopt;
}

OfflineFilter filter_with_streams_of(const mcap::McapReader& log, const navigation::AppSetup& setup) {
  std::vector<GnssFix> fixes;
  log::for_each_sample<GnssFix>(log, catalog::stream_topic<GnssFix>(setup.app.gnss),
                                [&](const GnssFix& fix, std::uint64_t) {
                                  fixes.push_back(fix);
                                  return true;
                                });
  OfflineFilter filter(setup, fixes);
  for_each(scenario::AidKinds{}, [&](auto tag) {
    using Kind = typename decltype(tag)::type;
    using Sample = catalog::FirstSampleOf<Kind>;
    scenario::for_each_of_the_app<Kind>(setup.app, [&](std::string_view, std::uint32_t number) {
      const std::string topic = catalog::stream_topic<Sample>(number);
      log::for_each_sample<Sample>(log, topic, [&](const Sample& sample, std::uint64_t) {
        filter.add(sample);
        return true;
      });
    });
  });
  return filter;
}

ImuTruth first_true_state(const mcap::McapReader& log, std::uint32_t imu_number) {
  std::optional<ImuTruth> first;
  const std::string topic = catalog::stream_topic<ImuTruth>(imu_number);
  log::for_each_sample<ImuTruth>(log, topic, [&](const ImuTruth& truth, std::uint64_t) {
    first = truth;
    return false;
  });
  if (!first) throw files::ReadError(log.path() + ": " + topic + " is empty; expected a true state to start at");
  return *first;
}

OfflineFilter filter_with_fixes_of(const std::string& gnss_text, const std::string& imu_text,
                                   const navigation::AppSetup& setup) {
  std::vector<GnssFix> fixes;
  recordings::GnssTextReader reader(gnss_text);
  for (recordings::GnssTextRecord record; reader.next(record);) {
    if (fixes.size() == files::kMaxRowsInMemory) {
      throw files::ReadError(gnss_text + ": has more than " + std::to_string(fixes.size()) +
                             " rows; expected at most that");
    }
    fixes.push_back(fix_of(record));
  }
  if (fixes.empty()) throw files::ReadError(gnss_text + ": has no fix; expected at least one line of 7 numbers");
  std::int64_t imu_from_ns = 0, imu_to_ns = 0;
  for_each_text_sample(imu_text, 0, [&](const ImuSample& sample) {
    if (imu_from_ns == 0) imu_from_ns = sample.header.sim_time_ns - sample.interval_ns;
    imu_to_ns = sample.header.sim_time_ns;
  });
  // Each file counts from the week of its own first line; one of them may begin just after the week's end.
  constexpr std::int64_t kWeek_ns = std::chrono::nanoseconds(files::SecondsOfWeek::kWeek).count();
  const std::int64_t apart_ns = imu_from_ns - fixes.front().header.sim_time_ns;
  const std::int64_t shift_ns = std::abs(apart_ns) > kWeek_ns / 2 ? (apart_ns > 0 ? kWeek_ns : -kWeek_ns) : 0;
  for (GnssFix& fix : fixes) {
    fix.header.sim_time_ns += shift_ns;
    fix.available_sim_time_ns += shift_ns;
  }
  const std::int64_t gnss_from_ns = fixes.front().header.sim_time_ns, gnss_to_ns = fixes.back().header.sim_time_ns;
  if (gnss_from_ns > imu_to_ns || gnss_to_ns < imu_from_ns) {
    const auto span = [](std::int64_t from_ns, std::int64_t to_ns) {
      return std::to_string(time::to_seconds(from_ns)) + " to " + std::to_string(time::to_seconds(to_ns)) + " s";
    };
    throw files::ReadError(gnss_text + ": lasts from " + span(gnss_from_ns, gnss_to_ns) + " of the GPS week, " +
                           imu_text + " from " + span(imu_from_ns, imu_to_ns) +
                           ": they do not meet; expected one time base in both");
  }
  return {setup, fixes};
}

void for_each_text_sample(const std::string& imu_text, std::uint32_t gps_week,
                          const std::function<void(const ImuSample&)>& visit) {
  recordings::ImuTextReader reader(imu_text);
  std::optional<time::Nanoseconds> before;
  ImuSample sample;
  for (recordings::ImuTextRecord record; reader.next(record); before = record.in_week) {
    if (!before) continue;
    sample.interval_ns = (record.in_week - *before).count();
    sample.header.sim_time_ns = record.in_week.count();
    sample.header.gps_time_of_week_ns = (record.in_week % files::SecondsOfWeek::kWeek).count();
    sample.available_sim_time_ns = sample.header.sim_time_ns;
    sample.header.gps_week = gps_week + static_cast<std::uint32_t>(record.in_week / files::SecondsOfWeek::kWeek);
    sample.header.sequence_number += 1;
    sample.dtheta_b = record.dtheta_b;
    sample.dv_b = record.dv_b;
    visit(sample);
  }
  if (sample.header.sequence_number == 0) {
    throw files::ReadError(imu_text + ": has no interval; expected at least two lines of 7 numbers");
  }
}

}  // namespace inslab::navigate
