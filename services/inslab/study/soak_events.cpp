#include "inslab/services/inslab/study/soak_events.hpp"

#include <algorithm>
#include <cmath>

#include "inslab/data/json/config_error.hpp"

namespace inslab::study {

SoakEvents::SoakEvents(const scenario::LoadedScenario& scenario, const std::filesystem::path& profiles,
                       std::uint64_t seed, double often)
    : random_(seed) {
  for_each_sensor(scenario, [&](auto tag, const auto& sensor) {
    using Sensor = typename decltype(tag)::type;
    for_each(typename Sensor::Profiles{}, [&](auto profile) {
      using Profile = typename decltype(profile)::type;
      if constexpr (std::is_same_v<Profile, FaultProfile>) return;  // a soak is judged by the errors that it promises
      const char* prefix = std::is_same_v<Profile, InstallationProfile> ? Sensor::mountings : "";
      add_profiles(profiles / catalog::kWords<Profile>.folder, Profile::kind, {Sensor::kind, sensor.number}, prefix);
    });
  });
  for (Source& source : sources_) {
    if (source.kind != Kind::Swap) source.mean_s /= often;
    source.next_s = wait_s(source.mean_s);
  }
}

void SoakEvents::add_profiles(const std::filesystem::path& folder, ProfileKind kind, const SensorAddress& sensor,
                              const std::string& prefix) {
  std::vector<std::filesystem::path> files;
  if (std::filesystem::is_directory(folder)) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (entry.path().extension() == ".json" && name.rfind(prefix, 0) == 0) files.push_back(entry.path());
    }
  }
  if (files.empty()) {
    throw json::Error(folder.string(), {Rule::Readable, "",
                                        "has no profiles " + prefix +
                                            "*.json; --profiles names the "
                                            "folder of the folders with those to swap to"});
  }
  std::sort(files.begin(), files.end());  // the order of a folder is nobody's promise
  for (const auto& file : files) profiles_.push_back(scenario::load_profile(file, kind, sensor));
}

std::size_t SoakEvents::pick(std::size_t end) { return static_cast<std::size_t>(random_() % end); }

/// Waits of a Poisson process: -mean ln(1 - u).
double SoakEvents::wait_s(double mean_s) {
  const double u = static_cast<double>(random_() >> 11) * 0x1p-53;
  return -mean_s * std::log1p(-u);
}

std::vector<SoakEvents::Event> SoakEvents::due(double sim_time_s) {
  std::vector<Event> events;
  for (Source& source : sources_) {
    // Lockstep leaps: of what was due since the last look one happens now.
    if (source.next_s > sim_time_s) continue;
    events.push_back({source.kind, sim_time_s});
    source.next_s = sim_time_s + wait_s(source.mean_s);
  }
  return events;
}

catalog::AnyProfile SoakEvents::next_swap() {
  catalog::AnyProfile swap = profiles_[pick(profiles_.size())];
  ProfileRequest& request = catalog::request_of(swap);
  request.request_id = next_request_++;
  request.continuity = static_cast<Continuity>(pick(3));
  if (catalog::kind_of(swap) == ProfileKind::Vibration) request.fade_s = 0.5 * static_cast<double>(pick(4));
  return swap;
}

}  // namespace inslab::study
