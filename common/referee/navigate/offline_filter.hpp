#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "inslab/data/samples/imu_truth.hpp"
#include "inslab/formats/mcap/mcap_reader.hpp"
#include "inslab/models/navigation/app_setup.hpp"
#include "inslab/models/navigation/navigator.hpp"

namespace inslab::navigate {

/// The reference navigation filter on samples that are all there. Each fix goes in when the app of a live run would
/// have it, so the solutions are that app's.
class OfflineFilter {
 public:
  OfflineFilter(const navigation::AppSetup& setup, const std::vector<GnssFix>& fixes);

  /// A sample of another sensor that the filter takes.
  void add(const navigation::Observation& observation) { navigator_.add(observation); }

  /// Begins at the IMU's true state; samples up to then are passed over.
  void start_at(const ImuTruth& truth);

  /// The solution at the sample's end; nothing while the filter does not navigate.
  std::optional<NavSolution> take(const ImuSample& sample);

  const navigation::NavigationFilter& filter() const { return navigator_.filter(); }

 private:
  navigation::Navigator navigator_;
  std::optional<std::int64_t> starts_at_ns_;
};

/// The filter with what a log's receiver and its other sensors that the app takes have put out. Throws files::ReadError
/// when the log lacks one of them.
OfflineFilter filter_with_streams_of(const mcap::McapReader& log, const navigation::AppSetup& setup);

/// The first true state of a log's IMU. Throws files::ReadError when the log has none.
ImuTruth first_true_state(const mcap::McapReader& log, std::uint32_t imu_number);

/// The filter with the fixes of a 7-column text, which have no velocity and come without latency, for the samples of an
/// IMU text. Throws files::ReadError, also when the times of the two do not meet.
OfflineFilter filter_with_fixes_of(const std::string& gnss_text, const std::string& imu_text,
                                   const navigation::AppSetup& setup);

/// Calls `visit` with the samples of a 7-column IMU text, which does not say its week. The first line's interval has no
/// known beginning and makes no sample. Throws files::ReadError, also when there is no sample.
void for_each_text_sample(const std::string& imu_text, std::uint32_t gps_week,
                          const std::function<void(const ImuSample&)>& visit);

}  // namespace inslab::navigate
